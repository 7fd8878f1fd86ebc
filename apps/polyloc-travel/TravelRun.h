#pragma once

#include "DriveBelief.h"
#include "World.h"
#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/scan/Motion.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>
#include <mrpt_polyloc/travel/HypothesisTracker.h>
#include <mrpt_polyloc/travel/TravelPlanner.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mrpt_polyloc::apps {

struct TravelRunParams {
  MotionNoise odometry;
  double most_travel = 100.0;     ///< a run that drove so far gives up [m]
  std::size_t most_scans = 200;   ///< ... or took so many scans
  Tolerance tolerance;            ///< what is right
  double start_clearance = 0.05;  ///< of the robot's rim to everything at the start [m]
  PosePrior prior;                ///< what the robot knows of where it starts
};

enum class TravelOutcome {
  localized,          ///< the tracker says `unique`, and is right
  wrong,              ///< the tracker says `unique`, and is not
  indistinguishable,  ///< the planner says that nothing within reach tells more
  gave_up             ///< none of these within the metres and scans allowed
};

const char* toString(TravelOutcome outcome);

/// What was known and planned after one scan.
struct TravelStep {
  mrpt::math::TPose2D truth;                  ///< where the robot was
  std::vector<TrackedHypothesis> hypotheses;  ///< where it may have been
  TravelPlan plan;
  double travelled = 0.0;  ///< by then [m]
};

struct TravelRunResult {
  mrpt::math::TPose2D start;
  TravelOutcome outcome = TravelOutcome::gave_up;
  bool is_ambiguous_at_start = false;
  double travelled = 0.0;  ///< truly [m]
  std::size_t scans = 0;
  std::size_t collisions = 0;  ///< movements in which the robot touched something
  double error_m = 0.0;        ///< of the first hypothesis at the end; NaN if there is none
  double error_rad = 0.0;
  std::vector<double> planning_ms;
  std::vector<TravelStep> steps;  ///< one for each scan
  RangeScan first_scan{std::vector<Beam>{}};
  std::vector<TPoint2D> way;  ///< where it truly went
};

/// One robot in a closed loop: scan, tracker, planner, drive, until it knows where it is, knows
/// that it cannot, or has had enough. Its wheels measure what they were told to do; the noise is in
/// what the robot does. The same world, start and seed give the same run.
///
/// Step by step: look(), drive(), look() ... until isOver().
class TravelRun {
 public:
  /// Keeps the references.
  TravelRun(const TravelPlanner& planner, const GlobalLocalizer& localizer, const World& world,
            const mrpt::math::TPose2D& start, const TravelRunParams& params, std::uint64_t seed);

  /// Scans, and decides what that means; plans if it goes on. Adds a step to the result.
  void look();
  /// Drives to the waypoint of the last plan, if there is one.
  void drive();
  bool isOver() const { return is_over_; }

  /// So far; its outcome counts once it is over.
  const TravelRunResult& result() const { return result_; }
  const RangeScan& scan() const { return scans_.front().scan; }  ///< the last one
  /// What is known now: `unique` only where the robot is sure, see look().
  LocalizationStatus status() const;
  double noneProbability() const { return belief_.state().none_probability; }
  /// What the last plan was made for.
  const TravelSituation& situation() const { return situation_; }
  /// Where the wheels believe to be, seen from the start.
  const mrpt::math::TPose2D& odometry() const { return odometry_; }

 private:
  void decide();
  TravelSituation situationNow() const;
  TravelPlan makePlan() const;
  TravelPlan explore() const;
  Motion move(const mrpt::math::TPose2D& told);
  void measureError();

  const TravelPlanner& planner_;
  const World& world_;
  TravelRunParams params_;
  DriveBelief belief_;
  Random noise_;
  std::uint64_t seed_;
  mrpt::math::TPose2D truth_;
  mrpt::math::TPose2D odometry_{0, 0, 0};    ///< as measured, from the start
  std::vector<PlacedScan> scans_;            ///< the last first, placed by odometry
  std::vector<mrpt::math::TPose2D> looked_;  ///< by odometry
  bool is_over_ = false;
  int blocked_ = 0;
  TravelSituation situation_;
  TravelRunResult result_;
};

/// Such a robot to its end.
TravelRunResult travel(const TravelPlanner& planner, const GlobalLocalizer& localizer,
                       const World& world, const mrpt::math::TPose2D& start,
                       const TravelRunParams& params, std::uint64_t seed);

}  // namespace mrpt_polyloc::apps
