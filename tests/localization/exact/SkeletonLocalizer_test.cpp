#include "exact_views.h"
#include "tests/support/map_factories.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/exact/ObservedPolygon.h>
#include <mrpt_polyloc/localization/exact/SkeletonLocalizer.h>

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
using test::holds;
using test::looksAlike;
using test::seenFrom;

/// Two rooms of one shape, the second turned by 1 radian, each with a pillar.
PolygonMap turnedTwinRooms() {
  const auto place = [](std::vector<TPoint2D> v, double angle, double dx, double dy) {
    for (TPoint2D& p : v) {
      p = TPoint2D(std::cos(angle) * p.x - std::sin(angle) * p.y + dx,
                   std::sin(angle) * p.x + std::cos(angle) * p.y + dy);
    }
    return v;
  };
  const std::vector<TPoint2D> room{{0, 0}, {5, 0}, {5, 3}, {3, 3}, {3, 4}, {0, 4}};
  const std::vector<TPoint2D> pillar{{1, 1}, {2, 1}, {2.2, 2}, {1.2, 1.7}};
  return PolygonMap({test::freePolygon(room, {pillar}),
                     test::freePolygon(place(room, 1.0, 20, 5), {place(pillar, 1.0, 20, 5)})});
}

/// A hall around `middle` on which half a turn changes nothing. Of six pairs of pillars each hides
/// a slit: corners of both are in line with the middle, one on either side. With `stretched` > 0
/// the farther ones reach on behind the nearer ones: the same is seen from the middle, out of line.
FreePolygon symmetricHall(const TPoint2D& middle, double stretched) {
  std::vector<std::vector<TPoint2D>> pillars;
  for (int i = 0; i < 6; ++i) {
    const double angle = 0.3 + kTwoPi * i / 6;
    const TPoint2D u(std::cos(angle), std::sin(angle)), side(-u.y, u.x);
    const TPoint2D corner = u * 3.2, back = u * 3.6 - side * 0.3;
    const TPoint2D near = middle + u * 2.0;
    pillars.push_back({near, near + u * 0.4 + side * 0.4, near + u * 0.6 + side * 0.1});
    pillars.push_back({middle + u * 3.4 - side * 0.4,
                       middle + corner + (corner - (u * 3.4 - side * 0.4)) * stretched,
                       middle + back});
  }
  const TPoint2D low = middle - TPoint2D(6, 5), high = middle + TPoint2D(6, 5);
  return test::freePolygon(test::rectangle(low.x, low.y, high.x, high.y), pillars);
}

std::vector<std::pair<std::string, PolygonMap>> skeletonMaps() {
  std::vector<std::pair<std::string, PolygonMap>> all;
  for (auto& [name, map] : test::namedMaps()) all.emplace_back(name, map);
  all.emplace_back("open edges", test::withOpenEdges(test::pillarMap(), 0.3, 5));
  all.emplace_back("twin rooms", turnedTwinRooms());
  all.emplace_back("symmetric hall", PolygonMap({symmetricHall({0, 0}, 0.0)}));
  std::mt19937 random(91);
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    test::FloorPlanParams params = test::randomParams(random);
    params.corridors = 1;
    params.rooms_per_side = std::min(params.rooms_per_side, 2);
    params.crossing_walls = 0;
    params.edge_length = 0.0;
    if (seed % 2 == 0) params.rotation = params.jitter = 0.0;
    all.emplace_back("plan " + std::to_string(seed), test::floorPlan(params, seed));
  }
  return all;
}

void expectSame(const ExactAnswers& a, const ExactAnswers& b) {
  EXPECT_EQ(a.poses.size(), b.poses.size());
  for (const TPose2D& h : a.poses) EXPECT_TRUE(holds(b, h));
  for (const TPose2D& h : b.poses) EXPECT_TRUE(holds(a, h));
}

/// Queries asked, and those that the classes answered: not so in the map of slivers, whose passage
/// is as wide as the tolerance.
struct Asked {
  int all = 0, by_classes = 0;
};

