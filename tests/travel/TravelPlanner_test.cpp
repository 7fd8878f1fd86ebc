#include "travel_support.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/travel/TravelPlanner.h>

#include <gtest/gtest.h>

#include <cmath>
#include <tests/support/map_factories.h>
#include <tests/support/random_maps.h>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

/// A corridor of 20 m with a niche at one end: 180 degrees around its middle it is itself but for
/// that niche.
PolygonMap corridor(bool with_niche) {
  if (!with_niche) return mapOf(rectangle(0, 0, 20, 2));
  return mapOf({{0, 0}, {20, 0}, {20, 2}, {19, 2}, {19, 3}, {17.5, 3}, {17.5, 2}, {0, 2}});
}

TravelSituation twoEnds(const PolygonMap& map, double x, double max_range = 4.0) {
  TravelSituation situation;
  situation.hypotheses = {hypothesisAt(x, 1, 0, 0.5), hypothesisAt(20 - x, 1, kPi, 0.5)};
  situation.scans = {{castScan(WallSegments(map), {x, 1, 0}, 360, max_range), {0, 0, 0}}};
  return situation;
}

TravelPlannerParams with(TravelStrategy strategy) {
  TravelPlannerParams params;
  params.strategy = strategy;
  return params;
}

double lengthOf(const std::vector<TPoint2D>& way) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).norm();
  return length;
}

MapIndex::Ptr indexOf(const PolygonMap& map) {
  MapIndexParams params;
  params.threads = 1;
  return MapIndex::deferred(map, params);
}

TEST(TravelPlanner, JudgesScansAsTheMapsCellsAllow) {
  const PolygonMap map = corridor(true);
  const MapIndex::Ptr traced = MapIndex::build(PolygonMap(map.components(), {}, 0.2));
  EXPECT_EQ(TravelPlanner(traced).params().evidence.cell_size, 0.2);
  EXPECT_EQ(TravelPlanner(indexOf(map)).params().evidence.cell_size, 0.0);
}

TEST(TravelPlanner, GoesWhereTheScanDiffers) {
  const PolygonMap map = corridor(true);
  const WallSegments walls(map);
  for (const TravelStrategy strategy :
       {TravelStrategy::greedy, TravelStrategy::nearest, TravelStrategy::majority}) {
    SCOPED_TRACE(toString(strategy));
    const TravelPlanner planner(indexOf(map), with(strategy));
    const TravelSituation situation = twoEnds(map, 10.5);
    const TravelPlan plan = planner.plan(situation);
    ASSERT_EQ(plan.status, TravelStatus::go);
    // The niche is seen from some 13.5 m on, by the robot or by its rival.
    EXPECT_GT(plan.distance, 2.0);
    EXPECT_LT(plan.distance, 6.0);
    // All of it, but the nearest place only as much as counts as told apart (and that of the
    // majority's map is near).
    const double least = strategy == TravelStrategy::greedy ? 0.95 : 0.9;
    EXPECT_GE(plan.value, least);
    EXPECT_LE(plan.value, 1.0 + 1e-9);
    ASSERT_EQ(plan.falls.size(), 2u);
    EXPECT_NEAR(plan.falls[0], 0.5 * plan.value, 0.02);
    // By rays: what both expect at the goal differs.
    int different = 0;
    for (int k = 0; k < 360; ++k) {
      double ranges[2];
      for (std::size_t h = 0; h < 2; ++h) {
        const Hypothesis& hypothesis = situation.hypotheses[h];
        ranges[h] = std::min(4.0, walls.range(inMap(hypothesis, {plan.goal.x, plan.goal.y}),
                                              hypothesis.pose_map_robot.phi + k * kDegree));
      }
      different += std::abs(ranges[0] - ranges[1]) > 0.2;
    }
    EXPECT_GT(different, 3);
    EXPECT_LE(std::hypot(plan.waypoint.x, plan.waypoint.y), 2.0 + 1e-6) << "a leg";
    const bool turns = std::abs(plan.waypoint.phi) > 0.5;
    EXPECT_EQ(plan.way.size() == 1, turns) << "turn first, then drive";
  }
}

TEST(TravelPlanner, RecognizesWhatCannotBeToldApart) {
  for (const TravelStrategy strategy : {TravelStrategy::greedy, TravelStrategy::nearest,
                                        TravelStrategy::majority, TravelStrategy::random}) {
    SCOPED_TRACE(toString(strategy));
    const TravelPlanner planner(indexOf(corridor(false)), with(strategy));
    const TravelPlan plan = planner.plan(twoEnds(corridor(false), 6.0));
    EXPECT_EQ(plan.status, TravelStatus::indistinguishable);
    EXPECT_GT(plan.safe_area, 15.0) << "all of the corridor was looked at";
    EXPECT_TRUE(plan.way.empty());
  }
}

