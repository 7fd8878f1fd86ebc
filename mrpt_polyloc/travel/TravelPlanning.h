#pragma once

#include <mrpt_polyloc/travel/ClearanceField.h>
#include <mrpt_polyloc/travel/SafeSet.h>
#include <mrpt_polyloc/travel/Sight.h>
#include <mrpt_polyloc/travel/TravelPlan.h>
#include <mrpt_polyloc/travel/TravelPlanner.h>
#include <mrpt_polyloc/travel/TravelPlannerParams.h>
#include <mrpt_polyloc/travel/TravelValues.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// So much around the robot is taken as free, or one whose laser does not see all around could
/// never start: the disc that it takes up when it begins to move.
double ownRadius(const TravelPlannerParams& params);

/// One plan of TravelPlanner in the making. Its steps stand in files of their own: which place
/// (TravelPlanning_choice.cpp), where to go if none tells anything (TravelPlanning_explore.cpp),
/// and how far to drive until the next look (TravelPlanning_waypoint.cpp).
class TravelPlanning {
 public:
  /// Keeps references to all.
  TravelPlanning(const TravelSituation& situation, const TravelPlannerParams& params,
                 const ClearanceField& field, const RangePredictor& predictor);

  TravelPlan run();

  /// \param least how far a place must be from all it looked from, to be gone to [m]
  TravelPlan explore(double least = 0.0);

 private:
  struct Choice {
    TravelValues::Value value;
    double distance;  ///< [m]
  };

  /// Exploring is over where the robot has looked from this near to every place [m].
  static constexpr double kNewPlace = 1.0;
  /// A robot that gets no farther than this cannot leave its place [m].
  static constexpr double kLeastReach = 0.3;

  SafeSetParams limited(SafeSetParams safe, double quorum) const;
  /// Whether what is told here can change by driving on: not all hypotheses were compared, or their
  /// common safe set ends where one of them alone could go on. There it is bounded by what was
  /// seen, or by doubts of some centimetres.
  bool isMoreToSee() const;
  /// Where ways are planned.
  const SafeSet& ways() const { return majority_ ? *majority_ : safe_; }
  /// How far the robot gets [m].
  double reach() const;
  bool wasLookedFrom(const mrpt::math::TPose2D& pose) const;
  /// How the robot would come to a place: along its last step.
  double headingAt(const TPoint2D& place) const;

  /// Places at which something new may be seen, nearest first, with what they tell.
  std::vector<Choice> valued(const std::vector<SafeSet::Place>& places) const;
  std::vector<Choice> coarseChoices() const;
  std::optional<Choice> choose(const std::vector<Choice>& choices) const;
  double scoreOf(const Choice& choice, double most) const;
  /// Looks closely, also again from where it was looked before, before nothing is said to differ.
  std::optional<Choice> denseChoice(std::size_t& looked_at) const;
  /// The place on the way from which nearly as much is told.
  Choice soonerOnTheWay(const Choice& choice) const;

  /// The place that is the farthest from all it looked from, or far enough, and of these the one
  /// that is the least effort; none if all are nearer than `least`.
  std::optional<SafeSet::Place> farthestNew(double least, bool mapped_alone) const;
  /// Whether half of the hypotheses, by weight, have free space of the map here.
  bool isMapped(const TPoint2D& place) const;
  /// To look from where it is to where it has not looked, or `blocked`: a robot that stands before
  /// a wall with its only laser must turn to see how it gets away.
  TravelPlan turned() const;
  /// What speaks against a place to explore [m]. A robot that sees walls follows them, for that is
  /// where something differs; one that sees none goes straight on until it does.
  static double effortOf(const SafeSet::Place& place, const Sight& now);

  void take(const Choice& choice, TravelPlan& plan) const;
  /// The waypoint: where the path leaves what is in sight, or what all hypotheses call safe.
  void cutToSight(TravelPlan& plan) const;
  /// Whether the last look but this was from here and turned: where two ways are nearly as good the
  /// robot would turn to and fro.
  bool hasJustTurned() const;

  const TravelSituation& situation_;
  const TravelPlannerParams& params_;
  const ClearanceField& field_;
  Sight sight_;         ///< by which places are safe
  Sight recent_sight_;  ///< by which the robot drives on
  SafeSet safe_;
  std::optional<SafeSet> majority_;
  TravelValues values_;
  std::vector<mrpt::math::TPose2D> looked_;
};

}  // namespace mrpt_polyloc
