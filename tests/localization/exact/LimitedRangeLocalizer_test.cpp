#include "exact_views.h"
#include "tests/support/map_factories.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/exact/LimitedRangeLocalizer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

LimitedView limitedFrom(const PolygonMap& map, const TPose2D& pose, double range) {
  return withinRange(test::seenFrom(map, pose), range);
}

double distanceToSegment(const TPoint2D& p, const TPoint2D& a, const TPoint2D& b) {
  const TPoint2D d = b - a;
  const double share =
      std::clamp(((p.x - a.x) * d.x + (p.y - a.y) * d.y) / (d.x * d.x + d.y * d.y), 0.0, 1.0);
  return (p - a - d * share).norm();
}

bool answersHold(const LimitedRangeLocalizer& localizer, const LimitedAnswers& answers,
                 const TPose2D& pose, double near = 1e-4) {
  const TPoint2D p(pose.x, pose.y);
  for (const TPose2D& q : answers.points) {
    if (std::hypot(q.x - p.x, q.y - p.y) < near && angleBetween(q.phi, pose.phi) < 1e-4)
      return true;
  }
  for (const auto& s : answers.segments) {
    if (angleBetween(s.heading, pose.phi) < 1e-4 && distanceToSegment(p, s.from, s.to) < near)
      return true;
  }
  return answers.region && localizer.clearance(p) >= answers.region->clearance - 1e-6;
}

/// Inner points of the answers, not all the same.
std::vector<TPose2D> samples(const LimitedAnswers& answers) {
  std::vector<TPose2D> all = answers.points;
  for (const auto& s : answers.segments) {
    for (const double share : {0.0, 0.03, 0.4, 1.0}) {
      const TPoint2D p = s.from + (s.to - s.from) * share;
      all.emplace_back(p.x, p.y, s.heading);
    }
  }
  if (answers.region) all.emplace_back(answers.region->inside.x, answers.region->inside.y, 1.0);
  return all;
}

std::vector<std::pair<std::string, PolygonMap>> limitedRangeMaps() {
  std::vector<std::pair<std::string, PolygonMap>> all;
  for (auto& [name, map] : test::namedMaps()) {
    if (std::string(name) != "pillars at 1e6") all.emplace_back(name, map);
  }
  all.emplace_back("open edges", test::withOpenEdges(test::pillarMap(), 0.3, 5));
  std::mt19937 random(101);
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    test::FloorPlanParams params = test::randomParams(random);
    params.crossing_walls = 0;
    params.edge_length = 0.0;
    if (seed % 2 == 0) params.rotation = params.jitter = 0.0;
    all.emplace_back("plan " + std::to_string(seed), test::floorPlan(params, seed));
  }
  return all;
}

TEST(LimitedRangeLocalizer, HoldsRandomPosesAndEveryAnswerSeesTheSame) {
  std::mt19937 random(102);
  std::uniform_real_distribution<double> angle(-3, 3), log_range(std::log(0.1), std::log(8.0));
  int points = 0, segments = 0, regions = 0;
  for (const auto& [name, map] : limitedRangeMaps()) {
    SCOPED_TRACE(name);
    const LimitedRangeLocalizer localizer(map);
    const test::RayMap rays(map);
    for (const TPoint2D& p : test::randomFreePoints(map, 12, random)) {
      const TPose2D pose(p.x, p.y, angle(random));
      const double range = std::exp(log_range(random));
      SCOPED_TRACE(std::to_string(p.x) + " " + std::to_string(p.y) + " range " +
                   std::to_string(range));
      const LimitedView view = limitedFrom(map, pose, range);
      const LimitedAnswers all = localizer.localize(view);
      EXPECT_TRUE(answersHold(localizer, all, pose));
      const LimitedAnswers headed = localizer.localize(view, PosePrior::Compass{pose.phi, 0.0});
      EXPECT_TRUE(answersHold(localizer, headed, pose));
      for (const TPose2D& answer : samples(all)) {
        EXPECT_LE(test::countDifferent(rays, answer, rays, pose, range, 3), 2U)
            << answer.x << " " << answer.y;
      }
      points += all.points.empty() ? 0 : 1;
      segments += all.segments.empty() ? 0 : 1;
      regions += all.region ? 1 : 0;
    }
  }
  EXPECT_GT(points, 30);
  EXPECT_GT(segments, 10);
  EXPECT_GT(regions, 10);
}

