#include "fuzz_target.h"
#include "map_checks.h"
#include <mrpt_polyloc/io/houseexpo.h>

POLYLOC_FUZZ_TARGET(houseexpo, bytes) {
  checkMap(parseHouseExpo(bytes, "input"), [](const PolygonMap&) { return RawMap{}; });
}
