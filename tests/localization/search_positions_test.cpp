#include "tests/support/map_factories.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/localization/search_positions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace mrpt_polyloc::test {
namespace {

/// Whether a point is within 1e-9 of a border: it may then go either way.
bool isOnBorder(const PolygonMap& map, const TPoint2D& p) {
  for (const Ring* ring : map.rings()) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      const TPoint2D &a = ring->vertices[i], &b = ring->vertices[(i + 1) % ring->size()];
      const double dx = b.x - a.x, dy = b.y - a.y;
      const double t = ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy);
      const double s = std::clamp(t, 0.0, 1.0);
      if (std::hypot(p.x - a.x - s * dx, p.y - a.y - s * dy) < 1e-9) return true;
    }
  }
  return false;
}

void expectAllFreeLatticePoints(const PolygonMap& map, double spacing) {
  const Triangulation triangulation(map);
  const auto positions = searchPositions(triangulation, spacing);
  const std::set<std::pair<std::int32_t, std::int32_t>> found(positions.begin(), positions.end());
  EXPECT_EQ(found.size(), positions.size()) << "some twice";
  const BoundingBox& box = triangulation.box();
  std::size_t compared = 0, free = 0;
  for (std::int32_t row = -1; box.min.y + row * spacing < box.max.y + 1; ++row) {
    for (std::int32_t column = -1; box.min.x + column * spacing < box.max.x + 1; ++column) {
      const TPoint2D p(box.min.x + column * spacing, box.min.y + row * spacing);
      if (isOnBorder(map, p)) continue;
      ++compared;
      const bool is_free = map.contains(p);
      free += is_free;
      ASSERT_EQ(found.count({column, row}) == 1, is_free) << p.x << " " << p.y;
    }
  }
  EXPECT_GT(compared, 0U);
  EXPECT_LE(free, positions.size());
}

TEST(SearchPositions, OnRandomBuildings) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    FloorPlanParams params = randomParams(random);
    params.rooms_per_side = std::min(params.rooms_per_side, 2);
    expectAllFreeLatticePoints(floorPlan(params, seed), 0.17);
  }
}

TEST(SearchPositions, OnShapesWithBordersOnTheLattice) {
  for (const double spacing : {0.1, 0.25, 0.5, 1.0}) {
    for (const PolygonMap& map : {squareMap(3.0), lRoomMap(), pillarMap(), windmillMap(),
                                  touchingHolesMap(), tJunctionMap(), combMap(4)}) {
      expectAllFreeLatticePoints(map, spacing);
    }
  }
}

TEST(SearchPositions, FarFromTheOrigin) {
  expectAllFreeLatticePoints(translated(pillarMap(), 500000.0, 5000000.0), 0.3);
}

TEST(SearchPositions, BorderPointsMayBeTakenButNoneBeyondRoundingOutside) {
  const PolygonMap map = squareMap(1.0);
  const Triangulation triangulation(map);
  for (const auto& [column, row] : searchPositions(triangulation, 0.1)) {
    EXPECT_GE(column, 10);
    EXPECT_LE(column, 20);
    EXPECT_GE(row, 10);
    EXPECT_LE(row, 20);
  }
}

TEST(SearchPositions, NoneInARoomBetweenTheLatticePoints) {
  // The lattice starts at the corner of the box, 1 m off the map's: its columns are at -0.3, 0.4.
  const PolygonMap map = mapOf(rectangle(0, 0, 0.01, 5.03));
  const auto positions = searchPositions(Triangulation(map), 0.7);
  EXPECT_TRUE(positions.empty());
}

}  // namespace
}  // namespace mrpt_polyloc::test
