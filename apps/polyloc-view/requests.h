#pragma once

#include "../polyloc-travel/TravelRun.h"
#include "RequestField.h"
#include <mrpt_polyloc/evaluation/Simulator.h>
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>
#include <mrpt_polyloc/localization/search/SearchMetric.h>
#include <mrpt_polyloc/travel/TravelPlannerParams.h>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// What requests hold, read and checked: the one place where limits of the API stand.
namespace mrpt_polyloc::apps {

constexpr std::size_t kMostBeams = 100'000;
constexpr std::size_t kMostPolygonVertices = 20'000;

enum class Method { certified, cells, exact };

/// The members `prior` and `options` of a request.
struct SearchRequest {
  PosePrior prior;
  Method method = Method::certified;
  std::size_t max_hypotheses = 20;
  double time_budget_ms = 10'000.0;
  bool keep_regions = false;
  SearchMetric metric = SearchMetric::robust;
};
SearchRequest readSearch(const RequestField& request);

/// A scan as a request spells it out: `ranges` with `start_angle`, `angle_step`, `max_range`,
/// `min_range` and `sensor`, or `bearings`, `ranges`, `kinds` and `sensor` as toJson(RangeScan)
/// writes them.
RangeScan readScan(const RequestField& request);

constexpr std::size_t kMostScans = 200;  ///< of a set or a drive

/// One of several scans, with `moved`: the robot seen from where it was at the scan before.
struct MovedScan {
  std::optional<mrpt::math::TPose2D> moved;
  RangeScan scan;
};
/// An array of such, at least one; kMostBeams together.
std::vector<MovedScan> readMovedScans(const RequestField& scans);

/// Scans that belong together: the member `scans`, those without `moved` of the same moment as the
/// one before, and `odometry`, how far wheels are wrong.
ScanSet readScanSet(const RequestField& request);

/// `[[x, y], ...]` [m].
std::vector<mrpt::math::TPoint2D> readPoints(const RequestField& points, std::size_t most);

/// `{x, y, phi}` [m, rad].
mrpt::math::TPose2D readPose(const RequestField& pose);

/// `{x, y}` [m]; other members are not looked at.
mrpt::math::TPoint2D readPoint(const RequestField& point);

/// The members `laser` (beams, fov, sigma, max_range, dropout, short_beams, seed) and `changes`
/// (discs: [{x, y, radius}], moved: [{x, y, dx, dy}]) of a request to simulate.
struct LaserRequest {
  SimulatorParams laser;
  RoomChanges changes;
  std::uint64_t seed = 1;
};
LaserRequest readLaser(const RequestField& request);

/// Beams at most of a robot that drives: each of its steps is kept.
constexpr std::size_t kMostDrivenBeams = 2000;

/// The member `robot` (radius, strategy, max_travel, odometry: {position_per_metre,
/// heading_per_metre, heading_per_radian}) of a request about driving.
struct RobotRequest {
  TravelPlannerParams planner;
  TravelRunParams run;
};
RobotRequest readRobot(const RequestField& request);

}  // namespace mrpt_polyloc::apps