TEST(LimitedRangeLocalizer, AnswersAreThoseOfBruteForceOverADenseGrid) {
  for (const auto& [name, map] :
       std::vector<std::pair<std::string, PolygonMap>>{{"comb", test::combMap(4)},
                                                       {"pillars", test::pillarMap(2, 2)},
                                                       {"T junctions", test::tJunctionMap()}}) {
    SCOPED_TRACE(name);
    const LimitedRangeLocalizer localizer(map);
    const test::RayMap rays(map);
    std::vector<TPoint2D> grid;
    const BoundingBox& box = map.boundingBox();
    for (double x = box.min.x + 0.1; x < box.max.x; x += 0.2) {
      for (double y = box.min.y + 0.1; y < box.max.y; y += 0.2) {
        if (map.contains({x, y}) && localizer.clearance({x, y}) > 1e-3) grid.emplace_back(x, y);
      }
    }
    std::size_t kind = 0;
    for (std::size_t i = 0; i < grid.size(); i += 61) {
      // Ranges that no distance on the grid equals.
      const double range = std::vector<double>{0.233, 0.777, 1.357}[kind++ % 3];
      const TPose2D pose(grid[i].x, grid[i].y, 0.0);
      const LimitedAnswers answers =
          localizer.localize(limitedFrom(map, pose, range), PosePrior::Compass{0.0, 0.0});
      for (const TPoint2D& p : grid) {
        const TPose2D there(p.x, p.y, 0);
        const bool is_alike = test::countDifferent(rays, there, rays, pose, range, 1) == 0;
        EXPECT_EQ(is_alike, answersHold(localizer, answers, there))
            << "from " << pose.x << " " << pose.y << " range " << range << " at " << p.x << " "
            << p.y;
      }
    }
  }
}

TEST(LimitedRangeLocalizer, OneWallIsASegmentOfKnownEnds) {
  const PolygonMap map = test::mapOf(test::rectangle(0, 0, 10, 6));
  const LimitedRangeLocalizer localizer(map);
  const LimitedView view = limitedFrom(map, {5, 0.6, 0}, 1.0);  // a chord of 2 * 0.8 m
  const LimitedAnswers south = localizer.localize(view, PosePrior::Compass{0.0, 0.01});
  ASSERT_EQ(south.segments.size(), 1U);
  EXPECT_TRUE(south.points.empty());
  EXPECT_FALSE(south.region);
  EXPECT_NEAR(south.segments[0].from.x, 1.0, 1e-5);  // a range from the walls beside
  EXPECT_NEAR(south.segments[0].to.x, 9.0, 1e-5);
  EXPECT_NEAR(south.segments[0].from.y, 0.6, 1e-9);
  EXPECT_EQ(localizer.localize(view).segments.size(), 4U);
}

TEST(LimitedRangeLocalizer, OneWallInLineWithManyVerticesIsOneSegment) {
  const PolygonMap map = test::mapOf({{0, 0}, {3, 0}, {3.2, 0}, {7, 0}, {10, 0}, {10, 6}, {0, 6}});
  const LimitedAnswers answers = LimitedRangeLocalizer(map).localize(
      limitedFrom(map, {5, 0.6, 0}, 1.0), PosePrior::Compass{0.0, 0.01});
  ASSERT_EQ(answers.segments.size(), 1U);
  EXPECT_NEAR(answers.segments[0].from.x, 1.0, 1e-5);
  EXPECT_NEAR(answers.segments[0].to.x, 9.0, 1e-5);
}

TEST(LimitedRangeLocalizer, TwoParallelWallsAreASegmentInEachCorridorOfThatWidth) {
  // Two corridors 1 m wide beside one 1.2 m wide.
  const PolygonMap map({test::freePolygon(test::rectangle(0, 0, 8, 1)),
                        test::freePolygon(test::rectangle(0, 2, 12, 3)),
                        test::freePolygon(test::rectangle(0, 5, 12, 6.2))});
  const LimitedRangeLocalizer localizer(map);
  const LimitedView view = limitedFrom(map, {4, 0.4, 0}, 1.5);
  const LimitedAnswers answers = localizer.localize(view, PosePrior::Compass{0.0, 0.01});
  ASSERT_EQ(answers.segments.size(), 2U);
  EXPECT_NEAR(answers.segments[0].from.y, 0.4, 1e-9);
  EXPECT_NEAR(answers.segments[0].to.x, 6.5, 1e-5);
  EXPECT_NEAR(answers.segments[1].from.y, 2.4, 1e-9);
  EXPECT_NEAR(answers.segments[1].from.x, 1.5, 1e-5);
  EXPECT_NEAR(answers.segments[1].to.x, 10.5, 1e-5);
  EXPECT_EQ(localizer.localize(view).segments.size(), 4U);  // turned around as well
}

