#include <mrpt_polyloc/geometry/angles.h>
#include <mrpt_polyloc/geometry/params_check.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>

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

const char* toString(LocalizationStatus status) {
  switch (status) {
    case LocalizationStatus::unique:
      return "unique";
    case LocalizationStatus::ambiguous:
      return "ambiguous";
    case LocalizationStatus::no_match:
      return "no_match";
    case LocalizationStatus::too_few_beams:
      break;
  }
  return "too_few_beams";
}

}  // namespace mrpt_polyloc
