#include "fuzz_target.h"
#include <mrpt_polyloc/evaluation/truth.h>

POLYLOC_FUZZ_TARGET(good_list, bytes) {
  constexpr std::size_t kRows = 1000;
  for (const std::size_t row : loadRows(inputFile("good.txt", bytes), kRows)) {
    must(row < kRows, "a row is one of the set");
  }
}
