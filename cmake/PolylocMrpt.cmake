# polyloc_find_mrpt(COMPONENT...): finds parts of MRPT by their names in MRPT 2 and gives targets
# mrpt::COMPONENT, whichever MRPT there is; POLYLOC_MRPT_FOUND tells whether all were found, and
# POLYLOC_MRPT_MISSING which were not. Used by this build, and by the installed package.
#
# MRPT 2 is one package with components and such targets. MRPT 3 is a package for each part,
# mrpt_maps with the target mrpt::mrpt_maps; what 2 has in opengl, the objects of a scene, 3 has in
# viz. The rules for 3 come from the sources of its package files: no release of it was built with.
function(polyloc_find_mrpt)
  set(missing "")
  find_package(MRPT 2.5 QUIET COMPONENTS ${ARGN})
  if(NOT MRPT_FOUND)
    # The package files of MRPT 3 take the variable, where it is set, for a folder to search.
    unset(MRPT_DIR CACHE)
    foreach(component IN LISTS ARGN)
      if(TARGET mrpt::${component})
        continue()
      endif()
      string(REGEX REPLACE "^opengl$" "viz" name "${component}")
      find_package(mrpt_${name} 3.0 QUIET)
      if(mrpt_${name}_FOUND)
        add_library(mrpt::${component} INTERFACE IMPORTED)
        target_link_libraries(mrpt::${component} INTERFACE mrpt::mrpt_${name})
      else()
        list(APPEND missing ${component})
      endif()
    endforeach()
  endif()
  set(POLYLOC_MRPT_MISSING "${missing}" PARENT_SCOPE)
  if(missing)
    set(POLYLOC_MRPT_FOUND FALSE PARENT_SCOPE)
  else()
    set(POLYLOC_MRPT_FOUND TRUE PARENT_SCOPE)
  endif()
endfunction()

# polyloc_require_mrpt(COMPONENT...): the same, an error where something is missing.
function(polyloc_require_mrpt)
  polyloc_find_mrpt(${ARGN})
  if(NOT POLYLOC_MRPT_FOUND)
    message(FATAL_ERROR "neither MRPT 2.5 or later nor MRPT 3 with these parts was found: "
                        "${POLYLOC_MRPT_MISSING}")
  endif()
endfunction()
