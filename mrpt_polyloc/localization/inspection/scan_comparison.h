#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/MapIndex.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/localization/scan/RobustCostParams.h>

#include <mrpt/math/TPose2D.h>

#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// A scan held against what the map predicts for it at a pose. The lists have an entry for each
/// beam of the scan, in its order; of invalid beams nothing is predicted (infinity), and they cost
/// nothing.
struct POLYLOC_EXPORT ScanComparison {
  std::vector<float> wall;  ///< range to the first wall [m]; infinity where there is none
  std::vector<float> open;  ///< range at which an open edge is crossed before it [m], or infinity
  std::vector<float> cost;  ///< robust cost [m]
  double mean_cost = 0.0;   ///< over the beams that say something [m]
  /// The paper's polar coordinate metric between the polar functions of scan and prediction, each a
  /// sample a degree, at this heading, and under the best rotation of the scan, which is
  /// `rotation` counterclockwise [m rad^(1/2), rad]. Nothing if the scan has too few hits.
  struct Polar {
    double distance = 0.0;
    double best_distance = 0.0;
    double rotation = 0.0;  ///< in (-pi, pi]
  };
  std::optional<Polar> polar;
};

/// Prepares the predictor if the index is a deferred one. \throws InvalidParamsError if the pose is
/// not finite
POLYLOC_EXPORT ScanComparison compareWithMap(const MapIndex& index, const RangeScan& scan,
                                             const mrpt::math::TPose2D& pose_map_robot,
                                             const RobustCostParams& params = {});

}  // namespace mrpt_polyloc
