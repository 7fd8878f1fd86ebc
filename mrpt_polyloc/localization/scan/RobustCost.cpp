#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/scan/RobustCost.h>

namespace mrpt_polyloc {

void RobustCostParams::check() const {
  requirePositive("tau_short", tau_short);
  requirePositive("tau_long", tau_long);
  requirePositive("tau_open", tau_open);
  requireInRange("tau_none", tau_none, 0.0, 1e6);
  requireInRange("none_share", none_share, 0.0, 1.0);
}

}  // namespace mrpt_polyloc
