#include "travel_support.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/travel/SafeSet.h>

#include <gtest/gtest.h>

#include <cmath>
#include <queue>
#include <random>
#include <set>
#include <tests/support/map_factories.h>
#include <tests/support/random_maps.h>

namespace mrpt_polyloc::test {
namespace {

SafeSetParams exactly(double radius) {
  SafeSetParams params;
  params.robot_radius = radius;
  params.deviations = 0.0;
  params.reach = 20.0;
  return params;
}

/// Hypotheses at random free places with some room.
std::vector<Hypothesis> randomHypotheses(const PolygonMap& map, std::size_t count,
                                         std::mt19937& random, double room) {
  std::vector<Hypothesis> hypotheses;
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  while (hypotheses.size() < count) {
    const TPoint2D p = randomFreePoints(map, 1, random)[0];
    if (signedClearance(map, p) < room) continue;
    hypotheses.push_back(hypothesisAt(p.x, p.y, angle(random), 1.0 / static_cast<double>(count)));
  }
  return hypotheses;
}

TEST(SafeSet, IsFreeInTheMapOfEveryHypothesis) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const PolygonMap map = floorPlan(smallFlat(), seed);
    const ClearanceField field(map, 0.6);
    std::mt19937 random(seed);
    const auto hypotheses = randomHypotheses(map, 1 + seed % 3, random, 0.4);
    const SafeSet safe(field, hypotheses, Sight({}, 0.25), exactly(0.25));
    ASSERT_FALSE(safe.reached().empty());
    for (const SafeSet::Place& place : safe.reached()) {
      for (const Hypothesis& hypothesis : hypotheses) {
        EXPECT_GE(signedClearance(map, inMap(hypothesis, place.point)), 0.25);
      }
    }
  }
}

/// What a flood of its own over the same squares reaches, with distances by brute force.
TEST(SafeSet, ReachesAllThatAFloodReaches) {
  const PolygonMap map = floorPlan(smallFlat(), 3);
  const ClearanceField field(map, 0.6);
  std::mt19937 random(3);
  const auto hypotheses = randomHypotheses(map, 2, random, 0.5);
  const SafeSet safe(field, hypotheses, Sight({}, 0.25), exactly(0.25));
  const auto isFree = [&](int column, int row, double room) {
    return std::all_of(hypotheses.begin(), hypotheses.end(), [&](const Hypothesis& h) {
      return signedClearance(map, inMap(h, {0.1 * column, 0.1 * row})) >= room;
    });
  };
  std::set<std::pair<int, int>> reached{{0, 0}};
  std::queue<std::pair<int, int>> queue;
  queue.emplace(0, 0);
  while (!queue.empty()) {
    const auto [column, row] = queue.front();
    queue.pop();
    // A little more room than is asked for: the table rounds by 3.5 cm.
    EXPECT_TRUE(safe.isReached({0.1 * column, 0.1 * row})) << column << ' ' << row;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const std::pair<int, int> next{column + dx, row + dy};
      if (std::hypot(next.first, next.second) > 150.0) continue;
      if (isFree(next.first, next.second, 0.336) && reached.insert(next).second) queue.push(next);
    }
  }
  EXPECT_GT(reached.size(), 30u);
}

TEST(SafeSet, LeadsAlongWaysThatAreSafe) {
  const PolygonMap map = floorPlan(smallFlat(), 5);
  const ClearanceField field(map, 0.6);
  std::mt19937 random(5);
  const auto hypotheses = randomHypotheses(map, 1, random, 0.5);
  const SafeSet safe(field, hypotheses, Sight({}, 0.25), exactly(0.25));
  for (const SafeSet::Place& place : safe.places(1.0)) {
    const std::vector<TPoint2D> path = safe.pathTo(place.point);
    ASSERT_FALSE(path.empty());
    double length = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) {
      length += (path[i] - path[i - 1]).norm();
      for (int k = 0; k <= 20; ++k) {
        const TPoint2D p = path[i - 1] + (path[i] - path[i - 1]) * (k / 20.0);
        EXPECT_GE(signedClearance(map, inMap(hypotheses[0], p)), 0.25);
      }
    }
    EXPECT_LE(length, place.distance + 1e-6);
    EXPECT_GE(length, place.point.norm() - 1e-6);
    EXPECT_NEAR(path.back().x, place.point.x, 1e-9);
  }
  EXPECT_TRUE(safe.pathTo({-19.0, -19.0}).empty());
}

