#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/Simulator.h>
#include <mrpt_polyloc/evaluation/WallSegments.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/core/Clock.h>

#include <cmath>
#include <functional>

namespace mrpt_polyloc {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// An L of 12 m2 with a pillar of 1 m2: 11 m2 free, a quarter of the L's square missing.
PolygonMap lRoom() {
  return PolygonMap({{wallRing({{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}),
                      {wallRing({{0.5, 0.5}, {0.5, 1.5}, {1.5, 1.5}, {1.5, 0.5}})}}});
}

SimulatorParams clean() {
  SimulatorParams params;
  params.sigma = 0.0;
  return params;
}

double bearing(const CObservation2DRangeScan& scan, std::size_t beam) {
  return -0.5 * static_cast<double>(scan.aperture) +
         static_cast<double>(scan.aperture) * static_cast<double>(beam) /
             static_cast<double>(scan.getScanSize() - 1);
}

/// The true range of a beam, by the caster that has tests of its own.
double trueRange(const WallSegments& walls, const SimulatedScan& scan, std::size_t beam) {
  const auto& pose = scan.truth.pose_map_robot;
  return walls.range({pose.x, pose.y}, pose.phi + bearing(scan.observation, beam));
}

/// How many beams of 200 scans satisfy a predicate of (reading, is hit, truth).
double shareOfBeams(const SimulatorParams& params,
                    const std::function<bool(double, bool, double)>& holds) {
  const PolygonMap map = lRoom();
  const WallSegments walls(map);
  std::size_t count = 0, total = 0;
  for (const SimulatedScan& scan : simulateScans(map, params, 200, 3)) {
    for (std::size_t i = 0; i < scan.observation.getScanSize(); ++i, ++total) {
      count += holds(static_cast<double>(scan.observation.getScanRange(i)),
                     scan.observation.getScanRangeValidity(i), trueRange(walls, scan, i));
    }
  }
  return static_cast<double>(count) / static_cast<double>(total);
}

TEST(Simulator, CleanRangesAreTheTrueOnes) {
  const double wrong = shareOfBeams(clean(), [](double read, bool hit, double truth) {
    return !hit || std::abs(read - truth) > 1e-4;
  });
  // Aperture and ranges are floats: a beam that grazes the pillar's corner may jump past it.
  EXPECT_LT(wrong, 2e-4);
}

TEST(Simulator, BeamsOfAFullCircleDoNotRepeatTheFirstDirection) {
  SimulatorParams params = clean();
  params.beams = 8;
  const CObservation2DRangeScan scan = simulateScans(lRoom(), params, 1, 1)[0].observation;
  EXPECT_NEAR(scan.aperture, 2 * kPi * 7 / 8, 1e-6);
  EXPECT_NEAR(bearing(scan, 0), -kPi * 7 / 8, 1e-6);
  EXPECT_TRUE(scan.rightToLeft);
}

TEST(Simulator, OuterBeamsOfASectorLieOnItsRim) {
  SimulatorParams params = clean();
  params.beams = 181;
  params.fov = kPi;
  const CObservation2DRangeScan scan = simulateScans(lRoom(), params, 1, 1)[0].observation;
  EXPECT_NEAR(scan.aperture, kPi, 1e-6);
  EXPECT_EQ(scan.getScanSize(), 181u);
}

TEST(Simulator, OneBeamLooksAhead) {
  SimulatorParams params = clean();
  params.beams = 1;
  params.fov = kPi / 2;
  const PolygonMap map = lRoom();
  const SimulatedScan scan = simulateScans(map, params, 1, 5)[0];
  const auto& pose = scan.truth.pose_map_robot;
  ASSERT_EQ(scan.observation.getScanSize(), 1u);
  EXPECT_NEAR(static_cast<double>(scan.observation.getScanRange(0)),
              WallSegments(map).range({pose.x, pose.y}, pose.phi), 1e-6);
}

TEST(Simulator, StampsAreSyntheticAndKeptExactly) {
  const auto scans = simulateScans(lRoom(), clean(), 3, 1);
  for (std::size_t row = 0; row < scans.size(); ++row) {
    EXPECT_EQ(scans[row].truth.stamp, 1e9 + static_cast<double>(row));
    EXPECT_EQ(mrpt::Clock::toDouble(scans[row].observation.timestamp), scans[row].truth.stamp);
  }
}

TEST(Simulator, PosesAreUniformOverFreeSpaceByArea) {
  SimulatorParams params = clean();
  params.beams = 1;
  params.clearance = 0.0;
  const PolygonMap map = lRoom();
  constexpr std::size_t kCount = 6000;
  std::size_t right_arm = 0, turned_left = 0;
  for (const SimulatedScan& scan : simulateScans(map, params, kCount, 11)) {
    const auto& pose = scan.truth.pose_map_robot;
    ASSERT_TRUE(map.contains({pose.x, pose.y}));
    right_arm += pose.x > 2.0;
    turned_left += pose.phi > 0.0;
  }
  // Binomial: 4 m2 of 11 and one half; five standard deviations.
  const auto expectShare = [](std::size_t count, double p) {
    EXPECT_NEAR(static_cast<double>(count) / kCount, p, 5 * std::sqrt(p * (1 - p) / kCount));
  };
  expectShare(right_arm, 4.0 / 11.0);
  expectShare(turned_left, 0.5);
}

TEST(Simulator, KeepsTheClearance) {
  SimulatorParams params = clean();
  params.beams = 1;
  params.clearance = 0.45;
  const WallSegments walls(lRoom());
  for (const SimulatedScan& scan : simulateScans(lRoom(), params, 300, 2)) {
    const auto& pose = scan.truth.pose_map_robot;
    EXPECT_GE(walls.distance({pose.x, pose.y}), 0.45);
  }
}

TEST(Simulator, SaysThatTheClearanceIsTooLarge) {
  SimulatorParams params = clean();
  params.clearance = 3.0;
  EXPECT_THAT([&] { simulateScans(lRoom(), params, 1, 1); },
              ThrowsMessage<InvalidMapError>(HasSubstr("3.000000 m from all walls")));
}

TEST(Simulator, NoiseHasTheStatedDeviation) {
  SimulatorParams params;
  params.sigma = 0.05;
  params.max_range = 50.0;
  const WallSegments walls(lRoom());
  double sum = 0.0, squares = 0.0;
  std::size_t n = 0;
  for (const SimulatedScan& scan : simulateScans(lRoom(), params, 100, 4)) {
    for (std::size_t i = 0; i < scan.observation.getScanSize(); ++i) {
      const double error =
          static_cast<double>(scan.observation.getScanRange(i)) - trueRange(walls, scan, i);
      if (std::abs(error) > 0.4) continue;  // grazing a corner
      sum += error;
      squares += error * error;
      ++n;
    }
  }
  const double count = static_cast<double>(n);
  EXPECT_NEAR(sum / count, 0.0, 5 * 0.05 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count), 0.05, 5 * 0.05 / std::sqrt(2 * count));
}

TEST(Simulator, NothingWithinTheGreatestRangeIsANoReturn) {
  SimulatorParams params = clean();
  params.max_range = 1.0;
  const double wrong = shareOfBeams(params, [](double read, bool hit, double truth) {
    if (std::abs(truth - 1.0) < 1e-4) return false;
    return hit ? truth > 1.0 || read > 1.0 : truth < 1.0 || read != 1.0;
  });
  EXPECT_LT(wrong, 2e-4);
}

TEST(Simulator, DropoutMakesNoReturnsOfTheStatedShare) {
  SimulatorParams params = clean();
  params.dropout = 0.2;
  const double lost = shareOfBeams(params, [](double, bool hit, double) { return !hit; });
  EXPECT_NEAR(lost, 0.2, 5 * std::sqrt(0.2 * 0.8 / 72000.0));
}

TEST(Simulator, ShortBeamsAreUniformBelowTheTruth) {
  SimulatorParams params = clean();
  params.short_beams = 0.3;
  const auto below = [&](double fraction) {
    return shareOfBeams(params, [fraction](double read, bool hit, double truth) {
      return hit && read < fraction * truth - 1e-4;
    });
  };
  EXPECT_NEAR(below(1.0), 0.3, 5 * std::sqrt(0.3 * 0.7 / 72000.0));
  EXPECT_NEAR(below(0.5), 0.15, 5 * std::sqrt(0.15 * 0.85 / 72000.0));
}

TEST(Simulator, OccludersAreContiguousSectorsInFront) {
  SimulatorParams params = clean();
  params.occluders = 1;
  const WallSegments walls(lRoom());
  for (const SimulatedScan& scan : simulateScans(lRoom(), params, 50, 6)) {
    const std::size_t n = scan.observation.getScanSize();
    std::size_t covered = 0, starts = 0;
    bool before = static_cast<double>(scan.observation.getScanRange(n - 1)) <
                  trueRange(walls, scan, n - 1) - 1e-3;
    for (std::size_t i = 0; i < n; ++i) {
      const double read = scan.observation.getScanRange(i), truth = trueRange(walls, scan, i);
      const bool is_covered = read < truth - 1e-3;
      covered += is_covered;
      starts += is_covered && !before;
      before = is_covered;
    }
    EXPECT_LE(covered, 20u);  // 19 degrees of one-degree beams
    EXPECT_GE(covered, 1u);
    EXPECT_LE(starts, 3u);  // one sector; a nearer wall inside it may part it
  }
}

TEST(Simulator, SameSeedSameScansAndPosesDoNotDependOnNoise) {
  SimulatorParams noisy;
  noisy.dropout = 0.1;
  noisy.short_beams = 0.2;
  noisy.occluders = 3;
  const auto a = simulateScans(lRoom(), noisy, 4, 9), b = simulateScans(lRoom(), noisy, 4, 9);
  const auto c = simulateScans(lRoom(), clean(), 4, 9), d = simulateScans(lRoom(), noisy, 4, 10);
  for (std::size_t row = 0; row < a.size(); ++row) {
    EXPECT_EQ(a[row].truth.pose_map_robot, b[row].truth.pose_map_robot);
    EXPECT_EQ(a[row].truth.pose_map_robot, c[row].truth.pose_map_robot);
    EXPECT_FALSE(a[row].truth.pose_map_robot == d[row].truth.pose_map_robot);
    for (std::size_t i = 0; i < a[row].observation.getScanSize(); ++i) {
      ASSERT_EQ(a[row].observation.getScanRange(i), b[row].observation.getScanRange(i));
      ASSERT_EQ(a[row].observation.getScanRangeValidity(i),
                b[row].observation.getScanRangeValidity(i));
    }
  }
}

TEST(Simulator, OneScanIsOfTheWallsThatAreGiven) {
  RoomChanges changes;
  changes.discs = {{{3.0, 1.0}, 0.2}};
  const WallSegments walls(lRoom(), changes);
  const mrpt::math::TPose2D pose(3.5, 0.4, 0.3);
  const CObservation2DRangeScan scan = simulateScan(walls, clean(), pose, 1);
  ASSERT_EQ(scan.getScanSize(), 360U);
  for (std::size_t i = 0; i < 360; ++i) {
    const double share = static_cast<double>(i) / 359 - 0.5;
    const double bearing = share * static_cast<double>(scan.aperture);
    EXPECT_NEAR(scan.getScanRange(i), walls.range({pose.x, pose.y}, pose.phi + bearing), 1e-3);
  }
  SimulatorParams noisy;
  noisy.short_beams = 0.3;
  const auto a = simulateScan(walls, noisy, pose, 5), b = simulateScan(walls, noisy, pose, 5);
  const auto c = simulateScan(walls, noisy, pose, 6);
  int changed = 0;
  for (std::size_t i = 0; i < 360; ++i) {
    EXPECT_EQ(a.getScanRange(i), b.getScanRange(i));
    changed += a.getScanRange(i) != c.getScanRange(i) ? 1 : 0;
  }
  EXPECT_GT(changed, 300);
}

TEST(Simulator, RefusesBadParametersByName) {
  const auto expectRefused = [](const std::function<void(SimulatorParams&)>& spoil,
                                const std::string& name) {
    SimulatorParams params;
    spoil(params);
    EXPECT_THAT([&] { simulateScans(lRoom(), params, 1, 1); },
                ThrowsMessage<InvalidParamsError>(HasSubstr(name)));
  };
  expectRefused([](SimulatorParams& p) { p.beams = 0; }, "beams");
  expectRefused([](SimulatorParams& p) { p.fov = 0.0; }, "fov");
  expectRefused([](SimulatorParams& p) { p.fov = 7.0; }, "fov");
  expectRefused([](SimulatorParams& p) { p.sigma = -0.1; }, "sigma");
  expectRefused([](SimulatorParams& p) { p.max_range = std::nan(""); }, "max_range");
  expectRefused([](SimulatorParams& p) { p.dropout = 1.1; }, "dropout");
  expectRefused([](SimulatorParams& p) { p.short_beams = -0.1; }, "short_beams");
  expectRefused([](SimulatorParams& p) { p.clearance = -1.0; }, "clearance");
}

}  // namespace
}  // namespace mrpt_polyloc
