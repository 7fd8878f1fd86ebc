#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>

#include <limits>

namespace mrpt_polyloc {

void PosePrior::check() const {
  constexpr double kGreatest = std::numeric_limits<double>::max();  // any finite number
  if (compass) {
    requireInRange("compass heading", compass->heading, -kGreatest, kGreatest);
    requireInRange("compass tolerance", compass->tolerance, 0.0, kPi);
  }
  if (near) {
    requireInRange("near x", near->x, -kGreatest, kGreatest);
    requireInRange("near y", near->y, -kGreatest, kGreatest);
    requireInRange("near radius", near->radius, 0.0, kGreatest);
  }
}

}  // namespace mrpt_polyloc
