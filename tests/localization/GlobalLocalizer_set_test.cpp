#include "global_localizer.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/errors.h>

#include <gtest/gtest.h>

#include <random>

/// GlobalLocalizer with scan sets.
namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

/// Two equal rooms below a corridor that reaches farther beyond one of them.
PolygonMap twinRooms() {
  return mapOf({{0, 0},
                {6, 0},
                {6, 4},
                {7, 4},
                {7, 0},
                {13, 0},
                {13, 4},
                {16, 4},
                {16, 6},
                {-2, 6},
                {-2, 4},
                {0, 4}});
}

ScanOptions halfCircle() {
  ScanOptions options;
  options.field_of_view = kPi;
  options.beams = 180;
  options.sigma = 0.01;
  return options;
}

/// The set of a robot that drives along poses, its wheels off by so many times what their noise
/// allows.
ScanSet setAlong(const PolygonMap& map, const std::vector<TPose2D>& poses,
                 const ScanOptions& options, Random& random, double times = 1.0) {
  std::vector<Moment> moments;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    Motion motion;
    if (k > 0) {
      motion = measuredMotion(poses[k] - poses[k - 1]);
      TPose2D off = motion.pose_before_after;
      off.x += times * std::sqrt(motion.covariance(0, 0)) * random.normal();
      off.y += times * std::sqrt(motion.covariance(1, 1)) * random.normal();
      off.phi += times * std::sqrt(motion.covariance(2, 2)) * random.normal();
      motion = measuredMotion(off);
    }
    ScanOptions of_scan = options;
    of_scan.seed = options.seed + static_cast<std::uint32_t>(k);
    moments.push_back({{simulatedScan(map, poses[k], of_scan)}, motion, false});
  }
  return ScanSet(std::move(moments));
}

class ScanSets : public InAsymmetricRoom {};

TEST_F(ScanSets, OfOneScanGiveExactlyItsAnswer) {
  std::mt19937 random(4);
  for (const TPoint2D& p : randomFreePoints(localizer().map(), 12, random)) {
    ScanOptions options = halfCircle();
    options.short_share = 0.2;
    options.seed = static_cast<std::uint32_t>(random());
    const RangeScan scan = simulatedScan(localizer().map(), {p.x, p.y, 0.7}, options);
    PosePrior prior;
    if (random() % 2 == 0) prior.near = PosePrior::Disk{p.x, p.y, 1.0};
    const LocalizationResult alone = localizer().localize(scan, prior);
    const LocalizationResult set = localizer().localize(ScanSet(scan), prior);
    EXPECT_EQ(alone.status, set.status);
    EXPECT_EQ(alone.match_probability, set.match_probability);
    ASSERT_EQ(alone.hypotheses.size(), set.hypotheses.size());
    for (std::size_t i = 0; i < alone.hypotheses.size(); ++i) {
      EXPECT_EQ(alone.hypotheses[i].pose_map_robot, set.hypotheses[i].pose_map_robot);
      EXPECT_EQ(alone.hypotheses[i].weight, set.hypotheses[i].weight);
      EXPECT_EQ(alone.hypotheses[i].covariance, set.hypotheses[i].covariance);
    }
    EXPECT_EQ(alone.certificate->cost, set.certificate->cost);
  }
}

TEST_F(ScanSets, TheSameScanTwiceIsRankedAsOnce) {
  // A robot that stands still learns nothing by looking again: weights stay.
  const RangeScan scan = simulatedScan(localizer().map(), {1, 1, 0.4}, halfCircle());
  const LocalizationResult alone = localizer().localize(scan);
  const LocalizationResult twice =
      localizer().localize(ScanSet({{{scan}, {}, false}, {{scan}, {}, false}}));
  EXPECT_EQ(alone.status, twice.status);
  ASSERT_FALSE(twice.hypotheses.empty());
  EXPECT_LT(distanceBetween(alone.hypotheses[0].pose_map_robot, twice.hypotheses[0].pose_map_robot),
            0.01);
  EXPECT_NEAR(alone.hypotheses[0].weight, twice.hypotheses[0].weight, 0.02);
  expectConsistent(twice);
}

