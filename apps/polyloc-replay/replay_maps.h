#pragma once

#include "ReplayConfig.h"
#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>

#include <mrpt/maps/CMultiMetricMap.h>

#include <optional>
#include <string>

namespace mrpt_polyloc::replay {

/// What the filter weighs with and what the search looks in.
struct ReplayMaps {
  mrpt::maps::CMultiMetricMap::Ptr metric;  ///< as [MetricMap] says
  CPolygonMap2D polygons;
  std::string metric_classes;  ///< names of the classes in `metric`, for the reports
};

/// Makes both. The polygons are those of [polyloc] map, else of the first polygonMap2D, else of
/// the map_file of [LocalizationExperiment].
/// \throws FormatError naming ini or map file: a map that misses or is broken, a class of maps that
/// is not known, no map at all, one of which the index would take more than max_memory [MB] (see
/// requireMemory())
ReplayMaps loadReplayMaps(const ReplayConfig& config, const std::optional<double>& max_memory = {});

}  // namespace mrpt_polyloc::replay
