#include "fixed_room.h"
#include "fuzz_target.h"

#include <sstream>

POLYLOC_FUZZ_TARGET(index, bytes) {
  std::istringstream in(bytes, std::ios::binary);
  const auto index = MapIndex::load(in, fixedRoom(), "input");
  // What was taken must also work.
  askOnce(GlobalLocalizer(index), fixedScan());
}
