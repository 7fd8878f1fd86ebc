#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/evaluation/baselines/rasterize.h>

#include <gtest/gtest.h>

#include <cmath>

namespace mrpt_polyloc {
namespace {

PolygonMap map() {
  Ring outer = wallRing({{-1, 2}, {5, 1}, {6, 6}, {2, 7}});
  outer.kinds[1] = EdgeKind::open;
  return PolygonMap({{outer, {wallRing({{2, 3}, {2, 4}, {3.5, 4.2}, {3, 3}})}}},
                    {{{6.5, 0.5}, {7.5, 6}}});
}

TEST(Rasterize, CellsSayWhatTheirMiddlesAndWallsDo) {
  const PolygonMap polygons = map();
  constexpr double kCell = 0.1;
  const OccupancyBitmap bitmap = rasterize(polygons, kCell);
  std::size_t counts[3] = {0, 0, 0};
  for (int row = 0; row < bitmap.height; ++row) {
    for (int column = 0; column < bitmap.width; ++column) {
      const TPoint2D middle{bitmap.pose_map_bitmap.x + kCell * (column + 0.5),
                            bitmap.pose_map_bitmap.y + kCell * (row + 0.5)};
      double wall = 1e9;
      for (const Ring* ring : polygons.rings()) {
        for (std::size_t i = 0; i < ring->size(); ++i) {
          if (ring->kinds[i] == EdgeKind::open) continue;
          wall = std::min(wall, distanceToSegment(middle, ring->vertices[i],
                                                  ring->vertices[(i + 1) % ring->size()]));
        }
      }
      wall = std::min(wall, distanceToSegment(middle, {6.5, 0.5}, {7.5, 6}));
      // Which side of an open edge a middle on it lies is nobody's business.
      if (distanceToSegment(middle, {5, 1}, {6, 6}) < 1e-9) continue;
      const CellState state = bitmap.at(column, row);
      ++counts[static_cast<std::size_t>(state)];
      // A wall through a cell passes its middle within half a diagonal; one nearer than 0.45 sides
      // runs through it for a good part.
      if (wall < 0.45 * kCell) {
        ASSERT_EQ(state, CellState::occupied) << middle.x << " " << middle.y;
      } else if (wall > 0.72 * kCell) {
        ASSERT_EQ(state, polygons.contains(middle) ? CellState::free : CellState::unknown)
            << middle.x << " " << middle.y;
      }
    }
  }
  for (const std::size_t count : counts) EXPECT_GT(count, 100u);
}

TEST(Rasterize, RefusesCellsThatAreNone) {
  EXPECT_THROW(rasterize(map(), 0.0), InvalidParamsError);
  EXPECT_THROW(rasterize(map(), 1e-6), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