/// Of what is read at a place of the common frame, the share of 120 beams that two hypotheses read
/// differently, by rays; neighbouring beams stand in for what the planner takes as uncertain.
double differingShare(const WallSegments& walls, const TravelSituation& situation,
                      const TPoint2D& place, double max_range) {
  constexpr int kBeams = 120;
  std::vector<double> ranges[2];
  for (std::size_t h = 0; h < 2; ++h) {
    const Hypothesis& hypothesis = situation.hypotheses[h];
    for (int k = 0; k < kBeams; ++k) {
      ranges[h].push_back(
          std::min(max_range, walls.range(inMap(hypothesis, place),
                                          hypothesis.pose_map_robot.phi + 2.0 * kPi * k / kBeams)));
    }
  }
  int differing = 0;
  for (int k = 0; k < kBeams; ++k) {
    double least = max_range;
    for (const int j : {k + kBeams - 1, k, k + 1}) {
      least = std::min(least, std::abs(ranges[0][static_cast<std::size_t>(k)] -
                                       ranges[1][static_cast<std::size_t>(j % kBeams)]));
    }
    differing += least > 0.15;
  }
  return static_cast<double>(differing) / kBeams;
}

/// Corridors that half a turn maps onto themselves but for a niche, deep or shallow or none: where
/// the planner goes rays differ, and where it says that nothing does, they do nowhere in reach.
TEST(TravelPlanner, AgreesWithRaysOnWhatCanBeTold) {
  int goes = 0, stays = 0;
  for (unsigned seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const double length = random.uniform(8.0, 16.0), range = random.uniform(2.5, 5.0);
    const double depth = seed % 3 == 0 ? 0.0 : (seed % 3 == 1 ? 0.02 : random.uniform(0.4, 1.0));
    const double at = random.uniform(1.0, 0.5 * length - 2.0), wide = random.uniform(0.6, 1.2);
    std::vector<TPoint2D> border{{0, 0}, {length, 0}, {length, 2}};
    if (depth > 0.0) {
      border.emplace_back(at + wide, 2);
      border.emplace_back(at + wide, 2 + depth);
      border.emplace_back(at, 2 + depth);
      border.emplace_back(at, 2);
    }
    border.emplace_back(0, 2);
    const PolygonMap map = mapOf(border);
    const WallSegments walls(map);
    const double x = random.uniform(0.5 * length, length - 1.0);
    TravelSituation situation;
    situation.hypotheses.push_back(hypothesisAt(x, 1, 0, 0.5));
    situation.hypotheses.push_back(hypothesisAt(length - x, 1, kPi, 0.5));
    situation.scans.push_back({castScan(walls, {x, 1, 0}, 360, range), {0, 0, 0}});
    TravelPlannerParams params;
    params.max_range = range;
    const TravelPlanner planner(indexOf(map), params);
    const TravelPlan plan = planner.plan(situation);
    if (plan.status == TravelStatus::go) {
      ++goes;
      EXPECT_GE(differingShare(walls, situation, {plan.goal.x, plan.goal.y}, range), 0.01);
      continue;
    }
    ++stays;
    EXPECT_EQ(plan.status, TravelStatus::indistinguishable);
    for (const SafeSet::Place& place : planner.safeSet(situation).places(0.2)) {
      EXPECT_LE(differingShare(walls, situation, place.point, range), 0.03)
          << place.point.x << ' ' << place.point.y;
    }
  }
  EXPECT_GE(goes, 4);
  EXPECT_GE(stays, 10);
}

TEST(TravelPlanner, KeepsToWhatMayBeDriven) {
  const PolygonMap map = corridor(true);
  const TravelPlanner planner(indexOf(map), {});
  TravelSituation situation = twoEnds(map, 10.5);
  situation.most_distance = 1.5;
  EXPECT_EQ(planner.plan(situation).status, TravelStatus::indistinguishable) << "within reach";
}

