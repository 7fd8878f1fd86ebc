#include "fuzz_target.h"
#include <mrpt_polyloc/io/bitmap_files.h>

POLYLOC_FUZZ_TARGET(gridmap, bytes) {
  const auto bitmap = loadBitmap(inputFile("input.gridmap", bytes));
  must(bitmap.has_value(), "the extension is known");
  must(bitmap->cells.size() ==
           static_cast<std::size_t>(bitmap->width) * static_cast<std::size_t>(bitmap->height),
       "each cell has a state");
}
