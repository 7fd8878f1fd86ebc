#pragma once

#include "fuzz_target.h"
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/geometry/map_limits.h>
#include <mrpt_polyloc/geometry/validation.h>

#include <cstddef>

namespace mrpt_polyloc::fuzz {

/// What was read is refused as a map, or is one with an area, of which its own text says the same.
/// \param read_again reads the map's text; empty if the format cannot say it
template <class ReadAgain>
void checkMap(const RawMap& raw, const ReadAgain& read_again) {
  constexpr std::size_t kQuick = 150;  // repair takes longer than reading, by far
  if (vertexCount(raw) > kQuick) return;
  const PolygonMap map = repairMap(raw).map;
  must(map.area() > 0.0, "a map has an area");
  const RawMap again = read_again(map);
  if (again.polygons.empty()) return;
  must(again.polygons.size() == map.components().size(), "the text has as many components");
  must(repairMap(again).map.area() == map.area(), "the text reads back as the same map");
}

}  // namespace mrpt_polyloc::fuzz
