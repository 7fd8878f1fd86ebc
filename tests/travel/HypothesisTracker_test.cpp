#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/travel/HypothesisTracker.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

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

/// A robot that drives backwards out of a room, looking down: nothing tells the rooms apart until
/// it turns in the corridor.
std::vector<TPose2D> wayOut(double x) {
  std::vector<TPose2D> way;
  for (double y = 1.0; y < 4.9; y += 0.3) way.emplace_back(x, y, -kPi / 2);
  for (double turn = 0.2; turn < kPi / 2; turn += 0.3) way.emplace_back(x, 4.9, -kPi / 2 + turn);
  for (double further = 0.3; further < 1.6; further += 0.3) way.emplace_back(x + further, 4.9, 0.0);
  return way;
}

/// What wheels with the default noise measure between two poses.
Motion measured(const TPose2D& before, const TPose2D& after, Random& random) {
  const Motion exact = measuredMotion(after - before);
  TPose2D off = exact.pose_before_after;
  off.x += std::sqrt(exact.covariance(0, 0)) * random.normal();
  off.y += std::sqrt(exact.covariance(1, 1)) * random.normal();
  off.phi += std::sqrt(exact.covariance(2, 2)) * random.normal();
  return measuredMotion(off);
}

class Tracker : public ::testing::Test {
 protected:
  static RangeScan scanAt(const PolygonMap& map, const TPose2D& pose, std::uint32_t seed) {
    ScanOptions options;
    options.field_of_view = kPi;
    options.beams = 180;
    options.sigma = 0.02;
    options.seed = seed;
    return simulatedScan(map, pose, options);
  }

  /// What holds after every scan.
  static void expectConsistent(const TrackingState& state) {
    double sum = state.none_probability;
    std::set<std::uint64_t> ids;
    for (std::size_t i = 0; i < state.hypotheses.size(); ++i) {
      const TrackedHypothesis& h = state.hypotheses[i];
      EXPECT_TRUE(ids.insert(h.id).second);
      EXPECT_GT(h.weight, 0.0);
      EXPECT_GT(h.covariance(0, 0), 0.0);
      sum += h.weight;
      if (i > 0) {
        EXPECT_LE(h.weight, state.hypotheses[i - 1].weight);
      }
    }
    EXPECT_NEAR(sum, 1.0, 1e-9);
    for (const std::uint64_t id : state.dropped) EXPECT_EQ(ids.count(id), 0U);
    for (const std::uint64_t id : state.merged) EXPECT_EQ(ids.count(id), 0U);
  }

  const PolygonMap map_ = twinRooms();
  const GlobalLocalizer localizer_{map_};
};

TEST_F(Tracker, FollowsTwinsUntilTheDriveTellsThemApart) {
  for (const double x : {2.5, 9.5}) {
    Random random(3);
    HypothesisTracker tracker(localizer_);
    const std::vector<TPose2D> way = wayOut(x);
    LocalizationStatus last = LocalizationStatus::too_few_beams;
    for (std::size_t i = 0; i < way.size(); ++i) {
      if (i > 0) tracker.move(measured(way[i - 1], way[i], random));
      const TrackingState& state =
          tracker.update(scanAt(map_, way[i], static_cast<std::uint32_t>(i)));
      expectConsistent(state);
      if (way[i].y < 3.0) {
        EXPECT_EQ(state.status, LocalizationStatus::ambiguous) << way[i].y;
      }
      // The right one is never lost.
      double nearest = 1e9;
      for (const TrackedHypothesis& h : state.hypotheses) {
        nearest = std::min(nearest, distanceBetween(h.pose_map_robot, way[i]));
      }
      EXPECT_LT(nearest, 0.1) << i;
      EXPECT_EQ(state.has_searched, i == 0);
      last = state.status;
    }
    ASSERT_EQ(last, LocalizationStatus::unique);
    const LocalizationResult result = tracker.result();
    EXPECT_LT(distanceBetween(result.hypotheses.front().pose_map_robot, way.back()), 0.05);
    EXPECT_GT(result.hypotheses.front().weight, 0.95);
    EXPECT_GT(tracker.state().travelled, 4.0);
  }
}

