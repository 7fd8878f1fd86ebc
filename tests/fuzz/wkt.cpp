#include "fuzz_target.h"
#include "map_checks.h"
#include <mrpt_polyloc/io/wkt.h>

POLYLOC_FUZZ_TARGET(wkt, bytes) {
  checkMap(parseWkt(bytes, "input"), [](const PolygonMap& map) {
    if (map.openPerimeter() == 0.0 && map.wallsBeyond().empty()) return parseWkt(toWkt(map), "own");
    return RawMap{};
  });
}
