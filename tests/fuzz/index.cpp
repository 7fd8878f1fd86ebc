#include "fixed_room.h"
#include "fuzz_target.h"
#include <mrpt_polyloc/base/Checksum.h>

#include <cstring>
#include <sstream>

// The checksum at the end is made anew: no mutation would find it, and all would end there.
POLYLOC_FUZZ_TARGET(index, bytes) {
  std::string sealed = bytes;
  if (bytes.size() > sizeof(std::uint64_t)) {
    const std::size_t end = bytes.size() - sizeof(std::uint64_t);
    Checksum checksum;
    checksum.add(bytes.data(), end);
    const std::uint64_t value = checksum.value();
    std::memcpy(sealed.data() + end, &value, sizeof(value));
  }
  std::istringstream in(sealed, std::ios::binary);
  const auto index = MapIndex::load(in, fixedRoom(), "input");
  // What was taken must also work.
  askOnce(GlobalLocalizer(index), fixedScan());
}
