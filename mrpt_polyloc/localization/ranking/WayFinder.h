#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/ranking/MomentWeights.h>
#include <mrpt_polyloc/localization/ranking/SetEvidence.h>
#include <mrpt_polyloc/localization/ranking/SetRefiner.h>
#include <mrpt_polyloc/localization/ranking/candidate_ranking.h>
#include <mrpt_polyloc/localization/scan/AllowedPoses.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>

#include <mrpt/math/TPose2D.h>

#include <limits>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// A way that a scan set may have been seen from.
struct POLYLOC_EXPORT ScoredWay {
  RefinedWay refined;
  double cost = 0.0;                   ///< mean over the beams of all scans [m]
  mrpt::math::TPose2D start{0, 0, 0};  ///< where the robot now was taken to be at first

  const mrpt::math::TPose2D& now() const { return refined.poses.back(); }
};

/// Finds the ways of a scan set to poses now: first as the scans have them, whatever the wheels
/// said; then, once it is known how far the wheels can be believed, by both.
///
/// Held to the word of wheels that slip, or that are read too late, no way would fit, the true one
/// as little as others; and a search for the fit that begins where such wheels lead does not find
/// it: their errors add up along the drive.
class POLYLOC_EXPORT WayFinder {
 public:
  /// Keeps references to all but prior and params. \param prior of the robot now
  WayFinder(const RangePredictor& predictor, const ScanSet& set, const MomentWeights& weights,
            const SetEvidence& evidence, const Triangulation& triangulation, const PosePrior& prior,
            const RankingParams& params);

  /// The way to a pose now as the scans have it: from now back, each moment's pose where its own
  /// scans fit best beside where the wheels lead from the next. None fits worse than it did there.
  /// Its tension is at scale 1. Some of the beams take part in finding it, all in its cost.
  /// \param worth once it is known to cost more [m], the rest of the way is left to the wheels
  /// \returns nothing where the robot may not be
  std::optional<ScoredWay> byScans(const mrpt::math::TPose2D& pose_map_robot,
                                   double worth = std::numeric_limits<double>::infinity()) const;

  /// By how much the wheels' standard deviations are to be multiplied: the scale at which the best
  /// of the ways is likeliest, see doubtWheels(). \param ways by scans, sorted by cost
  double wheelScale(const std::vector<ScoredWay>& ways) const;

  /// The likeliest by scans and wheels together of: a way by scans as it is, the way back from its
  /// start that the wheels tell, and, if it may become the best, the first refined with the wheels
  /// at that scale.
  ScoredWay likeliest(const ScoredWay& by_scans, double wheel_scale, bool may_be_best) const;

  /// What a way costs at most that may still become the best [m].
  static double worth(double least_cost);
  /// How many of ways sorted by cost do.
  static std::size_t worthCount(const std::vector<ScoredWay>& ways);

 private:
  bool isAllowed(const mrpt::math::TPose2D& pose_map_robot) const;

  const ScanSet* set_;
  const SetEvidence* evidence_;
  HypothesisParams params_;
  SetRefiner coarse_, fine_;
  std::vector<AllowedPoses> allowed_;  ///< of each laser of now
};

}  // namespace mrpt_polyloc
