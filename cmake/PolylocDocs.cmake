# The target `docs`: the site of the library, build/docs/html/index.html. A warning of Doxygen's, as
# of a link that leads nowhere, is an error. Without doxygen there is no such target.
find_program(DOXYGEN doxygen)
if(NOT DOXYGEN)
  return()
endif()
set(doxygen_files README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md apps/README.md datasets/README.md
                  tests/fuzz/README.md mrpt_polyloc/doc)
file(GLOB program_pages RELATIVE "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/apps/*/README.md")
list(APPEND doxygen_files ${program_pages})
list(TRANSFORM POLYLOC_PUBLIC_HEADERS PREPEND mrpt_polyloc/ OUTPUT_VARIABLE public_headers)
list(APPEND doxygen_files ${public_headers})
set(doxygen_input "")
foreach(file IN LISTS doxygen_files)
  string(APPEND doxygen_input " \"${PROJECT_SOURCE_DIR}/${file}\"")
endforeach()
configure_file("${PROJECT_SOURCE_DIR}/cmake/docs/Doxyfile.in" "${PROJECT_BINARY_DIR}/Doxyfile" @ONLY)
add_custom_target(
  docs
  COMMAND "${DOXYGEN}" "${PROJECT_BINARY_DIR}/Doxyfile"
  WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
  VERBATIM)
