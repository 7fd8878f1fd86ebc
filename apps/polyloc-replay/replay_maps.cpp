#include "replay_maps.h"

#include "../common/memory_budget.h"
#include "../common/parsing.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/map_files.h>
#include <mrpt_polyloc/io/mrpt_archive.h>

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/TMetricMapTypesRegistry.h>

#include <exception>

namespace mrpt_polyloc::replay {
namespace {

using apps::requireMemory;

using mrpt::maps::CMultiMetricMap;

/// MRPT 2.5.8 leaves out a map whose class it does not know, without a word.
void requireKnownClasses(const ReplayConfig& config) {
  std::vector<std::string> keys;
  config.text.getAllKeys("MetricMap", keys);
  const std::string tail = "_count";
  for (const std::string& key : keys) {
    if (!apps::endsWith(key, tail) || config.text.read_double("MetricMap", key, 0.0) <= 0.0)
      continue;
    const std::string name = key.substr(0, key.size() - tail.size());
    const auto& known =
        mrpt::maps::internal::TMetricMapTypesRegistry::Instance().getAllRegistered();
    if (known.count(name) == 0) {
      throw FormatError(
          config.path, "[MetricMap]",
          key + ": no class of maps is known as '" + name + "'; is its library missing (-l)?");
    }
  }
}

/// Fills the maps that are built from a simplemap, or the grid from a gridmap.
void loadMapFile(const std::string& file, CMultiMetricMap& map) {
  GzInputStream stream(file);
  const auto object = readObject(stream, 0);
  if (const auto simple = std::dynamic_pointer_cast<mrpt::maps::CSimpleMap>(object)) {
    if (simple->empty()) throw FormatError(file, "", "holds no observation");
    map.loadFromSimpleMap(*simple);
  } else if (const auto grid = std::dynamic_pointer_cast<mrpt::maps::COccupancyGridMap2D>(object)) {
    const auto own = map.mapByClass<mrpt::maps::COccupancyGridMap2D>();
    if (!own) return;  // as a map for the search alone
    const auto options = own->likelihoodOptions;
    *own = *grid;
    own->likelihoodOptions = options;  // the ini's, not those of who stored the map
  } else {
    throw FormatError(file, "", "neither a simplemap nor a gridmap");
  }
}

CMultiMetricMap::Ptr loadMetricMap(const ReplayConfig& config) {
  requireKnownClasses(config);
  auto map = CMultiMetricMap::Create();
  try {
    mrpt::maps::TSetOfMetricMapInitializers list;
    list.loadFromConfigFile(config.text, "MetricMap");
    map->setListOfMaps(list);
  } catch (const std::exception& error) {
    throw FormatError(config.path, "[MetricMap]", plainMessage(error));
  }
  if (map->maps.empty()) throw FormatError(config.path, "[MetricMap]", "asks for no map");
  if (!config.map_file.empty()) {
    try {
      loadMapFile(config.map_file, *map);
    } catch (const FormatError&) {
      throw;
    } catch (const std::exception& error) {
      throw FormatError(config.map_file, "", plainMessage(error));
    }
  }
  return map;
}

/// A map to search in: its index must fit.
PolygonMap polygonsFor(const std::string& path, double scale,
                       const std::optional<double>& max_memory) {
  PolygonMap map = loadMap(path, {}, nullptr, scale).map;
  requireMemory(path, map, {}, max_memory);
  return map;
}

}  // namespace

ReplayMaps loadReplayMaps(const ReplayConfig& config, const std::optional<double>& max_memory) {
  ReplayMaps maps;
  maps.metric = loadMetricMap(config);
  for (const auto& map : maps.metric->maps) {
    const std::string name = map->GetRuntimeClass()->className;
    maps.metric_classes += (maps.metric_classes.empty() ? "" : ", ") + name;
    // MRPT 2.5.8 calls a grid empty that was read from a gridmap.
    if (config.map_file.empty() && map->isEmpty()) {
      throw FormatError(config.path, "[MetricMap]", "the " + name + " is empty; no map_file?");
    }
  }
  const auto own = maps.metric->mapByClass<CPolygonMap2D>();
  if (!config.search_map.empty()) {
    maps.polygons = CPolygonMap2D(polygonsFor(config.search_map, config.scale, max_memory));
  } else if (own) {
    maps.polygons = *own;
    requireMemory(config.path, *own->map(), {}, max_memory);
  } else if (!config.map_file.empty()) {
    maps.polygons = CPolygonMap2D(polygonsFor(config.map_file, 1.0, max_memory));
  } else {
    throw FormatError(config.path, "[polyloc]",
                      "no map to search in: give 'map', a polygonMap2D, or a map_file");
  }
  return maps;
}

}  // namespace mrpt_polyloc::replay
