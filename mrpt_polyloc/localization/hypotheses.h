#pragma once

#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/PoseRefiner.h>
#include <mrpt_polyloc/localization/RangeScan.h>
#include <mrpt_polyloc/localization/ScanCost.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// A refined pose with its cost over all beams.
struct RankedPose {
  RefinedPose refined;
  double cost = 0.0;  ///< mean [m]
};

struct HypothesisParams {
  double merge_distance = 0.2;               ///< poses nearer than this are one hypothesis [m] ...
  double merge_angle = 0.06981317007977318;  ///< ... if their headings are, too [rad], 4 degrees
  /// The best mean cost above which the scan is said not to match the map [m].
  double no_match_cost = 0.25;
  /// A rival whose mean cost exceeds the best by less than this is one, however sure the difference
  /// is [m]: the map itself is not better.
  double rival_cost = 0.004;
  double rival_deviations = 2.0;  ///< ... and one within so many standard errors of the difference
  /// Consecutive beams hit the same objects: so many count as one independent observation.
  std::size_t beams_per_block = 10;
  /// Scale of the exponential by which weights fall with the mean cost [m], at one block of beams.
  double weight_scale = 0.25;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// Sorted by cost, of poses that are nearly one only the best.
std::vector<RankedPose> mergeNearPoses(std::vector<RankedPose> poses,
                                       const HypothesisParams& params = {});

/// The rival test: whether none of the others explains the scan about as well as the first, by
/// paired differences of the beams' costs averaged over blocks of neighbouring beams.
bool isUnique(const std::vector<RankedPose>& poses, const ScanCost& cost,
              const HypothesisParams& params = {});

/// The poses as hypotheses for the robot, with covariance and weight. `poses` sorted by cost.
std::vector<Hypothesis> toHypotheses(const std::vector<RankedPose>& poses, const RangeScan& scan,
                                     const HypothesisParams& params = {});

}  // namespace mrpt_polyloc
