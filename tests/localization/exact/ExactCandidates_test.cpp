#include "exact_views.h"
#include "tests/support/map_factories.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/exact/ExactCandidates.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

TEST(ExactCandidates, KeepThosePosesFromWhichRaysSeeTheSame) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-3.0, 3.0);
  std::size_t kept = 0, refused = 0;
  for (const auto& [name, map] : namedMaps()) {
    SCOPED_TRACE(name);
    const Triangulation triangulation(map);
    const RayMap rays(map);
    for (const TPoint2D& p : randomFreePoints(map, 6, random)) {
      const TPose2D truth{p.x, p.y, angle(random)};
      const std::vector<TPoint2D> polygon = seenFrom(map, truth);
      const ObservedPolygon seen(polygon, kExactTolerance);
      const PosePrior prior;
      const RayMap view(polygon);
      std::vector<TPose2D> poses = {truth, {p.x, p.y, truth.phi + kPi}};
      for (const TPoint2D& q : randomFreePoints(map, 6, random)) {
        poses.push_back({q.x, q.y, angle(random)});
      }
      poses.push_back({1e6, 1e6, 0.0});
      for (const TPose2D& pose : poses) {
        ExactCandidates candidates(triangulation, seen, prior, kExactTolerance);
        candidates.consider(pose);
        const bool is_free = map.contains({pose.x, pose.y});
        EXPECT_EQ(candidates.kept() == 1, is_free && looksAlike(rays, pose, view))
            << pose.x << " " << pose.y << " " << pose.phi;
        (candidates.kept() == 1 ? kept : refused) += 1;
      }
    }
  }
  EXPECT_GT(kept, 40U);
  EXPECT_GT(refused, 200U);
}

TEST(ExactCandidates, KeepEachPoseOnceAndInOrder) {
  const PolygonMap map = squareMap(4.0);
  const Triangulation triangulation(map);
  const ObservedPolygon seen(seenFrom(map, {1, 1.5, 0}), kExactTolerance);
  const PosePrior prior;
  ExactCandidates candidates(triangulation, seen, prior, kExactTolerance);
  // The square looks the same turned by quarters about its middle.
  const std::vector<TPose2D> quarters = {
      {3, 2.5, kPi}, {2.5, 1, kPi / 2}, {1, 1.5, 0}, {1.5, 3, -kPi / 2}};
  for (int repeat = 0; repeat < 2; ++repeat) {
    for (const TPose2D& pose : quarters) candidates.consider(pose);
  }
  EXPECT_EQ(candidates.kept(), 4U);
  const ExactAnswers answers = candidates.answers();
  ASSERT_EQ(answers.poses.size(), 4U);
  EXPECT_EQ(answers.evaluated, 4U);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_LT(answers.poses[i - 1].x, answers.poses[i].x);
  for (const TPose2D& pose : quarters) EXPECT_TRUE(holds(answers, pose));
}

TEST(ExactCandidates, LeaveOutWhatThePriorForbids) {
  const PolygonMap map = squareMap(4.0);
  const Triangulation triangulation(map);
  const ObservedPolygon seen(seenFrom(map, {1, 1.5, 0}), kExactTolerance);
  const auto count = [&](const PosePrior& prior) {
    ExactCandidates candidates(triangulation, seen, prior, kExactTolerance);
    candidates.consider({1, 1.5, 0});
    candidates.consider({3, 2.5, kPi});
    return candidates.kept();
  };
  PosePrior compass, place;
  compass.compass = PosePrior::Compass{0.1, 0.2};
  place.near = PosePrior::Disk{3, 2.5, 0.1};
  EXPECT_EQ(count({}), 2U);
  EXPECT_EQ(count(compass), 1U);
  EXPECT_EQ(count(place), 1U);
}

TEST(ExactCandidates, TheAnchorIsTheLongestWallThatEndsAtAVertex) {
  // The long wall on the right is cut off by windows at both ends: no vertex of the map is seen.
  const ObservedPolygon seen(
      {{-1, -1}, {1, -1}, {1, -0.5}, {9, -4.5}, {9, 4.5}, {1, 0.5}, {1, 1}, {-1, 1}},
      kExactTolerance);
  const WallAnchor anchor = longestAnchor(seen);
  EXPECT_NEAR(anchor.length, 2.0, 1e-12);
  EXPECT_LT(anchor.from.x, 1.5);
}

}  // namespace
}  // namespace mrpt_polyloc::test
