#include "fuzz_target.h"
#include "map_checks.h"
#include <mrpt_polyloc/io/geojson.h>

POLYLOC_FUZZ_TARGET(geojson, bytes) {
  Notes notes;
  std::vector<Polyline> doors;
  checkMap(parseGeoJson(bytes, "input", &notes, &doors),
           [](const PolygonMap& map) { return parseGeoJson(toGeoJson(map), "own"); });
}