TEST(TravelPlanner, DoesNotLookTwiceFromOnePlace) {
  const PolygonMap map = corridor(true);
  const TravelPlanner planner(indexOf(map), with(TravelStrategy::nearest));
  TravelSituation situation = twoEnds(map, 10.5);
  const TravelPlan first = planner.plan(situation);
  ASSERT_EQ(first.status, TravelStatus::go);
  situation.looked = {first.goal};
  const TravelPlan second = planner.plan(situation);
  ASSERT_EQ(second.status, TravelStatus::go);
  EXPECT_GT(std::hypot(first.goal.x - second.goal.x, first.goal.y - second.goal.y), 0.2);
}

TEST(TravelPlanner, DecidesNothingAlone) {
  const PolygonMap map = corridor(true);
  const TravelPlanner planner(indexOf(map), {});
  TravelSituation situation = twoEnds(map, 10.5);
  situation.hypotheses.pop_back();
  EXPECT_EQ(planner.plan(situation).status, TravelStatus::decided);
  situation.hypotheses.clear();
  EXPECT_EQ(planner.plan(situation).status, TravelStatus::decided);
  situation.scans.clear();
  EXPECT_THROW(planner.plan(situation), InvalidParamsError);
}

TEST(TravelPlanner, ExploresWhereNothingIsKnown) {
  const PolygonMap map = corridor(true);
  const TravelPlanner planner(indexOf(map), {});
  TravelSituation situation = twoEnds(map, 10.5);
  situation.hypotheses.clear();
  const TravelPlan plan = planner.explore(situation);
  ASSERT_EQ(plan.status, TravelStatus::go);
  EXPECT_NEAR(plan.distance, 2.0, 0.2) << "where something new is seen";
  // It was there: now the other way.
  situation.looked = {plan.goal};
  const TravelPlan other = planner.explore(situation);
  ASSERT_EQ(other.status, TravelStatus::go);
  EXPECT_LT(plan.goal.x * other.goal.x, 0.0);
}

TEST(TravelPlanner, TurnsARobotThatSeesNothingButAWall) {
  // Half a circle, 0.4 m before the corridor's end: nothing ahead, nothing known behind.
  const PolygonMap map = corridor(false);
  const TravelPlanner planner(indexOf(map), {});
  TravelSituation situation;
  situation.scans = {{castScan(WallSegments(map), {19.6, 1, 0}, 181, 4.0, kPi), {0, 0, 0}}};
  std::vector<double> turns;
  for (TravelPlan plan = planner.explore(situation); plan.status == TravelStatus::go;
       plan = planner.explore(situation)) {
    ASSERT_LT(turns.size(), 4U);
    EXPECT_EQ(plan.waypoint.x, 0.0);
    EXPECT_EQ(plan.waypoint.y, 0.0);
    EXPECT_GT(std::abs(plan.waypoint.phi), 1.0);
    for (const double before : turns) EXPECT_GT(angleBetween(plan.waypoint.phi, before), 1.0);
    turns.push_back(plan.waypoint.phi);
    situation.looked.push_back(plan.waypoint);  // as if it saw nothing there, either
  }
  EXPECT_EQ(turns.size(), 3U) << "then it has looked all around";
  // A laser that says nothing will say nothing elsewhere.
  TravelSituation blind = situation;
  blind.looked.clear();
  blind.scans = {{RangeScan({{0.0, 0.0, BeamKind::invalid}, {0.1, 0.0, BeamKind::invalid}}), {}}};
  TravelPlannerParams known;
  known.max_range = 4.0;
  EXPECT_EQ(TravelPlanner(indexOf(map), known).explore(blind).status, TravelStatus::blocked);
  // One that sees all around has nothing to turn for.
  std::vector<Beam> beams;
  for (int k = 0; k < 360; ++k) beams.push_back({k * kDegree, 0.3, BeamKind::hit});
  situation.scans = {{RangeScan(beams), {0, 0, 0}}};
  EXPECT_EQ(planner.explore(situation).status, TravelStatus::blocked);
}

