# Install and export of the library: headers keep the path that they are included by, and
# find_package(mrpt_polyloc) gives the target mrpt_polyloc::mrpt_polyloc.
include(CMakePackageConfigHelpers)

# A static library is linked with all that it uses.
set(polyloc_has_static OFF)
if(POLYLOC_INSTALL_STATIC OR NOT BUILD_SHARED_LIBS)
  set(polyloc_has_static ON)
endif()

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/mrpt_polyloc")

set(polyloc_installed mrpt_polyloc)
if(BUILD_SHARED_LIBS AND POLYLOC_INSTALL_STATIC)
  list(APPEND polyloc_installed mrpt_polyloc_static)
endif()
install(
  TARGETS ${polyloc_installed}
  EXPORT mrpt_polylocTargets
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
          COMPONENT library
          NAMELINK_COMPONENT development
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)

# The public interface: what a user includes, and what that reaches. The test package.consumer
# compiles each of these by itself against the installed ones alone.
set(POLYLOC_PUBLIC_HEADERS
    base/BuildProgress.h
    base/TiledGrid.h
    base/angles.h
    base/errors.h
    base/export.h
    base/notes.h
    geometry/BoundingBox.h
    geometry/OccupancyBitmap.h
    geometry/PolygonMap.h
    geometry/Triangulation.h
    geometry/WallDistances.h
    geometry/bitmap_cleaning.h
    geometry/tracing.h
    geometry/validation.h
    visibility/BeamPattern.h
    visibility/BoundaryChains.h
    visibility/FloatBlocks.h
    visibility/RangePredictor.h
    visibility/SquareExpander.h
    visibility/ViewExpander.h
    visibility/VisibilityCells.h
    visibility/VisibilitySkeleton.h
    visibility/VisibleEdgeIndex.h
    visibility/critical_segments.h
    visibility/segment_arrangement.h
    visibility/visibility_polygon.h
    localization/CellLocalizer.h
    localization/GlobalLocalizer.h
    localization/GlobalLocalizerParams.h
    localization/LocalizationResult.h
    localization/MapIndex.h
    localization/MultiMapLocalizer.h
    localization/SearchOptions.h
    localization/exact/ExactAnswers.h
    localization/exact/ExactLocalizer.h
    localization/exact/LimitedAnswers.h
    localization/exact/LimitedRangeLocalizer.h
    localization/exact/LimitedView.h
    localization/exact/ObservedPolygon.h
    localization/exact/SkeletonClasses.h
    localization/exact/SkeletonLocalizer.h
    localization/exact/clear_stretches.h
    localization/nearest_cells/ScanViewParams.h
    localization/ranking/Assessment.h
    localization/ranking/Calibration.h
    localization/ranking/Hypothesis.h
    localization/ranking/HypothesisParams.h
    localization/ranking/LocalizationStatus.h
    localization/ranking/MatchFeatures.h
    localization/ranking/MomentWeights.h
    localization/scan/BeamEvidenceParams.h
    localization/scan/Motion.h
    localization/scan/PosePrior.h
    localization/scan/PoseRefinerParams.h
    localization/scan/RangeScan.h
    localization/scan/RobustCostParams.h
    localization/scan/ScanSet.h
    localization/search/Certificate.h
    localization/search/CertifiedSearchParams.h
    localization/search/SearchMetric.h
    travel/ClearanceField.h
    travel/ExpectedReadings.h
    travel/HypothesisTracker.h
    travel/SafeSet.h
    travel/Sight.h
    travel/TravelPlan.h
    travel/TravelPlanner.h
    travel/TravelPlannerParams.h
    io/ScanLog.h
    io/bitmap_files.h
    io/drive_log.h
    io/map_files.h
    io/mrpt_compat.h
    io/observation.h
    io/polygon_files.h
    io/readings.h
    io/scan_files.h
    io/sensor_survey.h
    io/wkt.h
    mrpt_bridge/CPolygonMap2D.h
    mrpt_bridge/FilterMonitor.h
    mrpt_bridge/FilterRecovery.h
    mrpt_bridge/ParticleSeeder.h
    mrpt_bridge/TLikelihoodOptions.h
    mrpt_bridge/registration.h)
foreach(header IN LISTS POLYLOC_PUBLIC_HEADERS)
  get_filename_component(folder "${header}" DIRECTORY)
  install(FILES "${PROJECT_SOURCE_DIR}/mrpt_polyloc/${header}"
          DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/mrpt_polyloc/${folder}" COMPONENT development)
endforeach()
list(LENGTH POLYLOC_PUBLIC_HEADERS count)
math(EXPR count "${count} + 1") # version.h
set(POLYLOC_INSTALLED_HEADERS ${count} CACHE INTERNAL "Number of installed headers")
install(FILES "${PROJECT_BINARY_DIR}/generated/mrpt_polyloc/version.h"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/mrpt_polyloc" COMPONENT development)
install(FILES "${PROJECT_SOURCE_DIR}/package.xml"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/mrpt_polyloc" COMPONENT development)

install(
  EXPORT mrpt_polylocTargets
  NAMESPACE mrpt_polyloc::
  DESTINATION "${package_dir}"
  COMPONENT development)
configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/cmake/mrpt_polylocConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/mrpt_polylocConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/mrpt_polylocConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/mrpt_polylocConfig.cmake"
              "${PROJECT_BINARY_DIR}/mrpt_polylocConfigVersion.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/PolylocMrpt.cmake"
        DESTINATION "${package_dir}" COMPONENT development)