TEST_F(Tracker, IsDeterministicAndCopiesGoTheirOwnWay) {
  const std::vector<TPose2D> way = wayOut(2.5);
  HypothesisTracker a(localizer_), b(localizer_);
  for (std::size_t i = 0; i < 4; ++i) {
    const Motion motion = i == 0 ? Motion() : measuredMotion(way[i] - way[i - 1]);
    a.move(motion);
    b.move(motion);
    a.update(scanAt(map_, way[i], 1));
    b.update(scanAt(map_, way[i], 1));
  }
  const auto weights = [](const HypothesisTracker& tracker) {
    std::vector<double> all{tracker.state().none_probability};
    for (const auto& h : tracker.state().hypotheses) {
      all.insert(all.end(), {h.weight, h.pose_map_robot.x, h.covariance(2, 2)});
    }
    return all;
  };
  EXPECT_EQ(weights(a), weights(b));
  const auto before = weights(a);
  HypothesisTracker copy = a;
  copy.move(measuredMotion({0.5, 0, 0}));
  copy.update(scanAt(map_, {9.5, 3, -1.5}, 4));
  EXPECT_EQ(weights(a), before);
}

TEST_F(Tracker, SearchesAnewWhenTheRobotWasCarried) {
  HypothesisTracker tracker(localizer_);
  tracker.update(scanAt(map_, {14, 5, 0.1}, 1));
  for (std::uint32_t i = 1; i < 4; ++i) {
    tracker.move(measuredMotion({0.2, 0, 0}));
    tracker.update(scanAt(map_, TPose2D(14, 5, 0.1) + TPose2D(0.2 * i, 0, 0), i));
  }
  ASSERT_EQ(tracker.state().status, LocalizationStatus::unique);
  // Carried to the other end; there it drives on.
  bool has_searched = false;
  TPose2D pose(-1.0, 5.0, 0.4);
  for (std::uint32_t i = 0; i < 12; ++i) {
    const TPose2D next = pose + TPose2D(0.15, 0, -0.02);
    if (i > 0) {
      tracker.move(measuredMotion(next - pose));
      pose = next;
    }
    tracker.update(scanAt(map_, pose, i));
    expectConsistent(tracker.state());
    has_searched = has_searched || tracker.state().has_searched;
  }
  EXPECT_TRUE(has_searched);
  ASSERT_FALSE(tracker.state().hypotheses.empty());
  EXPECT_LT(distanceBetween(tracker.state().hypotheses.front().pose_map_robot, pose), 0.1);
  EXPECT_EQ(tracker.state().status, LocalizationStatus::unique);
}

TEST_F(Tracker, AScanThatSaysTooLittleChangesNothing) {
  HypothesisTracker tracker(localizer_);
  const RangeScan empty((std::vector<Beam>()));
  EXPECT_EQ(tracker.update(empty).status, LocalizationStatus::too_few_beams);
  EXPECT_TRUE(tracker.result().hypotheses.empty());
  tracker.update(scanAt(map_, {14, 5, 0.1}, 1));
  const double weight = tracker.state().hypotheses.front().weight;
  EXPECT_EQ(tracker.update(empty).hypotheses.front().weight, weight);
  EXPECT_THROW(tracker.move(measuredMotion({std::nan(""), 0, 0})), InvalidParamsError);
  tracker.reset();
  EXPECT_EQ(tracker.state().status, LocalizationStatus::too_few_beams);
}

TEST_F(Tracker, IsResetWithWhatIsKnownOfThePose) {
  HypothesisTracker tracker(localizer_);
  const TPose2D pose(2.5, 1, -kPi / 2);
  ASSERT_GE(tracker.update(scanAt(map_, pose, 5)).hypotheses.size(), 2U);  // twins
  PosePrior prior;
  prior.near = PosePrior::Disk{pose.x, pose.y, 1.0};
  tracker.reset(prior);
  for (const TrackedHypothesis& h : tracker.update(scanAt(map_, pose, 5)).hypotheses) {
    EXPECT_LT(distanceBetween(h.pose_map_robot, {pose.x, pose.y, h.pose_map_robot.phi}), 1.01);
  }
  tracker.reset();  // which keeps it
  EXPECT_EQ(tracker.update(scanAt(map_, pose, 5)).status, LocalizationStatus::unique);
  tracker.reset(PosePrior());
  EXPECT_GE(tracker.update(scanAt(map_, pose, 5)).hypotheses.size(), 2U);
  prior.near->radius = -1.0;
  EXPECT_THROW(tracker.reset(prior), InvalidParamsError);
}

