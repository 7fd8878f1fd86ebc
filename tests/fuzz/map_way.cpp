#include "fixed_room.h"
#include "fuzz_target.h"
#include <mrpt_polyloc/io/gray_image.h>
#include <mrpt_polyloc/io/map_files.h>

// Bytes as an image, traced to polygons, indexed, and asked.
POLYLOC_FUZZ_TARGET(map_way, bytes) {
  constexpr int kQuick = 48;  // [pixels] a side
  const GrayImage image = decodePgm("input", bytes);
  if (image.width > kQuick || image.height > kQuick) return;
  inputFile("map.pgm", bytes);
  const std::string path =
      inputFile("map.yaml", "image: map.pgm\nresolution: 0.2\norigin: [1, 2, 0.3]\n");
  MapIndexParams params;
  params.threads = 1;
  params.leaf_size = 0.5;
  askOnce(GlobalLocalizer(MapIndex::build(loadMap(path).map, params)), fixedScan());
}
