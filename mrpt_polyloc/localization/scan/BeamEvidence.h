#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/scan/BeamEvidenceParams.h>
#include <mrpt_polyloc/localization/scan/ScanCost.h>

#include <mrpt/math/TPose2D.h>

#include <vector>

namespace mrpt_polyloc {

/// All that speaks against a pose: what each beam met before it ended (beamEvidence()), and how far
/// the points lie from the walls that the map knows.
///
/// The first fails where the map is incomplete: behind glass, dots of walls and holes, what a beam
/// meets first is not what the map says, and yet its end lies on a wall. The second fails where
/// walls are everywhere alike, in corridors. Each corrects the other. Points count by the space
/// they take, not by the angle: else one near wall outvotes the rest.
class POLYLOC_EXPORT BeamEvidence {
 public:
  /// Keeps a reference to the cost's predictor.
  explicit BeamEvidence(ScanCost cost, const BeamEvidenceParams& params = {});

  /// For each beam of the cost [m]; the mean over the beams is the evidence against the pose.
  std::vector<float> at(const mrpt::math::TPose2D& pose_map_beams) const;

  /// How near the points lie to walls, in [0, 1]: the mean of exp(-d^2 / (2 wall_sigma^2)), d by
  /// how much more than 0.05 m they lie off the nearest wall, over the squares of `thinning` that
  /// hold points.
  double nearness(const mrpt::math::TPose2D& pose_map_beams) const;

 private:
  template <class Visitor>
  void forEachPoint(const mrpt::math::TPose2D& pose_map_beams, Visitor&& visit) const;

  ScanCost cost_;
  BeamEvidenceParams params_;
  struct Point {
    std::size_t beam;
    double x, y;    ///< in the beam frame [m]
    double weight;  ///< all weights sum to 1
  };
  std::vector<Point> points_;
};

/// The evidence against a pose: the mean over the beams [m], 0 without any.
POLYLOC_EXPORT double meanOf(const std::vector<float>& values);

}  // namespace mrpt_polyloc
