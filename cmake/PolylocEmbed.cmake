# Text files compiled into a program. polyloc_embed(OUT.cpp FILE...): makes a source that holds the
# files as apps/polyloc-view/page_files.h says; it is made anew when one of them changes. Run as a
# script (-P) it writes that source.
if(CMAKE_SCRIPT_MODE_FILE)
  set(entries "")
  foreach(file IN LISTS FILES)
    get_filename_component(name "${file}" NAME)
    file(READ "${file}" text)
    if(text MATCHES "\\)polyloc_embed\"")
      message(FATAL_ERROR "${file}: holds the end of a raw string")
    endif()
    string(APPEND entries "    {\"${name}\", R\"polyloc_embed(${text})polyloc_embed\"},\n")
  endforeach()
  file(WRITE "${OUT}.new" "// Made by cmake/PolylocEmbed.cmake.\n#include \"page_files.h\"\n\n"
       "namespace mrpt_polyloc::apps {\n\nconst std::vector<PageFile>& pageFiles() {\n"
       "  static const std::vector<PageFile> files = {\n${entries}  };\n  return files;\n}\n\n"
       "}  // namespace mrpt_polyloc::apps\n")
  file(RENAME "${OUT}.new" "${OUT}")
  return()
endif()

set(polyloc_embed_script "${CMAKE_CURRENT_LIST_FILE}")
function(polyloc_embed out)
  add_custom_command(
    OUTPUT "${out}"
    COMMAND "${CMAKE_COMMAND}" "-DOUT=${out}" "-DFILES=${ARGN}" -P "${polyloc_embed_script}"
    DEPENDS ${ARGN} "${polyloc_embed_script}"
    VERBATIM)
endfunction()
