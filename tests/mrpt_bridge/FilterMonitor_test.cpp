#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/scan/ScanCost.h>
#include <mrpt_polyloc/mrpt_bridge/FilterMonitor.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// The fit of scans taken at `robot` where the filter believes the robot at `estimate`.
class Fit {
 public:
  double operator()(const TPose2D& robot, const TPose2D& estimate, std::uint32_t seed) const {
    test::ScanOptions options;
    options.beams = 90;
    options.sigma = 0.03;
    options.short_share = 0.1;
    options.seed = seed;
    const RangeScan scan = test::simulatedScan(map_, robot, options);
    const ScanCost cost(predictor_, scan, {});
    return -cost.mean(scan.beamFrameFromRobot(estimate)) / 0.2;  // a Laplacian of 0.2 m
  }

 private:
  PolygonMap map_ = test::asymmetricRoom();
  RangePredictor predictor_{Triangulation(map_)};
};

/// Along the lower wall of the room and back.
TPose2D onTheWay(int step) {
  return {3.5 + 2.5 * std::sin(0.1 * step), 1.0, 0.05 * step};
}

TEST(FilterMonitor, NoticesATeleportedRobotAndNothingElse) {
  const Fit fit;
  for (std::uint32_t run = 0; run < 20; ++run) {
    FilterMonitor monitor;
    for (int step = 0; step < 60; ++step) {
      const TPose2D pose = onTheWay(step), believed{pose.x + 0.02, pose.y - 0.02, pose.phi + 0.01};
      ASSERT_NE(monitor.update(fit(pose, believed, 1000 * run + static_cast<std::uint32_t>(step))),
                FilterHealth::lost)
          << "run " << run << " step " << step;
    }
    int steps_to_notice = 0;  // the robot now drives elsewhere, the filter follows the odometry
    for (FilterHealth health = FilterHealth::healthy; health != FilterHealth::lost;) {
      ASSERT_LT(steps_to_notice, 10) << "run " << run;
      const TPose2D pose = onTheWay(60 + steps_to_notice);
      health = monitor.update(fit({3.0, 3.8, 0.05 * steps_to_notice - 2.0}, pose,
                                  5000 + 1000 * run + static_cast<std::uint32_t>(steps_to_notice)));
      ++steps_to_notice;
    }
    EXPECT_GE(steps_to_notice, 3);
    monitor.recovered();
    EXPECT_EQ(monitor.update(fit(onTheWay(70), onTheWay(70), run)), FilterHealth::healthy);
  }
}

TEST(FilterMonitor, FollowsItsDefinition) {
  FilterMonitorParams params;
  params.least_steps = 3;
  params.patience = 2;
  params.deviations = 2.0;
  params.least_deviation = 0.1;
  FilterMonitor monitor(params);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(monitor.update(kNaN), FilterHealth::learning);
  for (const double fit : {-1.0, -1.3, -0.9})
    EXPECT_EQ(monitor.update(fit), FilterHealth::learning);
  // Median -1, absolute deviations 0, 0.1, 0.3.
  EXPECT_NEAR(monitor.threshold(), -1.0 - 2.0 * 1.4826 * 0.1, 1e-12);
  EXPECT_EQ(monitor.update(-1.31), FilterHealth::doubtful);
  EXPECT_EQ(monitor.update(-1.29), FilterHealth::healthy);  // starts the count anew
  EXPECT_EQ(monitor.update(-9.0), FilterHealth::doubtful);
  EXPECT_EQ(monitor.update(kNaN), FilterHealth::lost);
  EXPECT_EQ(monitor.update(-9.0), FilterHealth::lost);
  monitor.recovered();
  EXPECT_EQ(monitor.update(-9.0), FilterHealth::doubtful);
}

TEST(FilterMonitor, NamesBadParameters) {
  FilterMonitorParams params;
  params.window = 5;
  EXPECT_THROW(FilterMonitor{params}, InvalidParamsError);
  params = {};
  params.patience = 0;
  EXPECT_THROW(FilterMonitor{params}, InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
