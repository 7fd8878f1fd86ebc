#include "travel_support.h"
#include <mrpt_polyloc/localization/exact/SkeletonLocalizer.h>
#include <mrpt_polyloc/travel/ExactTravel.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tests/support/map_factories.h>
#include <tests/support/random_maps.h>

namespace mrpt_polyloc::test {
namespace {

/// A corridor with niches along its upper wall, all alike but for the depths given: from inside of
/// a niche of one depth all look the same.
PolygonMap nicheCorridor(const std::vector<double>& depths, double length_after = 3.0) {
  std::vector<TPoint2D> v{{0, 0}};
  const double pitch = 3.0, length = pitch * static_cast<double>(depths.size()) + length_after;
  v.emplace_back(length, 0);
  v.emplace_back(length, 1.0);
  for (std::size_t k = depths.size(); k-- > 0;) {
    const double x = 1.0 + pitch * static_cast<double>(k);
    v.insert(v.end(), {{x + 1.0, 1.0}, {x + 1.0, 1.0 + depths[k]}, {x, 1.0 + depths[k]}, {x, 1.0}});
  }
  v.emplace_back(0, 1.0);
  return mapOf(std::move(v));
}

std::vector<TPoint2D> viewAt(const PolygonMap& map, const TPoint2D& p) {
  const Triangulation triangulation(map);
  ViewExpander expander(triangulation, true);
  std::vector<TPoint2D> view = visibilityPolygon(triangulation, expander.expand(p));
  for (TPoint2D& q : view) q = q - p;
  return view;
}

/// All places that see what a place sees, by the exact query with a compass.
std::vector<TPoint2D> alikePlaces(const PolygonMap& map, const SkeletonLocalizer& localizer,
                                  const TPoint2D& at, std::size_t& truth) {
  PosePrior compass;
  compass.compass = PosePrior::Compass{0.0, 1e-6};
  std::vector<TPoint2D> places;
  truth = 0;
  for (const auto& pose : localizer.localize(viewAt(map, at), compass).poses) {
    if (std::hypot(pose.x - at.x, pose.y - at.y) < 1e-6) truth = places.size();
    places.emplace_back(pose.x, pose.y);
  }
  return places;
}

/// Whether two places see the same, by rays: not at all from skeletons.
bool seeAlikeByRays(const WallSegments& walls, const TPoint2D& a, const TPoint2D& b) {
  for (int k = 0; k < 1440; ++k) {
    const double angle = (k + 0.37) * 2.0 * kPi / 1440;
    if (std::abs(walls.range(a, angle) - walls.range(b, angle)) > 1e-6) return false;
  }
  return true;
}

TEST(ExactTravel, SeesTheSameWhereRaysDo) {
  const PolygonMap map = nicheCorridor({1.0, 1.0, 1.0, 0.6});
  const SkeletonLocalizer localizer(map);
  const WallSegments walls(map);
  const TPoint2D start{1.52, 1.83};
  std::size_t truth = 0;
  const std::vector<TPoint2D> starts = alikePlaces(map, localizer, start, truth);
  ASSERT_GE(starts.size(), 2u);
  const ExactTravel travel(localizer.cells(), localizer.classes(), starts, truth);
  std::size_t alike = 0, different = 0;
  for (const TPoint2D& place : travel.placePoints()) {
    for (std::size_t rival = 0; rival < starts.size(); ++rival) {
      if (rival == truth) continue;
      const bool same = travel.seesAlike(place, truth, rival);
      const bool is_free = map.contains(starts[rival] + place);
      const bool same_rays =
          is_free && seeAlikeByRays(walls, starts[truth] + place, starts[rival] + place);
      // Where cells meet, a place is one of a cell narrower than a ray sees: rays may find alike
      // what differs by a sliver, never the other way round.
      if (same) {
        EXPECT_TRUE(same_rays) << place.x << ' ' << place.y;
      }
      ++(same ? alike : different);
      if (!same && same_rays) --different;
    }
  }
  EXPECT_GT(alike, 20u);
  EXPECT_GT(different, 20u);
}

struct Law {
  std::size_t runs = 0;
  double worst = 0.0;  ///< travel over (k - 1) d
};

/// travel <= (k - 1) d, for every truth among the places that look like a start.
void expectLaw(const PolygonMap& map, const TPoint2D& start, Law& law) {
  const SkeletonLocalizer localizer(map);
  std::size_t truth = 0;
  const std::vector<TPoint2D> starts = alikePlaces(map, localizer, start, truth);
  if (starts.size() < 2) return;
  for (std::size_t right = 0; right < starts.size(); ++right) {
    SCOPED_TRACE(testing::Message() << "truth " << right << " of " << starts.size());
    const ExactTravel travel(localizer.cells(), localizer.classes(), starts, right);
    const ExactTravel::Run run = travel.nearest();
    const std::optional<double> tour = travel.shortestTour();
    ASSERT_TRUE(tour);
    EXPECT_TRUE(std::count(run.left.begin(), run.left.end(), right) == 1);
    const double most = static_cast<double>(starts.size() - 1) * *tour;
    EXPECT_LE(run.travel, most + 1e-9);
    // Nobody is faster than the one who knows; going on at once is never longer than by way home.
    const ExactTravel::Run direct = travel.nearest(false);
    EXPECT_EQ(direct.left, run.left);
    if (most > 0.0) law.worst = std::max(law.worst, run.travel / most);
    ++law.runs;
  }
}

TEST(ExactTravel, DrivesAtMostKMinusOneShortestTours) {
  Law law;
  expectLaw(nicheCorridor({1.0, 1.0}), {1.5, 1.8}, law);
  expectLaw(nicheCorridor({1.0, 1.0, 1.0}), {1.47, 1.83}, law);
  expectLaw(nicheCorridor({1.0, 1.0, 1.0, 1.0}, 5.0), {1.5, 1.9}, law);
  expectLaw(nicheCorridor({1.0, 0.6, 1.0, 1.4}), {1.5, 1.9}, law);
  expectLaw(combMap(4), {0.5, 4.0}, law);
  EXPECT_GE(law.runs, 12u);
  EXPECT_GT(law.worst, 0.1);
}

TEST(ExactTravel, DrivesAtMostKMinusOneShortestToursInRandomCombs) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Law law;
  for (int round = 0; round < 6; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    std::vector<double> depths;
    for (std::size_t k = 0, count = 2 + random() % 3; k < count; ++k) {
      depths.push_back(unit(random) < 0.7 ? 1.0 : 0.5 + unit(random));
    }
    expectLaw(nicheCorridor(depths, 1.0 + 4.0 * unit(random)),
              {1.3 + 0.4 * unit(random), 1.7 + 0.2 * unit(random)}, law);
  }
  EXPECT_GE(law.runs, 6u);
}

TEST(ExactTravel, StopsWhereNothingTells) {
  // Two rooms of one shape that no way joins: nothing ever differs.
  const PolygonMap map =
      PolygonMap({freePolygon(rectangle(0, 0, 3, 2)), freePolygon(rectangle(5, 0, 8, 2))});
  const SkeletonLocalizer localizer(map);
  const ExactTravel travel(localizer.cells(), localizer.classes(), {{1, 1}, {6, 1}}, 0);
  const ExactTravel::Run run = travel.nearest();
  EXPECT_EQ(run.left.size(), 2u);
  EXPECT_EQ(run.travel, 0.0);
  EXPECT_EQ(travel.shortestTour(), 0.0);
}

}  // namespace
}  // namespace mrpt_polyloc::test