/// Both queries hold the pose and agree, with a compass and without.
void expectAnswered(const PolygonMap& map, const SkeletonLocalizer& classes,
                    const ExactLocalizer& single_shot, const TPose2D& pose, Asked& asked) {
  SCOPED_TRACE("from " + std::to_string(pose.x) + " " + std::to_string(pose.y));
  const auto view = seenFrom(map, pose);
  try {
    const ObservedPolygon around(view, ExactLocalizerParams{}.tolerance);
  } catch (const InvalidParamsError&) {
    return;  // on a wall, up to the tolerance
  }
  const ExactAnswers all = classes.localize(view);
  ++asked.all;
  asked.by_classes += all.positions > 0 ? 1 : 0;
  EXPECT_TRUE(holds(all, pose));
  expectSame(all, single_shot.localize(view));
  PosePrior prior;
  prior.compass = PosePrior::Compass{pose.phi, 0.0};
  const ExactAnswers headed = classes.localize(view, prior);
  EXPECT_TRUE(holds(headed, pose));
  expectSame(headed, single_shot.localize(view, prior));
}

TEST(SkeletonLocalizer, AnswersRandomPosesAsTheSingleShotDoes) {
  std::mt19937 random(92);
  std::uniform_real_distribution<double> angle(-3, 3);
  Asked asked;
  for (const auto& [name, map] : skeletonMaps()) {
    SCOPED_TRACE(name);
    const SkeletonLocalizer classes(map);
    const ExactLocalizer single_shot(map);
    for (const TPoint2D& p : test::randomFreePoints(map, 25, random)) {
      expectAnswered(map, classes, single_shot, {p.x, p.y, angle(random)}, asked);
    }
  }
  EXPECT_GT(asked.by_classes, 0.9 * asked.all) << asked.by_classes << " of " << asked.all;
}

TEST(SkeletonLocalizer, AnswersPointsOnCriticalSegmentsAndTheirCrossings) {
  std::mt19937 random(93);
  Asked on_segments, on_tied;
  for (const auto& [name, map] : skeletonMaps()) {
    SCOPED_TRACE(name);
    const SkeletonLocalizer classes(map);
    const ExactLocalizer single_shot(map);
    const VisibilityCells& cells = classes.cells();
    for (int k = 0; k < 25; ++k) {
      const std::size_t cell = random() % cells.size();
      const std::vector<TPoint2D> v = cells.polygon(cell);
      const std::size_t e = random() % v.size();
      if (cells.neighbor(cell, e) == VisibilityCells::kNone) continue;
      const TPoint2D middle = (v[e] + v[(e + 1) % v.size()]) * 0.5;
      expectAnswered(map, classes, single_shot, {middle.x, middle.y, 0.5}, on_segments);
    }
    std::vector<TPoint2D> tied = cells.tiedPoints(1e-6);
    std::shuffle(tied.begin(), tied.end(), random);
    if (tied.size() > 15) tied.resize(15);
    for (const TPoint2D& p : tied) {
      expectAnswered(map, classes, single_shot, {p.x, p.y, 0.0}, on_tied);
    }
  }
  EXPECT_GT(on_segments.by_classes, 0.9 * on_segments.all)
      << on_segments.by_classes << " of " << on_segments.all;
  EXPECT_GT(on_tied.by_classes, 0.9 * on_tied.all) << on_tied.by_classes << " of " << on_tied.all;
}

TEST(SkeletonLocalizer, FindsMiddlesThatSeeWhatNoCellAroundThemSees) {
  // From all sides of the first middle some slit is open; the second one sees the same from within
  // a cell, so that what is not found by classes would not be found.
  const PolygonMap map({symmetricHall({0, 0}, 0.0), symmetricHall({20, 0}, 0.2)});
  const SkeletonLocalizer classes(map);
  const auto result = classes.localize(seenFrom(map, {20, 0, 0}));
  EXPECT_GT(result.positions, 0U);
  EXPECT_EQ(result.poses.size(), 4U);
  for (const double heading : {0.0, M_PI}) {
    EXPECT_TRUE(holds(result, {0, 0, heading}));
    EXPECT_TRUE(holds(result, {20, 0, heading}));
  }
}

