#include "tests/support/BruteForceRays.h"
#include "tests/support/constants.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/visibility/ViewExpander.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace mrpt_polyloc {
namespace {

using test::BruteForceRays;
using test::kInfinity;
using test::RayHit;

double cross(double ax, double ay, double bx, double by) {
  return ax * by - ay * bx;
}

/// The range along a ray at which one of some pieces is met, infinity for none.
double rangeOf(const Triangulation& t, const TPoint2D& from, const std::vector<VisibleEdge>& pieces,
               bool walls_only, double angle) {
  const double ux = std::cos(angle), uy = std::sin(angle);
  const auto at = [&](std::int32_t v) { return t.vertices()[static_cast<std::size_t>(v)] - from; };
  double least = kInfinity;
  for (const VisibleEdge& piece : pieces) {
    if (walls_only && !piece.is_wall) continue;
    const TPoint2D right = at(piece.right_limit), left = at(piece.left_limit);
    if (cross(right.x, right.y, ux, uy) < 0 || cross(left.x, left.y, ux, uy) > 0) continue;
    const TPoint2D a = at(piece.right), b = at(piece.left);
    const double turn = cross(ux, uy, b.x - a.x, b.y - a.y);
    if (turn > 0) least = std::min(least, cross(a.x, a.y, b.x, b.y) / turn);
  }
  return least;
}

bool closeInDouble(double a, double b) {
  return a == b || std::abs(a - b) < 1e-7 * (1 + b);
}

/// How many rays differ from brute force, where it does not change when the ray is turned a little.
std::size_t differences(const Triangulation& t, const BruteForceRays& rays, const View& view,
                        std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-kPi, kPi);
  std::size_t count = 0;
  for (int i = 0; i < 60; ++i) {
    const double angle = uniform(random);
    const RayHit hit = rays.cast(view.viewpoint, angle);
    const double wall = rangeOf(t, view.viewpoint, view.ends, true, angle);
    const double open = rangeOf(t, view.viewpoint, view.open, false, angle);
    if (closeInDouble(wall, hit.wall) && closeInDouble(open, hit.open)) continue;
    const RayHit right = rays.cast(view.viewpoint, angle - 1e-7);
    const RayHit left = rays.cast(view.viewpoint, angle + 1e-7);
    const bool grazes = !closeInDouble(right.wall, left.wall) ||
                        !closeInDouble(right.open, left.open) ||
                        !closeInDouble(hit.wall, left.wall);
    count += grazes ? 0 : 1;
  }
  return count;
}

TEST(ViewExpander, EqualsBruteForceOnRandomMaps) {
  std::mt19937 random(41);
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PolygonMap map = test::floorPlan(test::randomParams(random), seed);
    const BruteForceRays rays(map);
    const Triangulation t(map);
    ViewExpander expander(t);
    for (const TPoint2D& p : test::randomPoints(map, 0.9, 40, random)) {
      EXPECT_EQ(differences(t, rays, expander.expand(p), random), 0U) << p.x << " " << p.y;
    }
  }
}

TEST(ViewExpander, GivesPiecesAllAroundInOrder) {
  std::mt19937 random(42);
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PolygonMap map = test::floorPlan(test::randomParams(random), seed);
    const Triangulation t(map);
    ViewExpander expander(t);
    for (const TPoint2D& p : test::randomPoints(map, 0.9, 40, random)) {
      const View& view = expander.expand(p);
      ASSERT_FALSE(view.ends.empty());
      double turned = 0.0;
      for (std::size_t i = 0; i < view.ends.size(); ++i) {
        const auto bearing = [&](std::int32_t v) {
          const TPoint2D d = t.vertices()[static_cast<std::size_t>(v)] - view.viewpoint;
          return std::atan2(d.y, d.x);
        };
        const VisibleEdge& piece = view.ends[i];
        const VisibleEdge& next = view.ends[(i + 1) % view.ends.size()];
        const double width =
            std::remainder(bearing(piece.left_limit) - bearing(piece.right_limit), 2 * kPi);
        EXPECT_GE(width, -1e-12);
        turned += width;
        // The next piece starts where this one ended.
        const double step =
            std::remainder(bearing(next.right_limit) - bearing(piece.left_limit), 2 * kPi);
        EXPECT_NEAR(step, 0.0, 1e-12);
      }
      EXPECT_NEAR(turned, 2 * kPi, 1e-9);
    }
  }
}

TEST(ViewExpander, SeesOutFromVerticesAndEdges) {
  std::mt19937 random(43);
  for (std::uint32_t seed = 0; seed < 15; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PolygonMap map = test::floorPlan(test::randomParams(random), seed);
    const BruteForceRays rays(map);
    const Triangulation t(map);
    ViewExpander expander(t);
    for (const Ring* ring : map.rings()) {
      const TPoint2D a = ring->vertices[0], b = ring->vertices[1];
      for (const TPoint2D& p : {a, (a + b) * 0.5}) {
        const View& view = expander.expand(p);
        EXPECT_NEAR(view.viewpoint.x, p.x, 1e-7);
        EXPECT_NEAR(view.viewpoint.y, p.y, 1e-7);
        ASSERT_FALSE(view.ends.empty());
        EXPECT_EQ(differences(t, rays, view, random), 0U) << p.x << " " << p.y;
      }
    }
  }
}

TEST(ViewExpander, TellsWhereFreeSpaceWasLeft) {
  // A room whose right side is open, a wall beyond it, and another room behind that is open to the
  // left: a ray to the right leaves free space at 4 and ends at 6, or in the other room at 12.
  Ring room = wallRing({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  room.kinds[1] = EdgeKind::open;
  Ring other = wallRing({{8, 0}, {12, 0}, {12, 4}, {8, 4}});
  other.kinds[3] = EdgeKind::open;
  const PolygonMap map({{room, {}}, {other, {}}}, {{{6, 0}, {6, 2}}});
  const Triangulation t(map);
  ViewExpander expander(t);
  const View view = expander.expand({2, 2.5});
  EXPECT_NEAR(rangeOf(t, view.viewpoint, view.ends, true, 0.01), 10 / std::cos(0.01), 1e-7);
  EXPECT_NEAR(rangeOf(t, view.viewpoint, view.open, false, 0.01), 2 / std::cos(0.01), 1e-7);
  EXPECT_NEAR(rangeOf(t, view.viewpoint, view.ends, true, -0.25), 4 / std::cos(0.25), 1e-7);
  EXPECT_EQ(rangeOf(t, view.viewpoint, view.open, false, 3.0), kInfinity);
  // From between the rooms, into one of them, and not out of it again.
  const View unknown = expander.expand({7, 3});
  EXPECT_NEAR(rangeOf(t, unknown.viewpoint, unknown.ends, true, 0.01), 5 / std::cos(0.01), 1e-7);
  EXPECT_EQ(rangeOf(t, unknown.viewpoint, unknown.open, false, 0.01), kInfinity);
  // What is seen of free space alone.
  ViewExpander within(t, true);
  const View inside = within.expand({2, 2.5});
  EXPECT_NEAR(rangeOf(t, inside.viewpoint, inside.ends, false, 0.01), 2 / std::cos(0.01), 1e-7);
  EXPECT_TRUE(inside.open.empty());
}

}  // namespace
}  // namespace mrpt_polyloc
