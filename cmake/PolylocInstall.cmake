# Install and export of the library: headers keep the path that they are included by, and
# find_package(mrpt_polyloc) gives the target mrpt_polyloc::mrpt_polyloc.
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/mrpt_polyloc")

install(
  TARGETS mrpt_polyloc
  EXPORT mrpt_polylocTargets
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
foreach(folder IN ITEMS base geometry visibility polar localization travel io mrpt_bridge evaluation)
  install(
    DIRECTORY "${PROJECT_SOURCE_DIR}/mrpt_polyloc/${folder}"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/mrpt_polyloc"
    FILES_MATCHING
    PATTERN "*.h"
    PATTERN "baselines" EXCLUDE) # no part of the library
endforeach()
install(FILES "${PROJECT_BINARY_DIR}/generated/mrpt_polyloc/version.h"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/mrpt_polyloc")
install(FILES "${PROJECT_SOURCE_DIR}/package.xml" DESTINATION "${CMAKE_INSTALL_DATADIR}/mrpt_polyloc")

install(
  EXPORT mrpt_polylocTargets
  NAMESPACE mrpt_polyloc::
  DESTINATION "${package_dir}")
configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/cmake/mrpt_polylocConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/mrpt_polylocConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/mrpt_polylocConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/mrpt_polylocConfig.cmake"
              "${PROJECT_BINARY_DIR}/mrpt_polylocConfigVersion.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/PolylocMrpt.cmake"
        DESTINATION "${package_dir}")