TEST(SkeletonLocalizer, FindsEveryPointOfADenseGridFromWhichTheSameIsSeen) {
  // Each place of a fine grid that looks alike by rays is an answer, and no other is.
  for (const auto& [name, map] :
       std::vector<std::pair<std::string, PolygonMap>>{{"comb", test::combMap(5)},
                                                       {"pillars", test::pillarMap()},
                                                       {"windmill", test::windmillMap()}}) {
    SCOPED_TRACE(name);
    const SkeletonLocalizer classes(map);
    const test::RayMap rays(map);
    std::vector<TPoint2D> grid;
    const BoundingBox& box = map.boundingBox();
    for (double x = box.min.x + 0.125; x < box.max.x; x += 0.25) {
      for (double y = box.min.y + 0.1; y < box.max.y; y += 0.25) {
        if (map.contains({x, y})) grid.emplace_back(x, y);
      }
    }
    for (std::size_t i = 0; i < grid.size(); i += 37) {
      const auto view = seenFrom(map, {grid[i].x, grid[i].y, 0});
      const test::RayMap seen(view);
      PosePrior prior;
      prior.compass = PosePrior::Compass{0.0, 0.0};
      const ExactAnswers result = classes.localize(view, prior);
      for (const TPoint2D& p : grid) {
        EXPECT_EQ(looksAlike(rays, {p.x, p.y, 0}, seen), holds(result, {p.x, p.y, 0}))
            << "from " << grid[i].x << " " << grid[i].y << " at " << p.x << " " << p.y;
      }
    }
  }
}

TEST(SkeletonLocalizer, FindsATurnedTwinAndTheCompassChooses) {
  const PolygonMap map = turnedTwinRooms();
  const SkeletonLocalizer classes(map);
  const auto view = seenFrom(map, {4, 2, 0.3});
  const auto both = classes.localize(view);
  ASSERT_EQ(both.poses.size(), 2U);
  const TPoint2D twin(20 + 4 * std::cos(1.0) - 2 * std::sin(1.0),
                      5 + 4 * std::sin(1.0) + 2 * std::cos(1.0));
  EXPECT_TRUE(holds(both, {4, 2, 0.3}));
  EXPECT_TRUE(holds(both, {twin.x, twin.y, 1.3}));
  EXPECT_GE(both.positions, 2U);  // by classes, not by trying all edges
  PosePrior prior;
  prior.compass = PosePrior::Compass{1.3, 0.1};
  const auto one = classes.localize(view, prior);
  EXPECT_EQ(one.poses.size(), 1U);
  EXPECT_TRUE(holds(one, {twin.x, twin.y, 1.3}));
}

TEST(SkeletonLocalizer, TakesRoundedVerticesAndRefusesWhatTheSingleShotRefuses) {
  const PolygonMap map = test::lRoomMap();
  const SkeletonLocalizer classes(map);
  auto view = seenFrom(map, {1, 1, 0.4});
  for (TPoint2D& v : view) v = {std::round(v.x * 2e6) / 2e6, std::round(v.y * 2e6) / 2e6};
  EXPECT_TRUE(holds(classes.localize(view), {1, 1, 0.4}));
  view[0] = view[0] * 1.001;
  EXPECT_TRUE(classes.localize(view).poses.empty());
  using Polygon = std::vector<TPoint2D>;
  EXPECT_TRUE(classes.localize(Polygon{{-50, -50}, {50, -50}, {50, 50}, {-50, 50}}).poses.empty());
  EXPECT_THROW(classes.localize(Polygon{{1, 1}, {3, 1}, {3, 3}, {1, 3}}), InvalidParamsError);
  EXPECT_THROW(SkeletonLocalizer(map, {0.0}), InvalidParamsError);
  PosePrior prior;
  prior.compass = PosePrior::Compass{0.0, 3.2};
  EXPECT_THROW(classes.localize(view, prior), InvalidParamsError);
}

TEST(SkeletonLocalizer, PaysForManyQueriesWithinTheBudget) {
  const PolygonMap map = test::pillarMap();
  EXPECT_FALSE(SkeletonLocalizer::pays(map, 1));
  EXPECT_TRUE(SkeletonLocalizer::pays(map, 100'000));
  EXPECT_FALSE(SkeletonLocalizer::pays(map, 100'000, 100));
  // As many more queries as there are more cells: never for a map of 35,000 vertices, and soon so.
  EXPECT_FALSE(SkeletonLocalizer::pays(test::largeMap(), 1'000'000));
}

TEST(SkeletonLocalizer, IsRefusedOverTheBudgetWithTheCount) {
  const PolygonMap map = test::pillarMap();
  const CellEstimate estimate = VisibilityCells::estimate(map);
  try {
    const SkeletonLocalizer refused(map, {}, 100);
    FAIL() << "not refused";
  } catch (const CellBudgetError& error) {
    EXPECT_EQ(error.estimate.cells(), estimate.cells());
    EXPECT_NE(std::string(error.what()).find(std::to_string(estimate.cells())), std::string::npos);
  }
}

}  // namespace
}  // namespace mrpt_polyloc
