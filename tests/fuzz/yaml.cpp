#include "fuzz_target.h"
#include <mrpt_polyloc/io/ros_map.h>

POLYLOC_FUZZ_TARGET(yaml, bytes) {
  inputFile("map.pgm", "P2 3 2 255 0 205 254 254 254 0\n");
  const std::string path = inputFile("map.yaml", bytes);
  Notes notes;
  const OccupancyBitmap bitmap = loadRosMap(path, &notes);
  must(bitmap.resolution > 0.0, "the resolution is above 0");
  must(!rosMapShares(path).empty(), "a map has shares");
}
