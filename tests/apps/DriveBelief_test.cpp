#include "../../apps/polyloc-travel/DriveBelief.h"

#include "tests/support/simulated_scans.h"

#include <gtest/gtest.h>

#include <cmath>

/// The rules by which a robot that drives to be sure is sure.
namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPose2D;
using test::asymmetricRoom;
using test::mapOf;
using test::ScanOptions;
using test::simulatedScan;

ScanSet driveOf(const PolygonMap& map, const std::vector<TPose2D>& poses) {
  std::vector<Moment> moments;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    Motion motion;
    if (k > 0) motion = measuredMotion(poses[k] - poses[k - 1]);
    moments.push_back({{simulatedScan(map, poses[k])}, motion, false});
  }
  return ScanSet(std::move(moments));
}

TEST(DriveBelief, SearchesEachScanHoweverClearTheFirstOnesAnswerIs) {
  const PolygonMap map = asymmetricRoom();
  const auto index = MapIndex::build(map);
  const GlobalLocalizer quick(index), sure(index, surerSearch());
  const ScanSet drive = driveOf(map, {{1, 1, 0.2}, {1.6, 1.2, 0.5}, {2.2, 1.6, 0.8}});
  ASSERT_EQ(quick.localize(drive).status, LocalizationStatus::unique);
  std::size_t of_all = 0;
  for (const Moment& moment : drive.moments()) {
    of_all += quick.localize(moment.scans.front()).statistics.evaluated;
  }
  EXPECT_LT(quick.localize(drive).statistics.evaluated, of_all);
  EXPECT_EQ(sure.localize(drive).statistics.evaluated, of_all);
}

/// A round hall with a niche of that depth [m]: the walls hold the place, but the niche alone holds
/// the heading.
PolygonMap roundHall(double niche) {
  constexpr int kCorners = 90, kFirst = 3, kWidth = 4;
  constexpr double kRadius = 4.0;
  std::vector<TPoint2D> ring;
  for (int i = 0; i < kCorners; ++i) {
    const double bearing = kTwoPi * (i + 0.5) / kCorners;
    const bool is_niche = i >= kFirst && i < kFirst + kWidth;
    const double radius = is_niche ? kRadius + niche : kRadius;
    ring.push_back({radius * std::cos(bearing), radius * std::sin(bearing)});
  }
  return mapOf(ring);
}

/// Drives across a hall, its heading known to two degrees at the start.
DriveBelief drivenAcross(const GlobalLocalizer& localizer, const PolygonMap& map) {
  PosePrior prior;
  prior.compass = PosePrior::Compass{0.0, 2.0 * kDegree};
  DriveBelief belief(localizer, MotionNoise(), prior);
  TPose2D before;
  for (int i = 0; i < 7; ++i) {
    const TPose2D pose(-2.1 + 0.7 * i, 0.3, 0.0);
    if (i > 0) belief.move(measuredMotion(pose - before), 0.0);
    ScanOptions options;
    options.sigma = 0.01;
    options.seed = static_cast<std::uint32_t>(i);
    belief.look(simulatedScan(map, pose, options));
    before = pose;
  }
  return belief;
}

TEST(DriveBelief, IsNotSureWhereTheHeadingIsBadlyKnown) {
  const PolygonMap deep = roundHall(1.0), shallow = roundHall(0.08);
  const GlobalLocalizer in_deep(deep, surerSearch()), in_shallow(shallow, surerSearch());
  const DriveBelief known = drivenAcross(in_deep, deep);
  ASSERT_TRUE(known.answer());
  EXPECT_LT(std::hypot(known.answer()->x - 2.1, known.answer()->y - 0.3), 0.1);
  const DriveBelief unknown = drivenAcross(in_shallow, shallow);
  // All else says that it is sure, and it is right.
  ASSERT_TRUE(unknown.isKnowing());
  EXPECT_EQ(unknown.state().status, LocalizationStatus::unique);
  const TrackedHypothesis& first = unknown.state().hypotheses.front();
  EXPECT_LT(std::hypot(first.pose_map_robot.x - 2.1, first.pose_map_robot.y - 0.3), 0.2);
  EXPECT_GT(std::sqrt(first.covariance(2, 2)), 2.0 * kDegree);
  EXPECT_FALSE(unknown.answer());
}

}  // namespace
}  // namespace mrpt_polyloc::apps