TEST(TravelPlanner, ExploresTheMapBeforeWhatIsInNone) {
  // A room whose right side is open: what is beyond is seen, but in no map.
  const std::vector<EdgeKind> kinds{EdgeKind::wall, EdgeKind::open, EdgeKind::wall, EdgeKind::wall};
  const PolygonMap map({{Ring{rectangle(0, 0, 6, 4), kinds}, {}}});
  const TravelPlanner planner(indexOf(map), {});
  TravelSituation situation;
  const TPose2D at(4.5, 2, 0);
  situation.scans = {{castScan(WallSegments(map), at, 360, 8.0), {0, 0, 0}}};
  situation.hypotheses = {hypothesisAt(at.x, at.y, at.phi, 1.0)};
  situation.looked = {{-2.0, 0.0, 0.0}};
  const TravelPlan inside = planner.explore(situation);
  ASSERT_EQ(inside.status, TravelStatus::go);
  EXPECT_TRUE(map.contains({at.x + inside.goal.x, at.y + inside.goal.y}));
  // Who knows no map goes where it sees, and so does who has seen all of it.
  TravelSituation lost = situation;
  lost.hypotheses.clear();
  for (double x = -4.0; x < 1.5; x += 0.5) {
    for (double y = -1.5; y < 2.0; y += 0.5) situation.looked.emplace_back(x, y, 0.0);
  }
  for (const TravelSituation& one : {lost, situation}) {
    const TravelPlan away = planner.explore(one);
    ASSERT_EQ(away.status, TravelStatus::go);
    EXPECT_FALSE(map.contains({at.x + away.goal.x, at.y + away.goal.y}));
  }
}

TEST(TravelPlanner, DoubtsOfCentimetresDoNotCloseADoor) {
  // Two equal rooms, each with a door of 0.68 m to a corridor in which they differ.
  const PolygonMap map =
      mapOf({{0, 0},    {4, 0},   {4, 3},   {2.365, 3},   {2.365, 3.2}, {7.635, 3.2}, {7.635, 3},
             {6, 3},    {6, 0},   {10, 0},  {10, 3},      {8.315, 3},   {8.315, 3.2}, {10, 3.2},
             {10, 5.2}, {0, 5.2}, {0, 3.2}, {1.685, 3.2}, {1.685, 3},   {0, 3}});
  TravelSituation situation;
  situation.scans = {{castScan(WallSegments(map), {2.025, 1, kPi / 2}, 360, 1.5), {0, 0, 0}}};
  situation.hypotheses = {hypothesisAt(2.025, 1, kPi / 2, 0.5, 0.05),
                          hypothesisAt(7.975, 1, kPi / 2, 0.5, 0.05)};
  const TravelPlanner planner(indexOf(map), {});
  EXPECT_FALSE(planner.safeSet(situation).isReached({3.0, 0.0})) << "by all doubts: closed";
  const TravelPlan plan = planner.plan(situation);
  ASSERT_EQ(plan.status, TravelStatus::go);
  EXPECT_GT(plan.value, 0.5);
  EXPECT_GT(plan.goal.x, 1.5) << "out of the door";
}

TEST(TravelPlanner, TurnsOnceBeforeAWay) {
  const PolygonMap map = corridor(true);
  const TravelPlanner planner(indexOf(map), {});
  TravelSituation situation = twoEnds(map, 10.5);
  situation.hypotheses = {hypothesisAt(10.5, 1, kPi / 2, 0.5), hypothesisAt(9.5, 1, -kPi / 2, 0.5)};
  situation.scans = {{castScan(WallSegments(map), {10.5, 1, kPi / 2}, 360, 4.0), {0, 0, 0}}};
  const TravelPlan first = planner.plan(situation);
  ASSERT_EQ(first.status, TravelStatus::go);
  EXPECT_EQ(first.way.size(), 1U) << "a turn by a quarter comes first";
  // It has turned here already, and finds itself across the way again.
  situation.looked = {{0, 0, -first.waypoint.phi}};
  const TravelPlan then = planner.plan(situation);
  ASSERT_EQ(then.status, TravelStatus::go);
  ASSERT_GT(then.way.size(), 1U);
  EXPECT_LE(lengthOf(then.way), planner.params().longest_tight_leg + 0.1)
      << "the wheels may have lost the heading";
  // That it turned here before it went elsewhere and came back is no reason to drive now.
  situation.looked.push_back({1.0, 0.0, 0.0});
  EXPECT_EQ(planner.plan(situation).way.size(), 1U);
}

TEST(TravelPlanner, LooksAfterALargeTurnInAnyCase) {
  const PolygonMap map = corridor(true);
  const TravelPlanner planner(indexOf(map), {});
  TravelSituation situation = twoEnds(map, 10.5);
  situation.hypotheses = {hypothesisAt(10.5, 1, kPi, 0.5), hypothesisAt(9.5, 1, 0, 0.5)};
  situation.scans = {{castScan(WallSegments(map), {10.5, 1, kPi}, 360, 4.0), {0, 0, 0}}};
  const TravelPlan first = planner.plan(situation);
  ASSERT_EQ(first.status, TravelStatus::go);
  ASSERT_EQ(first.way.size(), 1U);
  EXPECT_GT(std::abs(first.waypoint.phi), 100.0 * kDegree);
  situation.looked = {{0, 0, -first.waypoint.phi}};
  EXPECT_EQ(planner.plan(situation).way.size(), 1U) << "it must not drive blindly";
}

