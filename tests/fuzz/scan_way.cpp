#include "fixed_room.h"
#include "fuzz_target.h"

#include <cstring>

// Bytes as the beams of a scan: six each, for the range in single precision, the kind, and the
// bearing's step.
POLYLOC_FUZZ_TARGET(scan_way, bytes) {
  static const GlobalLocalizer localizer(fixedRoom());
  constexpr std::size_t kBeam = 6, kQuick = 400;
  std::vector<Beam> beams;
  double bearing = 0.0;
  for (std::size_t at = 0; at + kBeam <= bytes.size() && beams.size() < kQuick; at += kBeam) {
    float range = 0.0F;
    std::memcpy(&range, bytes.data() + at, sizeof range);
    const auto kind = static_cast<unsigned char>(bytes[at + 4]) % 3U;
    bearing += 0.001 * static_cast<double>(bytes[at + 5]);
    beams.push_back({bearing, static_cast<double>(range), static_cast<BeamKind>(kind)});
  }
  askOnce(localizer, RangeScan(std::move(beams)));
}