TEST_F(Tracker, LookingTwiceFromOnePlaceDecidesNothing) {
  // Twins that differ by noise alone: no number of looks may make one of them sure.
  HypothesisTracker tracker(localizer_);
  for (int i = 0; i < 10; ++i) tracker.update(scanAt(map_, {2.5, 1, -kPi / 2}, 5));
  EXPECT_EQ(tracker.state().status, LocalizationStatus::ambiguous);
}

TEST_F(Tracker, GoesOnWithWhatASearchOfADriveFound) {
  const std::vector<TPose2D> way = wayOut(2.5);
  Random random(4);
  HypothesisTracker tracker(localizer_);
  tracker.update(scanAt(map_, {11.0, 2.0, 0.0}, 1));  // elsewhere
  std::vector<Moment> drive(1);
  drive[0].scans = {scanAt(map_, way[0], 2)};
  for (std::size_t i = 1; i < 6; ++i) {
    drive.push_back({{scanAt(map_, way[i], static_cast<std::uint32_t>(i))},
                     measured(way[i - 1], way[i], random),
                     false});
  }
  const LocalizationResult found = localizer_.localize(ScanSet(drive));
  ASSERT_GE(found.hypotheses.size(), 2U) << "the twin rooms";
  const TrackingState& state = tracker.start(found);
  expectConsistent(state);
  EXPECT_TRUE(state.has_searched);
  EXPECT_EQ(state.scans, 1U) << "it took none";
  EXPECT_EQ(state.listed, found.listed);
  EXPECT_NEAR(state.none_probability, 1.0 - std::min(found.match_probability * found.listed, 0.999),
              1e-3);
  for (const Hypothesis& hypothesis : found.hypotheses) {
    if (hypothesis.weight < 1e-3) continue;  // hopeless
    double least = 1e9;
    for (const TrackedHypothesis& tracked : state.hypotheses) {
      least = std::min(least, distanceBetween(tracked.pose_map_robot, hypothesis.pose_map_robot));
    }
    EXPECT_LT(least, 0.3);
  }
  // It follows them.
  for (std::size_t i = 6; i < way.size(); ++i) {
    tracker.move(measured(way[i - 1], way[i], random));
    tracker.update(scanAt(map_, way[i], static_cast<std::uint32_t>(i)));
  }
  EXPECT_EQ(tracker.state().status, LocalizationStatus::unique);
  EXPECT_LT(distanceBetween(tracker.state().hypotheses.front().pose_map_robot, way.back()), 0.05);
  // Of what found nothing nothing is left.
  EXPECT_EQ(tracker.start(LocalizationResult()).status, LocalizationStatus::too_few_beams);
  EXPECT_TRUE(tracker.state().hypotheses.empty());
}

TEST_F(Tracker, SaysWhenItsListIsCut) {
  HypothesisTrackerParams few;
  few.max_hypotheses = 1;
  HypothesisTracker cut(localizer_, few), whole(localizer_);
  const RangeScan twin = scanAt(map_, {2.5, 1.0, -kPi / 2}, 1);
  EXPECT_EQ(cut.update(twin).listed, 0.0);
  EXPECT_GT(whole.update(twin).listed, 0.97);
  // Two are enough where one is right, and who is behind it is hopeless.
  few.max_hypotheses = 2;
  HypothesisTracker enough(localizer_, few);
  EXPECT_GT(enough.update(scanAt(map_, {14.0, 5.0, kPi}, 1)).listed, 0.97);
}

TEST_F(Tracker, RefusesParamsOutOfRange) {
  HypothesisTrackerParams params;
  params.most_odds = 0.5;
  EXPECT_THROW(HypothesisTracker(localizer_, params), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc::test
