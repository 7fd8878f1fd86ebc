#pragma once

#include "World.h"
#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/localization/scan/Motion.h>
#include <mrpt_polyloc/travel/HypothesisTracker.h>
#include <mrpt_polyloc/travel/TravelPlanner.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc::apps {

struct TravelRunParams {
  MotionNoise odometry;
  double most_travel = 100.0;     ///< a run that drove so far gives up [m]
  std::size_t most_scans = 200;   ///< ... or took so many scans
  Tolerance tolerance;            ///< what is right
  double start_clearance = 0.05;  ///< of the robot's rim to everything at the start [m]
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
TravelRunResult travel(const TravelPlanner& planner, const GlobalLocalizer& localizer,
                       const World& world, const mrpt::math::TPose2D& start,
                       const TravelRunParams& params, std::uint64_t seed);

}  // namespace mrpt_polyloc::apps
