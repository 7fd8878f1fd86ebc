#include "fuzz_target.h"
#include <mrpt_polyloc/io/gray_image.h>

POLYLOC_FUZZ_TARGET(pgm, bytes) {
  const GrayImage image = decodePgm("input", bytes);
  const auto pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  must(image.values.size() == pixels, "each pixel has a value");
  must(image.opacity.empty() || image.opacity.size() == pixels, "and an opacity, or none has");
  for (const std::uint32_t value : image.values) must(value <= image.max_value, "of the range");
}
