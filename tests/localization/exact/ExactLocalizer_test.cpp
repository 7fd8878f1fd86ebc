#include "exact_views.h"
#include "tests/support/map_factories.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/exact/ExactLocalizer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace mrpt_polyloc {
namespace {

using test::holds;
using test::looksAlike;
using test::seenFrom;

void expectFound(const PolygonMap& map, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(-3, 3);
  const ExactLocalizer localizer(map);
  for (const TPoint2D& p : test::randomFreePoints(map, 20, random)) {
    const mrpt::math::TPose2D pose(p.x, p.y, angle(random));
    SCOPED_TRACE(std::to_string(p.x) + " " + std::to_string(p.y));
    const auto view = seenFrom(map, pose);
    const ExactAnswers all = localizer.localize(view);
    EXPECT_TRUE(holds(all, pose));
    PosePrior prior;
    prior.compass = PosePrior::Compass{pose.phi, 0.0};
    EXPECT_TRUE(holds(localizer.localize(view, prior), pose));
    for (const mrpt::math::TPose2D& h : all.poses) {  // each sees as much
      EXPECT_NEAR(signedArea(seenFrom(map, h)), signedArea(view), 1e-3);
    }
  }
}

TEST(ExactLocalizer, FindsRandomPosesOfNamedMaps) {
  for (const auto& [name, map] : test::namedMaps()) {
    SCOPED_TRACE(name);
    expectFound(map, 1);
  }
}

TEST(ExactLocalizer, FindsRandomPosesOfFloorPlans) {
  std::mt19937 random(2);
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::FloorPlanParams params = test::randomParams(random);
    params.crossing_walls = 0;
    if (seed % 2 == 0) params.jitter = params.rotation = 0.0;
    expectFound(test::floorPlan(params, seed), seed);
  }
}

TEST(ExactLocalizer, AnswersAreThoseOfBruteForceOverAllPairsOfVertices) {
  std::mt19937 random(3);
  for (const auto& [name, map] : test::namedMaps()) {
    SCOPED_TRACE(name);
    const ExactLocalizer localizer(map);
    const test::RayMap map_rays(map);
    for (const TPoint2D& p : test::randomFreePoints(map, 4, random)) {
      const auto view = seenFrom(map, {p.x, p.y, 0});
      const test::RayMap view_rays(view);
      PosePrior prior;
      prior.compass = PosePrior::Compass{0.0, 0.0};
      const ExactAnswers result = localizer.localize(view, prior);
      for (const mrpt::math::TPose2D& h : result.poses) {
        EXPECT_TRUE(looksAlike(map_rays, h, view_rays));
      }
      for (const Ring* ring : map.rings()) {
        for (const TPoint2D& vertex : ring->vertices) {
          for (const TPoint2D& seen : view) {
            const TPoint2D q = vertex - seen;
            if (!map.contains(q) || !looksAlike(map_rays, {q.x, q.y, 0}, view_rays)) continue;
            EXPECT_TRUE(holds(result, {q.x, q.y, 0})) << q.x << " " << q.y;
          }
        }
      }
    }
  }
}

TEST(ExactLocalizer, TakesRoundingButNoMillimetre) {
  const PolygonMap map = test::lRoomMap();
  const ExactLocalizer localizer(map);
  auto view = seenFrom(map, {1, 1, 0.4});
  for (TPoint2D& v : view) v = {std::round(v.x * 2e6) / 2e6, std::round(v.y * 2e6) / 2e6};
  EXPECT_TRUE(holds(localizer.localize(view), {1, 1, 0.4}));
  view[0] = view[0] * 1.001;
  EXPECT_TRUE(localizer.localize(view).poses.empty());
}

TEST(ExactLocalizer, ASquareHasFourHeadingsAndTheCompassChooses) {
  const PolygonMap map = test::squareMap();
  const ExactLocalizer localizer(map);
  const auto view = seenFrom(map, {3, 4, 0});
  EXPECT_EQ(localizer.localize(view).poses.size(), 4U);
  PosePrior prior;
  prior.compass = PosePrior::Compass{0.0, 0.1};
  const auto result = localizer.localize(view, prior);
  EXPECT_EQ(result.poses.size(), 1U);
  EXPECT_TRUE(holds(result, {3, 4, 0}));
}

TEST(ExactLocalizer, WhatIsNotSeenAnywhereHasNoMatch) {
  const ExactLocalizer localizer(test::lRoomMap());
  EXPECT_TRUE(localizer.localize({{-50, -50}, {50, -50}, {50, 50}, {-50, 50}}).poses.empty());
  EXPECT_TRUE(localizer.localize({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}).poses.empty());
}

TEST(ExactLocalizer, RepeatedAndCollinearVerticesDoNoHarm) {
  const PolygonMap map = test::lRoomMap();
  std::vector<TPoint2D> padded;
  const auto view = seenFrom(map, {1, 1, 0.4});
  for (std::size_t i = 0; i < view.size(); ++i) {
    const TPoint2D a = view[i], b = view[(i + 1) % view.size()];
    padded.insert(padded.end(), {a, a, a + (b - a) * 0.3});
  }
  EXPECT_TRUE(holds(ExactLocalizer(map).localize(padded), {1, 1, 0.4}));
}

TEST(ExactLocalizer, RefusesWhatCannotBeSeen) {
  const ExactLocalizer localizer(test::squareMap());
  using Polygon = std::vector<TPoint2D>;
  EXPECT_THROW(localizer.localize(Polygon{{1, 0}, {0, 1}}), InvalidParamsError);
  EXPECT_THROW(localizer.localize(Polygon{{1, 1}, {3, 1}, {3, 3}, {1, 3}}), InvalidParamsError);
  EXPECT_THROW(localizer.localize(Polygon{{-1, 0}, {1, 0}, {0, 2}}), InvalidParamsError);
  EXPECT_THROW(localizer.localize(Polygon{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}), InvalidParamsError);
  EXPECT_THROW(localizer.localize(
                   Polygon{{-1, -1}, {9, -1}, {9, 1}, {3, 1}, {3, 2}, {9, 2}, {9, 3}, {-1, 3}}),
               InvalidParamsError);
  EXPECT_THROW(localizer.localize(Polygon{{-1, -1}, {std::nan(""), -1}, {0, 1}}),
               InvalidParamsError);
  EXPECT_THROW(ExactLocalizer(test::squareMap(), {0.0}), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
