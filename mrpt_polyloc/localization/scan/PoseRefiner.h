#pragma once

#include <mrpt_polyloc/localization/scan/PoseRefinerParams.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPose2D.h>

#include <array>
#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// A pose moved to its local optimum.
struct RefinedPose {
  mrpt::math::TPose2D pose_map_beams;
  mrpt::math::CMatrixDouble33 information;  ///< of (x, y, phi), at the optimum
  std::size_t used_beams = 0;
};

/// The normal equations of one step of refinement, residuals weighted robustly: matrix * step =
/// right, the step (along x, along y, turn) in the axes of the frame it is of.
struct RefinementStep {
  mrpt::math::CMatrixDouble33 matrix;  ///< [beams, m, m^2]; not yet divided by a variance
  std::array<double, 3> right{};       ///< [m, m, m^2]
  std::size_t beams = 0;               ///< that take part
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
  /// Where refinement leads, without what the scan says there: a prediction less.
  mrpt::math::TPose2D refinedPose(const mrpt::math::TPose2D& pose_map_beams) const;
  /// A pose as it is, with what the scan says there.
  RefinedPose at(const mrpt::math::TPose2D& pose_map_beams) const;
  /// One step from a pose, not taken: for those who refine several poses at once. In the beam
  /// frame.
  RefinementStep step(const mrpt::math::TPose2D& pose_map_beams) const;

 private:
  struct NormalEquations;
  NormalEquations linearize(const mrpt::math::TPose2D& pose, PredictedHits& predicted) const;
  /// One step down, taken. \returns whether it was a short one
  bool takeStep(const NormalEquations& equations, mrpt::math::TPose2D& pose) const;
  RefinedPose refine(const mrpt::math::TPose2D& start, int max_iterations) const;

  const RangePredictor* predictor_;
  PoseRefinerParams params_;
  std::vector<float> ranges_;
  std::vector<double> cosines_, sines_;
  BeamPattern pattern_;
};

}  // namespace mrpt_polyloc