TEST(TravelPlanner, SaysThatARobotIsBlocked) {
  const PolygonMap map = corridor(true);
  TravelPlannerParams wide;
  wide.safe.robot_radius = 1.1;  // wider than the corridor
  EXPECT_EQ(TravelPlanner(indexOf(map), wide).plan(twoEnds(map, 10.5)).status,
            TravelStatus::blocked);
  // In a wall: the scan hits all around it.
  TravelSituation walled = twoEnds(map, 10.5);
  std::vector<Beam> beams;
  for (int k = 0; k < 360; ++k) beams.push_back({k * kDegree, 0.1, BeamKind::hit});
  walled.scans = {{RangeScan(beams), {0, 0, 0}}};
  EXPECT_EQ(TravelPlanner(indexOf(map), {}).plan(walled).status, TravelStatus::blocked);
}

TEST(TravelPlanner, TurnsALaserThatDoesNotSeeAllAround) {
  // What differs lies behind the robot: turning is no way at all.
  const PolygonMap map = corridor(true);
  TravelSituation situation;
  situation.hypotheses = {hypothesisAt(16.5, 1, kPi, 0.5), hypothesisAt(3.5, 1, 0, 0.5)};
  situation.scans = {{castScan(WallSegments(map), {16.5, 1, kPi}, 181, 4.0, kPi), {0, 0, 0}}};
  const TravelPlan plan = TravelPlanner(indexOf(map), {}).plan(situation);
  ASSERT_EQ(plan.status, TravelStatus::go);
  EXPECT_LT(plan.distance, 0.3);
  EXPECT_GT(std::abs(plan.goal.phi), 1.0);
}

TEST(TravelPlanner, IsDeterministicAndRandomOnlyBySeed) {
  const PolygonMap map = corridor(true);
  const TravelPlanner planner(indexOf(map), with(TravelStrategy::random));
  TravelSituation situation = twoEnds(map, 12.5, 8.0);
  const TravelPlan first = planner.plan(situation), again = planner.plan(situation);
  EXPECT_EQ(first.goal.x, again.goal.x);
  EXPECT_EQ(first.goal.y, again.goal.y);
  int others = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    situation.seed = seed;
    others += planner.plan(situation).goal.x != first.goal.x;
  }
  EXPECT_GT(others, 3);
}

TEST(TravelPlanner, StopsWhereItsSightEnds) {
  // An L: behind the corner all maps agree, but nothing was seen yet.
  const PolygonMap map =
      mapOf({{0, 0}, {10, 0}, {10, 12}, {8, 12}, {8, 9}, {7, 9}, {7, 8}, {8, 8}, {8, 2}, {0, 2}});
  const PolygonMap mirror = mapOf({{20, 0}, {30, 0}, {30, 12}, {28, 12}, {28, 2}, {20, 2}});
  const PolygonMap both({map.components()[0], mirror.components()[0]});
  TravelSituation situation;
  situation.hypotheses = {hypothesisAt(2, 1, 0, 0.5), hypothesisAt(22, 1, 0, 0.5)};
  situation.scans = {{castScan(WallSegments(both), {2, 1, 0}, 360, 20.0), {0, 0, 0}}};
  TravelPlannerParams params;
  params.longest_leg = 100.0;
  const TravelPlan plan = TravelPlanner(indexOf(both), params).plan(situation);
  ASSERT_EQ(plan.status, TravelStatus::go);
  const Sight sight(situation.scans, 0.25);
  for (std::size_t i = 1; i < plan.way.size(); ++i) {
    for (int k = 0; k <= 10; ++k) {
      EXPECT_TRUE(
          sight.seesDisc(plan.way[i - 1] + (plan.way[i] - plan.way[i - 1]) * (k / 10.0), 0.15));
    }
  }
}

TEST(TravelPlanner, NamesStrategiesAndBadParameters) {
  EXPECT_EQ(travelStrategyFrom("nearest"), TravelStrategy::nearest);
  EXPECT_FALSE(travelStrategyFrom("Nearest"));
  TravelPlannerParams params;
  params.stop_cost = 0.0;
  EXPECT_THROW(TravelPlanner(indexOf(squareMap()), params), InvalidParamsError);
  EXPECT_THROW(TravelPlanner(nullptr), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc::test
