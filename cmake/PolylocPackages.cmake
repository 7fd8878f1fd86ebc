# Debian packages of the three components that are installed:
#   cmake --preset package && cmake --build --preset package
#   cd build-package && cpack -G DEB
# makes libmrpt-polylocX.Y (library), libmrpt-polyloc-dev (development) and mrpt-polyloc-apps
# (programs), with manual pages, completion for bash and what Debian wants to know. What the packages
# depend on is found by dpkg-shlibdeps, so they fit the release that they were built on.
# Manual pages and completion are installed without packages, too, where awk is there.

set(soversion "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
set(library_package "libmrpt-polyloc${soversion}")
set(development_package libmrpt-polyloc-dev)
set(programs_package mrpt-polyloc-apps)
set(packages_dir "${PROJECT_SOURCE_DIR}/cmake/packages")

# Of SOURCE_DATE_EPOCH, if that is set: the same sources make the same packages.
string(TIMESTAMP month "%Y-%m" UTC)
string(TIMESTAMP changelog_date "%a, %d %b %Y %H:%M:%S +0000" UTC)

get_property(programs GLOBAL PROPERTY POLYLOC_PROGRAMS)
find_program(AWK awk)
find_program(GZIP_PROGRAM gzip)

set(pages "")
if(AWK AND GZIP_PROGRAM)
  foreach(program IN LISTS programs)
    set(page "${PROJECT_BINARY_DIR}/man/${program}.1.gz")
    add_custom_command(
      OUTPUT "${page}"
      COMMAND
        sh "${packages_dir}/man_page.sh" "$<TARGET_FILE:${program}>" "${program}"
        "${PROJECT_VERSION}" "${month}" "${page}"
      DEPENDS ${program} "${packages_dir}/man_page.sh" "${packages_dir}/man_page.awk"
      VERBATIM)
    list(APPEND pages "${page}")
  endforeach()
  add_custom_target(man_pages ALL DEPENDS ${pages})
  install(FILES ${pages} DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT programs)
endif()

# bash-completion looks for a file by the program's name.
set(completions "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
foreach(program IN LISTS programs)
  install(FILES "${PROJECT_SOURCE_DIR}/apps/completion/polyloc.bash" DESTINATION "${completions}"
          RENAME ${program} COMPONENT programs)
endforeach()

if(NOT POLYLOC_SYSTEM_PACKAGE)
  return()
endif()

set(maintainer "The mrpt_polyloc developers <mrpt-polyloc@users.noreply.github.com>")

# What each package of Debian says of itself: its license and its changes.
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/debian")
execute_process(COMMAND gzip -9nc "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
                OUTPUT_FILE "${PROJECT_BINARY_DIR}/debian/changelog.gz" COMMAND_ERROR_IS_FATAL ANY)
file(WRITE "${PROJECT_BINARY_DIR}/debian/changelog.Debian"
     "mrpt-polyloc (${PROJECT_VERSION}-1) unstable; urgency=medium\n\n"
     "  * Built from its sources by cpack; what changed is in changelog.gz.\n\n"
     " -- ${maintainer}  ${changelog_date}\n")
execute_process(COMMAND gzip -9nf "${PROJECT_BINARY_DIR}/debian/changelog.Debian"
                COMMAND_ERROR_IS_FATAL ANY)
foreach(component IN ITEMS library development programs)
  install(FILES "${packages_dir}/copyright" "${PROJECT_BINARY_DIR}/debian/changelog.gz"
                "${PROJECT_BINARY_DIR}/debian/changelog.Debian.gz"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${${component}_package}" COMPONENT ${component})
endforeach()
install(FILES "${PROJECT_SOURCE_DIR}/README.md"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${programs_package}" COMPONENT programs)
install(
  DIRECTORY "${PROJECT_SOURCE_DIR}/datasets/"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${programs_package}/examples"
  COMPONENT programs)

set(CPACK_PACKAGE_NAME mrpt-polyloc)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_CONTACT "${maintainer}")
set(CPACK_PACKAGING_INSTALL_PREFIX "/usr")
set(CPACK_COMPONENTS_ALL library development programs)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The programs' own library is found in the build; its package is named below.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/lib")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY "=")
set(same_version "(= ${PROJECT_VERSION}-1)")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME "${library_package}")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
file(WRITE "${PROJECT_BINARY_DIR}/debian/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA "${PROJECT_BINARY_DIR}/debian/triggers")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
    "Global localization of a 2D range scan in a polygon map
One scan of a 2D laser and a polygon map of the rooms in, every pose of the
robot that explains the scan out, with how well each does. This is the library,
with a metric map for MRPT.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME "${development_package}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
# Of MRPT what the headers include, and a target is asked for.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "${library_package} ${same_version}, libmrpt-maps-dev, libmrpt-obs-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "Global localization in polygon maps (development files)
Headers and CMake package of mrpt_polyloc, which finds every pose in a polygon
map that explains one scan of a 2D laser.")

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME "${programs_package}")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS "${library_package} ${same_version}")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS mrpt-common) # the logs and maps that examples name
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION
    "Global localization in polygon maps (programs)
Programs that convert and draw polygon maps, localize scans of a 2D laser in
them without any guess, replay logs through MRPT's particle filter, evaluate,
simulate, and show it all in a browser.")
include(CPack)
