#include <mrpt_polyloc/geometry/errors.h>
#include <mrpt_polyloc/polar/RotationRange.h>

#include <string>

namespace mrpt_polyloc {

void RotationRange::check() const {
  if (!std::isfinite(center))
    throw InvalidParamsError("center = " + std::to_string(center) + " must be finite");
  if (!(tolerance >= 0.0 && tolerance <= kPi))
    throw InvalidParamsError("tolerance = " + std::to_string(tolerance) +
                             " rad must be in [0, pi]");
}

}  // namespace mrpt_polyloc
