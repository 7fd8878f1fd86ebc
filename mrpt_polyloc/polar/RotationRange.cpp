#include <mrpt_polyloc/geometry/params_check.h>
#include <mrpt_polyloc/polar/RotationRange.h>

#include <limits>

namespace mrpt_polyloc {

void RotationRange::check() const {
  constexpr double kMost = std::numeric_limits<double>::max();
  requireInRange("center", center, -kMost, kMost);
  requireInRange("tolerance", tolerance, 0.0, kPi);
}

}  // namespace mrpt_polyloc
