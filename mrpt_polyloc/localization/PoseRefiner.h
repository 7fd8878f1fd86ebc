#pragma once

#include <mrpt_polyloc/localization/RangeScan.h>
#include <mrpt_polyloc/localization/RobustCost.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

struct PoseRefinerParams {
  int max_iterations = 12;
  double step_tolerance = 1e-4;  ///< ends when a step is shorter than this [m] ...
  double turn_tolerance = 1e-4;  ///< ... and turns by less than this [rad]
  /// Residuals count fully up to about this distance and hardly beyond its double (Cauchy's
  /// weights) [m]: a few cells of a grid map, less than the depth of furniture.
  double residual_scale = 0.1;
  /// Beams that miss the predicted line by more than this take no part [m].
  double gate = 0.8;
  /// Standard deviation of a hit's distance to its wall, sensor and map together [m].
  double sigma = 0.05;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// A pose moved to its local optimum.
struct RefinedPose {
  mrpt::math::TPose2D pose_map_beams;
  mrpt::math::CMatrixDouble33 information;  ///< of (x, y, phi), at the optimum
  std::size_t used_beams = 0;
};

/// Moves poses to where the scan fits best: Gauss-Newton on the distances between the hits and the
/// lines that the map predicts the beams to hit (projective point-to-line matching), weighted
/// robustly. Within one combination of lines the predicted range is smooth in the pose, and the
/// derivatives are exact.
class PoseRefiner {
 public:
  /// Keeps a reference to the predictor. At most `max_beams` hits, evenly chosen, are used; 0: all.
  PoseRefiner(const RangePredictor& predictor, const RangeScan& scan,
              const PoseRefinerParams& params = {}, std::size_t max_beams = 0);

  RefinedPose refine(const mrpt::math::TPose2D& pose_map_beams) const;

 private:
  const RangePredictor* predictor_;
  PoseRefinerParams params_;
  std::vector<float> ranges_;
  std::vector<double> cosines_, sines_;
  BeamPattern pattern_;
};

}  // namespace mrpt_polyloc