TEST(SafeSet, DoesNotPassDoorsThatAreNarrowerThanTheRobot) {
  // Two rooms joined by a passage of 0.5 m.
  const PolygonMap map = mapOf({{0, 0},
                                {4, 0},
                                {4, 1.8},
                                {4.5, 1.8},
                                {4.5, 0},
                                {8, 0},
                                {8, 4},
                                {4.5, 4},
                                {4.5, 2.3},
                                {4, 2.3},
                                {4, 4},
                                {0, 4}});
  const std::vector<Hypothesis> at{hypothesisAt(2, 2, 0, 1.0)};
  const ClearanceField field(map, 0.6);
  const Sight nothing({}, 0.25);
  EXPECT_FALSE(SafeSet(field, at, nothing, exactly(0.3)).isReached({4, 0}));
  EXPECT_TRUE(SafeSet(field, at, nothing, exactly(0.15)).isReached({4, 0}));
}

TEST(SafeSet, KeepsOffWhatScansHitAndTakesWhatTheySawFree) {
  const PolygonMap hall = squareMap(10.0);
  // The map of another hypothesis: a cell of 1.6 m.
  const PolygonMap map =
      PolygonMap({freePolygon(rectangle(0, 0, 10, 10)), freePolygon(rectangle(20, 0, 21.6, 1.6))});
  const ClearanceField field(map, 0.6);
  const std::vector<Hypothesis> both{hypothesisAt(5, 5, 0, 0.5), hypothesisAt(20.8, 0.8, 0, 0.5)};
  const Sight nothing({}, 0.25);
  EXPECT_FALSE(SafeSet(field, both, nothing, exactly(0.25)).isReached({3, 0}));

  // A box stands in the hall that no map has.
  const PolygonMap world = mapOf(rectangle(0, 0, 10, 10), {rectangle(6.5, 4.5, 7.0, 5.5)});
  const Sight sight({{castScan(WallSegments(world), {5, 5, 0}), {0, 0, 0}}}, 0.25);
  for (const auto& hypotheses : {both, std::vector<Hypothesis>{both[0]}}) {
    const SafeSet safe(field, hypotheses, sight, exactly(0.25));
    EXPECT_TRUE(safe.isReached({-3, 0}));
    EXPECT_FALSE(safe.isReached({1.3, 0})) << "it would touch the box";
    EXPECT_TRUE(safe.isReached({1.1, 0}));
    EXPECT_EQ(safe.isReached({3, 0}), hypotheses.size() == 1) << "behind the box";
  }
}

TEST(SafeSet, LetsTheRobotLeaveAWallThatItIsTooCloseTo) {
  const PolygonMap map = squareMap(10.0);
  const ClearanceField field(map, 0.6);
  const std::vector<Hypothesis> at{hypothesisAt(0.26, 5, 0, 1.0)};
  const Sight sight({{castScan(WallSegments(map), {0.26, 5, 0}), {0, 0, 0}}}, 0.25);
  const SafeSet safe(field, at, sight, exactly(0.25));
  EXPECT_TRUE(safe.isStartFree());
  EXPECT_TRUE(safe.isReached({4, 0}));
  EXPECT_FALSE(safe.isReached({-0.15, 0}));

  const Sight touching({{castScan(WallSegments(map), {0.1, 5, 0}), {0, 0, 0}}}, 0.25);
  const SafeSet stuck(field, {hypothesisAt(0.1, 5, 0, 1.0)}, touching, exactly(0.25));
  EXPECT_FALSE(stuck.isStartFree());
  EXPECT_TRUE(stuck.reached().empty());
}

TEST(SafeSet, TakesTheMajoritysWordIfAsked) {
  const PolygonMap map =
      PolygonMap({freePolygon(rectangle(0, 0, 10, 10)), freePolygon(rectangle(20, 0, 21.6, 1.6))});
  const ClearanceField field(map, 0.6);
  SafeSetParams majority = exactly(0.25);
  majority.quorum = 0.5;
  const auto reaches = [&](double weight) {
    const std::vector<Hypothesis> both{hypothesisAt(5, 5, 0, weight),
                                       hypothesisAt(20.8, 0.8, 0, 1.0 - weight)};
    return SafeSet(field, both, Sight({}, 0.25), majority).isReached({3, 0});
  };
  EXPECT_TRUE(reaches(0.6));
  EXPECT_FALSE(reaches(0.4));
}

TEST(SafeSet, NamesBadParameters) {
  SafeSetParams params;
  params.robot_radius = -1.0;
  EXPECT_THROW(params.check(), InvalidParamsError);
  params = {};
  params.reach = 1e9;
  EXPECT_THROW(params.check(), InvalidParamsError);
  params = {};
  params.quorum = 1.5;
  EXPECT_THROW(params.check(), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc::test
