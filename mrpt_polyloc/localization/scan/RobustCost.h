#pragma once

#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/localization/scan/RobustCostParams.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mrpt_polyloc {

/// The robust relative of the polar coordinate metric that the search minimises: a mean over beams
/// of a truncated, asymmetric absolute difference of ranges, with rules for open edges.
///
/// With z the measured range, w the predicted range to the first wall and o the range at which an
/// open edge was crossed before it (infinity: none):
///  - no open edge: z < w: min(w - z, tau_short); else min(z - w, tau_long);
///  - open edge:    z < o: min(o - z, tau_short); o <= z < w: min(w - z, tau_open); else
///    min(z - w, tau_long);
///  - no-return:    tau_none where w < none_share z and no open edge was crossed, else 0.
class RobustCost {
 public:
  explicit RobustCost(const RobustCostParams& params = {})
      : tau_short_(static_cast<float>(params.tau_short)),
        tau_long_(static_cast<float>(params.tau_long)),
        tau_open_(static_cast<float>(params.tau_open)),
        tau_none_(static_cast<float>(params.tau_none)),
        none_share_(static_cast<float>(params.none_share)) {}

  /// The cost of one hit, or the no-return of one beam [m]. All cases are computed and one is
  /// chosen, so that loops over beams become vector code.
  float hit(float z, float w, float o) const {
    const float beyond_wall = std::min(z - w, tau_long_);
    const float beyond_open = std::min(w - z, tau_open_);
    const float before_both = std::min(std::min(o, w) - z, tau_short_);
    const float before_wall = z >= o ? beyond_open : before_both;
    return z >= w ? beyond_wall : before_wall;
  }
  float noReturn(float max_range, float w, float o) const {
    return w < none_share_ * max_range && !(o < w) ? tau_none_ : 0.0F;
  }
  float operator()(const Beam& beam, float w, float o) const {
    switch (beam.kind) {
      case BeamKind::hit:
        return hit(static_cast<float>(beam.range), w, o);
      case BeamKind::no_return:
        return noReturn(static_cast<float>(beam.range), w, o);
      case BeamKind::invalid:
        break;
    }
    return 0.0F;
  }

 private:
  float tau_short_, tau_long_, tau_open_, tau_none_, none_share_;
};

}  // namespace mrpt_polyloc