TEST_F(ScanSets, IndependentMomentsGiveTheOddsOfAMatchOnceEach) {
  // A third of the beams are cut short: it fits, but not so well that nothing is left to add.
  ScanOptions options = halfCircle();
  options.short_share = 0.35;
  options.seed = 7;
  const auto logOdds = [](double p) { return std::log(p / (1.0 - p)); };
  const RangeScan scan = simulatedScan(localizer().map(), {1, 1, 0.4}, options);
  const auto apart = [&](double metres) {
    // The same scan, as if it were taken again so far on: only the wheels' word differs.
    const MomentWeights weights(
        ScanSet({{{scan}, {}, false}, {{scan}, measuredMotion({metres, 0, 0}), false}}), {});
    return weights.independent;
  };
  ASSERT_NEAR(apart(0.0), 1.0, 1e-6);
  ASSERT_GT(apart(3.0), 1.5);
  const double alone = logOdds(localizer().localize(scan).match_probability);
  const LocalizationResult still =
      localizer().localize(ScanSet({{{scan}, {}, false}, {{scan}, {}, false}}));
  EXPECT_NEAR(logOdds(still.match_probability), alone, 0.3) << "standing still adds nothing";
  // Driven along, scan by scan: the odds of the mean features, to the power of their number.
  Random random(2);
  const std::vector<TPose2D> poses{{1, 1, 0.4}, {3, 1.2, 0.4}, {5, 1.4, 0.4}};
  const ScanSet drive = setAlong(localizer().map(), poses, options, random);
  const LocalizationResult moved = localizer().localize(drive);
  ASSERT_TRUE(moved.features.has_value());
  const double of_one =
      localizer().params().hypotheses.calibration.matchProbability(*moved.features);
  ASSERT_GT(of_one, 0.5);
  ASSERT_LT(of_one, 1.0);
  const double independent = MomentWeights(drive, localizer().params().correlation).independent;
  EXPECT_NEAR(logOdds(moved.match_probability), independent * logOdds(of_one), 1e-6);
}

TEST_F(ScanSets, KeepToThePriorOfNow) {
  Random random(2);
  const std::vector<TPose2D> poses{{1, 1, 0}, {2, 1, 0.3}, {2.6, 1.4, 0.9}};
  const ScanSet set = setAlong(localizer().map(), poses, halfCircle(), random);
  PosePrior right, wrong;
  right.near = PosePrior::Disk{2.5, 1.5, 0.4};
  right.compass = PosePrior::Compass{0.9, 0.1};
  wrong.near = PosePrior::Disk{6, 1, 0.4};
  const LocalizationResult found = localizer().localize(set, right);
  ASSERT_EQ(found.status, LocalizationStatus::unique);
  EXPECT_LT(distanceBetween(found.hypotheses[0].pose_map_robot, poses.back()), 0.05);
  for (const Hypothesis& h : localizer().localize(set, wrong).hypotheses) {
    EXPECT_LE(std::hypot(h.pose_map_robot.x - 6, h.pose_map_robot.y - 1), 0.4 + 1e-9);
  }
}

TEST(ScanSetLaws, ADriveTellsApartWhatOneScanDoesNot) {
  const PolygonMap map = twinRooms();
  const GlobalLocalizer localizer(map);
  Random random(7);
  // Facing a room's lower end both rooms look alike; coming from above they do not.
  std::size_t alone_unique = 0, unique = 0, right = 0;
  for (int i = 0; i < 8; ++i) {
    const double x = i % 2 == 0 ? 3.0 : 10.0;
    const double off = 0.1 * i;
    const std::vector<TPose2D> poses{
        {x - 0.5, 5.4, -0.4}, {x, 4.6, -1.5}, {x + off, 3.8, -1.57}, {x + off, 3.0, -1.57}};
    const ScanSet set = setAlong(map, poses, halfCircle(), random);
    alone_unique +=
        localizer.localize(set.now().scans.front()).status == LocalizationStatus::unique;
    const LocalizationResult result = localizer.localize(set);
    expectConsistent(result);
    unique += result.status == LocalizationStatus::unique;
    right += !result.hypotheses.empty() &&
             distanceBetween(result.hypotheses[0].pose_map_robot, poses.back()) < 0.1;
  }
  EXPECT_LE(alone_unique, 2U);
  EXPECT_EQ(right, 8U);
  EXPECT_GE(unique, 7U);
}

/// Along the corridor of the twin rooms, and down into one of them.
std::vector<TPose2D> wayIntoRoom(double x_of_room) {
  constexpr double kStep = 0.4, kStraight = 2.2, kRadius = 1.0;
  std::vector<TPose2D> way;
  for (double s = 0.0; s < 4.6; s += kStep) {
    const double turn = std::clamp((s - kStraight) / kRadius, 0.0, kPi / 2);
    const double on = std::min(s, kStraight);
    const double beyond = std::max(0.0, s - kStraight - kPi / 2 * kRadius);
    way.push_back({x_of_room - kStraight - kRadius + on + kRadius * std::sin(turn),
                   5.0 - kRadius * (1.0 - std::cos(turn)) - beyond, -turn});
  }
  return way;
}