TEST(LimitedRangeLocalizer, TwoWallsThatMeetOutOfRangeArePoints) {
  // A triangle, seen from near a tip that is out of range.
  const PolygonMap map = test::mapOf({{0, 0}, {10, -2}, {10, 3}});
  const LimitedRangeLocalizer localizer(map);
  const TPose2D pose(5, 0.2, 0.3);
  const LimitedAnswers answers = localizer.localize(limitedFrom(map, pose, 2.0));
  EXPECT_EQ(answers.points.size(), 1U);
  EXPECT_TRUE(answers.segments.empty());
  EXPECT_TRUE(answersHold(localizer, answers, pose));
}

TEST(LimitedRangeLocalizer, NothingInRangeIsARegionIfThereIsRoom) {
  LimitedView nothing;
  nothing.range = 2.0;
  const LimitedAnswers hall =
      LimitedRangeLocalizer(test::squareMap(10.0)).localize(nothing, PosePrior::Compass{1.0, 0.1});
  ASSERT_TRUE(hall.region);
  EXPECT_EQ(hall.region->clearance, 2.0);
  EXPECT_GE(LimitedRangeLocalizer(test::squareMap(10.0)).clearance(hall.region->inside), 2.0);
  // Just large enough, and just too small.
  EXPECT_TRUE(LimitedRangeLocalizer(test::squareMap(4.0)).localize(nothing).region);
  EXPECT_TRUE(
      LimitedRangeLocalizer(test::mapOf(test::rectangle(0, 0, 4, 9.7))).localize(nothing).region);
  EXPECT_TRUE(LimitedRangeLocalizer(test::squareMap(3.999)).localize(nothing).empty());
}

TEST(LimitedRangeLocalizer, AGoodViewOfAnotherPlaceHasNoAnswer) {
  const PolygonMap map = test::mapOf(test::rectangle(0, 0, 10, 6));
  const LimitedRangeLocalizer localizer(map);
  const PolygonMap other = test::mapOf({{0, 0}, {4, 0}, {4, 1.5}, {0, 1}});
  EXPECT_TRUE(localizer.localize(limitedFrom(other, {1, 0.4, 0}, 0.9)).empty());
  // But for its right angle, which each corner of the room is.
  EXPECT_EQ(localizer.localize(limitedFrom(other, {3.5, 0.4, 0}, 0.9)).points.size(), 4U);
}

TEST(LimitedRangeLocalizer, RefusesWhatCannotBeSeen) {
  const LimitedRangeLocalizer localizer(test::squareMap());
  const auto localize = [&](std::vector<TPoint2D> vertices, std::vector<bool> is_arc,
                            double range) {
    localizer.localize({std::move(vertices), std::move(is_arc), range});
  };
  EXPECT_NO_THROW(localize({{0.8, -0.6}, {0.8, 0.6}}, {false, true}, 1.0));
  EXPECT_THROW(localize({{0.8, -0.6}, {0.8, 0.6}}, {false, true}, -1.0), InvalidParamsError);
  EXPECT_THROW(localize({{0.8, -0.6}, {0.8, 0.6}}, {false}, 1.0), InvalidParamsError);
  EXPECT_THROW(localize({{0.8, -0.6}, {0.8, 0.6}}, {false, true}, 1.5), InvalidParamsError);
  EXPECT_THROW(localize({{0.8, -0.6}, {0.8, 0.6}}, {false, true}, 0.9), InvalidParamsError);
  EXPECT_THROW(localize({{0.8, 0.6}, {0.8, -0.6}}, {false, true}, 1.0), InvalidParamsError);
  EXPECT_THROW(localize({{0.8, -0.6}, {std::nan(""), 0.6}}, {false, true}, 1.0),
               InvalidParamsError);
  EXPECT_THROW(localizer.localize({{}, {}, 1.0}, PosePrior::Compass{0.0, 4.0}), InvalidParamsError);
  EXPECT_THROW(LimitedRangeLocalizer(test::squareMap(), {0.0}), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
