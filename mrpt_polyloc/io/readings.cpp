#include <mrpt_polyloc/io/readings.h>

#include <cmath>

namespace mrpt_polyloc {

Beam readingToBeam(double bearing, double range, bool valid, double max_range) {
  if (!std::isfinite(range) || range <= 0.0) return {};
  const bool limited = std::isfinite(max_range) && max_range > 0.0;
  if (valid && !(limited && range >= max_range)) return {bearing, range, BeamKind::hit};
  return {bearing, limited ? max_range : range, BeamKind::no_return};
}

}  // namespace mrpt_polyloc