TEST(ScanSetLaws, WheelsThatAreWorseThanTheySayDoNoHarm) {
  const PolygonMap map = twinRooms();
  const GlobalLocalizer localizer(map);
  ScanOptions options = halfCircle();
  options.short_share = 0.1;
  for (const double times : {1.0, 5.0, 12.0}) {
    Random random(11);
    std::vector<double> scales;
    std::size_t right = 0, wrong_unique = 0, refused = 0;
    constexpr std::size_t kDrives = 16;
    for (std::size_t i = 0; i < kDrives; ++i) {
      options.seed = static_cast<std::uint32_t>(100 * i);
      const std::vector<TPose2D> poses = wayIntoRoom(i % 2 == 0 ? 3.0 : 10.0);
      const LocalizationResult result =
          localizer.localize(setAlong(map, poses, options, random, times));
      expectConsistent(result);
      const bool is_right =
          !result.hypotheses.empty() &&
          distanceBetween(result.hypotheses[0].pose_map_robot, poses.back()) < 0.1;
      right += is_right;
      wrong_unique += !is_right && result.status == LocalizationStatus::unique;
      refused += result.status == LocalizationStatus::no_match;
      scales.push_back(result.wheel_scale);
    }
    EXPECT_EQ(right, kDrives) << times;
    EXPECT_EQ(wrong_unique, 0U) << times;
    EXPECT_EQ(refused, 0U) << times;
    std::sort(scales.begin(), scales.end());
    const double middle = scales[kDrives / 2];
    EXPECT_GE(middle, times / 1.5) << times;
    EXPECT_LE(middle, times * 1.3) << times;
  }
}

TEST(ScanSetLaws, TwoLasersDoAsWellAsOneOfAllTheirBeams) {
  FloorPlanParams plan;
  plan.rooms_per_side = 3;
  plan.furniture_per_room = 2;
  const PolygonMap map = floorPlan(plan, 5);
  const GlobalLocalizer localizer(map);
  std::mt19937 random(8);
  std::size_t joined_right = 0, right = 0, count = 0;
  for (const TPoint2D& p : randomFreePoints(map, 25, random)) {
    ScanOptions options;
    options.sigma = 0.02;
    options.short_share = 0.2;
    options.seed = static_cast<std::uint32_t>(random());
    const TPose2D truth{p.x, p.y, 0.3};
    const RangeScan whole = simulatedScan(map, truth, options);
    std::vector<Beam> front, rear;
    for (const Beam& beam : whole.beams()) {
      (std::abs(beam.bearing) < kPi / 2 ? front : rear).push_back(beam);
    }
    const LocalizationResult a = localizer.localize(whole);
    const LocalizationResult b =
        localizer.localize(ScanSet(std::vector<RangeScan>{RangeScan(front), RangeScan(rear)}));
    const auto is_right = [&](const LocalizationResult& r) {
      return !r.hypotheses.empty() && distanceBetween(r.hypotheses[0].pose_map_robot, truth) < 0.1;
    };
    joined_right += is_right(a);
    right += is_right(b);
    ++count;
  }
  EXPECT_GE(right + 1, joined_right);
  EXPECT_GE(right, count - 2);
}

TEST_F(ScanSets, TooFewBeamsAndABudgetAreDefined) {
  const RangeScan few({{0.1, 1.0, BeamKind::hit}});
  EXPECT_EQ(localizer().localize(ScanSet(std::vector<RangeScan>{few, few})).status,
            LocalizationStatus::too_few_beams);
  Random random(3);
  const ScanSet set = setAlong(localizer().map(), {{1, 1, 0}, {1.5, 1, 0}}, halfCircle(), random);
  SearchOptions options;
  options.time_budget_ms = 1e-6;
  EXPECT_NE(localizer().localize(set, {}, options).status, LocalizationStatus::unique);
  std::atomic<bool> cancel{true};
  options = {};
  options.cancel = &cancel;
  EXPECT_NE(localizer().localize(set, {}, options).status, LocalizationStatus::unique);
}

}  // namespace
}  // namespace mrpt_polyloc::test
