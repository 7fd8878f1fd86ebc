#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/MapIndex.h>
#include <mrpt_polyloc/localization/ranking/Hypothesis.h>
#include <mrpt_polyloc/travel/ClearanceField.h>
#include <mrpt_polyloc/travel/Sight.h>
#include <mrpt_polyloc/travel/TravelPlan.h>
#include <mrpt_polyloc/travel/TravelPlannerParams.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace mrpt_polyloc {

/// What a robot knows when it asks where to go. All places in its frame of now.
struct POLYLOC_EXPORT TravelSituation {
  /// Where it may be now. Who keeps them over a drive is no matter of the planner.
  std::vector<Hypothesis> hypotheses;
  /// What it has seen, the last scan first: of that its laser's model is taken; all tell where it
  /// is free to go. At least one.
  std::vector<PlacedScan> scans;
  /// Of the scans the first so many are trusted to be placed well enough to drive by; 0: all.
  std::size_t recent_scans = 0;
  /// Where it has looked before, whether the scans are kept or not: looking again tells little.
  std::vector<mrpt::math::TPose2D> looked;
  double most_distance = 1e6;  ///< it will not drive farther than this [m]
  std::uint64_t seed = 0;      ///< for TravelStrategy::random: another number for each step
};

/// The second stage of localization: where to go so that wrong hypotheses fall.
///
/// The safe set of all hypotheses (SafeSet) is where the robot may drive. At places spread over it
/// the scans that each hypothesis expects are predicted (ReadingExpectation) and compared pair by
/// pair (PairEvidence); the strategy chooses among the places that tell something apart. Lasers
/// that do not see all around are turned at each place to where they tell most; turning where the
/// robot stands costs no way.
///
/// Immutable; const calls are thread-safe and deterministic.
class POLYLOC_EXPORT TravelPlanner {
 public:
  /// Makes a table of the map's clearances. \throws InvalidParamsError, also if the index is null
  TravelPlanner(MapIndex::Ptr index, TravelPlannerParams params = {});

  /// \throws InvalidParamsError if there is no scan
  TravelPlan plan(const TravelSituation& situation) const;

  /// Where to go to see something new where there is nothing to compare: no hypothesis, or one that
  /// is not sure. A safe place that is 2 m from all it looked from, or the farthest from them:
  /// along walls if it sees any, else straight on; `go` or `blocked`.
  TravelPlan explore(const TravelSituation& situation) const;

  /// The safe set of a situation, as plan() takes it: for pictures.
  SafeSet safeSet(const TravelSituation& situation) const;

  const TravelPlannerParams& params() const { return params_; }
  const ClearanceField& clearances() const { return field_; }
  const MapIndex& index() const { return *index_; }

 private:
  MapIndex::Ptr index_;
  TravelPlannerParams params_;
  ClearanceField field_;
};

}  // namespace mrpt_polyloc
