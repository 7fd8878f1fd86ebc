#include "tests/support/bitmap_art.h"
#include "tests/support/noisy_grid.h"
#include "tracing_oracle.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/geometry/tracing.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mrpt_polyloc::test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

/// Every corner, every component.
TracingParams exact() {
  return {0.0, 0.0, 0.0};
}

/// Every component, simplified.
TracingParams simplified(double tolerance_cells) {
  return {tolerance_cells, 0.0, 0.0};
}

/// Bitmaps that are awkward somewhere, with one of noise of every kind.
std::vector<OccupancyBitmap> awkwardBitmaps() {
  std::vector<OccupancyBitmap> all{
      bitmapFromArt({"."}),
      bitmapFromArt({"....", "....", "...."}),
      bitmapFromArt({".#.#.#", "#.#.#.", ".#.#.#", "#.#.#."}),
      bitmapFromArt({".?.?.?", "?.?.?.", ".#.?.#", "#.?.#."}),
      bitmapFromArt({".....", ".#...", "..#..", "...#.", "....."}),  // diagonal specks
      bitmapFromArt({"......", ".#..#.", "..##..", "..##..", ".#..#.", "......"}),
      bitmapFromArt({".....", "..#..", ".#.#.", "..#..", "....."}),  // closed by corners only
      bitmapFromArt({"#....", ".#...", "..#..", "...#.", "....#"}),  // cut by corners only
      bitmapFromArt({"#####", "#...#", "#.#.#", "#...#", "#####"}),
      bitmapFromArt({".......", ".#####.", ".#...#.", ".#.?.#.", ".#...#.", ".#####.", "......."}),
      bitmapFromArt({"?#####?", "#.....#", "#.###.#", "#.#.#.#", "#.###.#", "#.....#", "?#####?"}),
      bitmapFromArt({"........", "#######.", "......#.", ".####.#.", ".#....#.", ".######.",
                     "........"}),                                        // spiral
      bitmapFromArt({"??????", "?#??#?", "?.??#?", "?##???", "?????#"}),  // blobs in the unknown
      bitmapFromArt({"..##..", "..##..", "##..##", "##..##", "..##..", "..##.."}),
      bitmapFromArt({".?#", "#.?", "?#."}),
      bitmapFromArt({"..?..", ".#?#.", "??.??", ".#?#.", "..?.."}),
  };
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    all.push_back(noiseBitmap(16, 12, 0.5, 0.5, seed));
    all.push_back(noiseBitmap(15, 15, 0.6, 0.2, seed));
    all.push_back(noiseBitmap(20, 9, 0.93, 0.05, seed));
    all.push_back(blobBitmap(24, 24, 12, seed));
  }
  for (std::uint32_t seed = 1; seed <= 6; ++seed) all.push_back(blobBitmap(70, 66, 25, seed));
  return all;
}

/// Calls check(map, bitmap) with every awkward bitmap that has free cells, traced.
template <class Check>
void forAwkward(const TracingParams& params, Check&& check) {
  for (const OccupancyBitmap& bitmap : awkwardBitmaps()) {
    if (floodComponents(bitmap, 1).free_cells == 0) continue;
    SCOPED_TRACE(toArt(bitmap));
    check(traceBitmap(bitmap, params), bitmap);
    if (::testing::Test::HasFailure()) return;  // one picture is enough
  }
}

TEST(Tracing, FollowsTheCellSidesExactly) {
  forAwkward(exact(), [](const PolygonMap& map, const OccupancyBitmap& bitmap) {
    const SideCounts sides = countSides(bitmap);
    EXPECT_DOUBLE_EQ(map.area(), static_cast<double>(floodComponents(bitmap, 1).free_cells));
    EXPECT_DOUBLE_EQ(map.openPerimeter(), static_cast<double>(sides.open));
    EXPECT_DOUBLE_EQ(map.perimeter(), static_cast<double>(sides.open + sides.wall));
    EXPECT_DOUBLE_EQ(map.wallsBeyondLength(), static_cast<double>(sides.beyond));
    for (int row = 0; row < bitmap.height; ++row) {
      for (int column = 0; column < bitmap.width; ++column) {
        ASSERT_EQ(map.contains({column + 0.5, row + 0.5}),
                  bitmap.at(column, row) == CellState::free)
            << column << ", " << row;
      }
    }
  });
}

TEST(Tracing, EveryCellSideHasItsKind) {
  forAwkward(exact(), [](const PolygonMap& map, const OccupancyBitmap& bitmap) {
    for (const TracedEdge& edge : tracedEdges(map)) {
      const double length = std::hypot(edge.b.x - edge.a.x, edge.b.y - edge.a.y);
      const TPoint2D along{(edge.b.x - edge.a.x) / length, (edge.b.y - edge.a.y) / length};
      for (double at = 0.5; at < length; at += 1.0) {
        const TPoint2D p{edge.a.x + at * along.x, edge.a.y + at * along.y};
        const auto cell = [&](double side) {
          return bitmap.at(static_cast<int>(std::floor(p.x - side * along.y)),
                           static_cast<int>(std::floor(p.y + side * along.x)));
        };
        const CellState left = cell(0.5);
        const CellState right = cell(-0.5);
        if (edge.kind == 'b') {
          ASSERT_NE(left, right);
          ASSERT_TRUE(left != CellState::free && right != CellState::free);
        } else {
          ASSERT_EQ(left, CellState::free);
          ASSERT_EQ(right, edge.kind == '#' ? CellState::occupied : CellState::unknown);
        }
      }
    }
  });
}

TEST(Tracing, RingsAreSimpleAndNothingCrosses) {
  for (const double tolerance : {0.0, 0.5, 0.71, 1.0, 1.5, 3.0, 100.0}) {
    SCOPED_TRACE(tolerance);
    forAwkward(simplified(tolerance), [](const PolygonMap& map, const OccupancyBitmap&) {
      EXPECT_EQ(findBadRing(map), "");
      EXPECT_EQ(findCrossing(map), "");
    });
  }
}

TEST(Tracing, SimplificationKeepsComponentsHolesAndWallsBeyond) {
  for (const double tolerance : {0.5, 1.0, 3.0, 100.0}) {
    SCOPED_TRACE(tolerance);
    forAwkward(simplified(tolerance), [](const PolygonMap& map, const OccupancyBitmap& bitmap) {
      const PolygonMap reference = traceBitmap(bitmap, exact());
      ASSERT_EQ(map.components().size(), reference.components().size());
      for (std::size_t i = 0; i < map.components().size(); ++i) {
        EXPECT_EQ(map.components()[i].holes.size(), reference.components()[i].holes.size());
      }
      ASSERT_EQ(map.wallsBeyond().size(), reference.wallsBeyond().size());
      EXPECT_LE(map.vertexCount(), reference.vertexCount());
    });
  }
}

/// Greatest distance from the edges of one kind, sampled densely, to those of another map.
double directedDistance(const PolygonMap& from, const PolygonMap& to, char kind) {
  std::vector<TracedEdge> targets;
  for (const TracedEdge& edge : tracedEdges(to)) {
    if (edge.kind == kind) targets.push_back(edge);
  }
  double greatest = 0.0;
  for (const TracedEdge& edge : tracedEdges(from)) {
    if (edge.kind != kind) continue;
    for (double t = 0.0; t <= 1.0; t += 0.125) {
      const TPoint2D p{edge.a.x + t * (edge.b.x - edge.a.x), edge.a.y + t * (edge.b.y - edge.a.y)};
      greatest = std::max(greatest, distance(p, targets));
    }
  }
  return greatest;
}

TEST(Tracing, StaysWithinTheTolerance) {
  for (const double tolerance : {0.5, 1.0, 2.5}) {
    SCOPED_TRACE(tolerance);
    forAwkward(simplified(tolerance), [&](const PolygonMap& map, const OccupancyBitmap& bitmap) {
      const PolygonMap reference = traceBitmap(bitmap, exact());
      for (const char kind : {'#', '?', 'b'}) {
        EXPECT_LE(directedDistance(map, reference, kind), tolerance + 1e-9) << kind;
        EXPECT_LE(directedDistance(reference, map, kind), tolerance + 1e-9) << kind;
      }
    });
  }
}

TEST(Tracing, CellsFarFromTheBorderKeepTheirState) {
  forAwkward(simplified(1.0), [](const PolygonMap& map, const OccupancyBitmap& bitmap) {
    const std::vector<TracedEdge> borders = tracedEdges(traceBitmap(bitmap, exact()));
    for (int row = 0; row < bitmap.height; ++row) {
      for (int column = 0; column < bitmap.width; ++column) {
        const TPoint2D centre{column + 0.5, row + 0.5};
        if (distance(centre, borders) <= 1.0) continue;
        ASSERT_EQ(map.contains(centre), bitmap.at(column, row) == CellState::free)
            << column << ", " << row;
      }
    }
  });
}

/// Free below a slanted line, occupied above.
OccupancyBitmap slantedWall(int size, double slope) {
  OccupancyBitmap bitmap = uniformBitmap(size, size, CellState::occupied);
  const double middle = 0.5 * size;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const bool below = row + 0.5 - middle < slope * (column + 0.5 - middle);
      if (below) cellAt(bitmap, column, row) = CellState::free;
    }
  }
  return bitmap;
}

TEST(Tracing, SlantedWallsBecomeStraightWithoutBias) {
  for (const double slope : {0.01, 0.03, 0.1, 0.2, 0.37, 0.5, 0.61, 0.7, 0.83, 0.9, 1.0}) {
    for (const double sign : {1.0, -1.0}) {
      SCOPED_TRACE(sign * slope);
      const OccupancyBitmap bitmap = slantedWall(200, sign * slope);
      const PolygonMap map = traceBitmap(bitmap, simplified(1.0));
      EXPECT_LE(map.vertexCount(), 4u + 3u);
      const double wall_length = map.perimeter() - map.openPerimeter();
      const double cells = static_cast<double>(floodComponents(bitmap, 1).free_cells);
      EXPECT_LE(std::abs(map.area() - cells) / wall_length, 0.5);
    }
  }
}

TEST(Tracing, AxisParallelWallsStayExact) {
  const PolygonMap map = traceBitmap(bitmapFromArt({"##########",  //
                                                    "#........#",  //
                                                    "#........#",  //
                                                    "#....#####",  //
                                                    "#....#####",  //
                                                    "##########"}),
                                     simplified(1.0));
  EXPECT_EQ(map.vertexCount(), 6u);
  EXPECT_DOUBLE_EQ(map.area(), 8 + 8 + 4 + 4);
}

TEST(Tracing, SpecksKeepTheirSize) {
  const PolygonMap map = traceBitmap(
      bitmapFromArt({"........", ".#....#.", ".....##.", ".##.....", "........"}), simplified(1.0));
  ASSERT_EQ(map.holeCount(), 3u);
  EXPECT_THAT(map.components()[0].holes[0].vertices, SizeIs(4));
  EXPECT_DOUBLE_EQ(signedArea(map.components()[0].holes[0].vertices), -2.0);
  EXPECT_THAT(map.components()[0].holes[2].vertices, SizeIs(4));
  EXPECT_DOUBLE_EQ(signedArea(map.components()[0].holes[2].vertices), -1.0);
}

TEST(Tracing, SideConnectedFreeSpaceOnly) {
  const PolygonMap map = traceBitmap(bitmapFromArt({"..#", "..#", "##."}), exact());
  ASSERT_THAT(map.components(), SizeIs(2));
  EXPECT_DOUBLE_EQ(signedArea(map.components()[0].outer.vertices), 1.0);
  EXPECT_DOUBLE_EQ(signedArea(map.components()[1].outer.vertices), 4.0);
}

TEST(Tracing, DropsSmallComponentsAsUnknown) {
  const OccupancyBitmap bitmap = bitmapFromArt({"....#..", "....#..", "....###"});
  TracingParams params = exact();
  params.min_component_area = 4.0;
  EXPECT_THAT(traceBitmap(bitmap, params).components(), SizeIs(2));
  params.min_component_area = 4.5;
  const PolygonMap map = traceBitmap(bitmap, params);
  EXPECT_THAT(map.components(), SizeIs(1));
  EXPECT_DOUBLE_EQ(map.wallsBeyondLength(),
                   static_cast<double>(countSides(floodComponents(bitmap, 5).bitmap).beyond));
}

TEST(Tracing, ComponentAreaIsComparedInSquareMetres) {
  OccupancyBitmap bitmap = uniformBitmap(10, 10, CellState::free);
  bitmap.resolution = 0.05;  // 100 cells of 0.05 m are 0.25 m2
  EXPECT_NEAR(traceBitmap(bitmap).area(), 0.25, 1e-12);
  cellAt(bitmap, 0, 0) = CellState::unknown;
  EXPECT_THROW(traceBitmap(bitmap), InvalidMapError);
}

TEST(Tracing, FillsUnknownPatchesInFreeSpaceOnRequest) {
  const OccupancyBitmap bitmap = bitmapFromArt({".........",  //
                                                ".?...??..",  //
                                                "..?..??..",  //
                                                "........?",  //
                                                "#?.......",  //
                                                "........."});
  TracingParams params = exact();
  EXPECT_DOUBLE_EQ(traceBitmap(bitmap, params).area(), 54 - 9);
  params.max_filled_unknown_area = 2.0;
  EXPECT_DOUBLE_EQ(traceBitmap(bitmap, params).area(), 54 - 7);
  params.max_filled_unknown_area = 4.0;
  EXPECT_DOUBLE_EQ(traceBitmap(bitmap, params).area(), 54 - 3);  // rim and speck stay
}

TEST(Tracing, WallsBeyondAreTheFarSkinsAndBlobsInTheUnknown) {
  const PolygonMap map = traceBitmap(bitmapFromArt({"??????",  //
                                                    "?...??",  //
                                                    "?...#?",  //
                                                    "??????",  //
                                                    "?##???"}),
                                     exact());
  ASSERT_THAT(map.wallsBeyond(), SizeIs(2));
  EXPECT_DOUBLE_EQ(map.wallsBeyondLength(), 3.0 + 6.0);
  for (const Polyline& wall : map.wallsBeyond()) {
    const bool closed = wall.front().x == wall.back().x && wall.front().y == wall.back().y;
    EXPECT_THAT(wall, SizeIs(closed ? 5 : 4));
  }
}

TEST(Tracing, PoseIsAppliedUnrounded) {
  OccupancyBitmap bitmap = bitmapFromArt({"..", "#.", ".."});
  const PolygonMap plain = traceBitmap(bitmap, exact());
  bitmap.resolution = 0.1;
  bitmap.pose_map_bitmap = {1.2345, -6.789, 0.3};
  const PolygonMap placed = traceBitmap(bitmap, exact());
  const std::vector<TracedEdge> from = tracedEdges(plain);
  const std::vector<TracedEdge> to = tracedEdges(placed);
  ASSERT_EQ(from.size(), to.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double x = 0.1 * from[i].a.x;
    const double y = 0.1 * from[i].a.y;
    EXPECT_NEAR(to[i].a.x, 1.2345 + x * std::cos(0.3) - y * std::sin(0.3), 1e-12);
    EXPECT_NEAR(to[i].a.y, -6.789 + x * std::sin(0.3) + y * std::cos(0.3), 1e-12);
    EXPECT_EQ(from[i].kind, to[i].kind);
  }
  EXPECT_EQ(placed.cellSize(), 0.1);
}

TEST(Tracing, NoisyGridKeepsItsTopology) {
  OccupancyBitmap bitmap = noisyGrid(500, 400, 5);
  bitmap.resolution = 1.0;  // so that the checks are exact
  for (const double tolerance : {0.5, 1.0, 2.0}) {
    SCOPED_TRACE(tolerance);
    const PolygonMap map = traceBitmap(bitmap, simplified(tolerance));
    EXPECT_EQ(findBadRing(map), "");
    EXPECT_EQ(findCrossingInSquares(map, 8.0), "");
    EXPECT_EQ(map.holeCount(), traceBitmap(bitmap, exact()).holeCount());
  }
}

TEST(Tracing, IsDeterministic) {
  const OccupancyBitmap bitmap = blobBitmap(60, 60, 40, 7);
  EXPECT_EQ(traceBitmap(bitmap, simplified(1.0)).hash(),
            traceBitmap(bitmap, simplified(1.0)).hash());
}

/// The message of the InvalidMapError that tracing must throw.
std::string refusal(const OccupancyBitmap& bitmap) {
  try {
    traceBitmap(bitmap);
  } catch (const InvalidMapError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(TracingErrors, NoFreeSpace) {
  for (const CellState state : {CellState::unknown, CellState::occupied}) {
    EXPECT_THAT(refusal(uniformBitmap(5, 4, state)), HasSubstr("no free component"));
  }
}

TEST(TracingErrors, MalformedBitmaps) {
  EXPECT_THAT(refusal(OccupancyBitmap{}), HasSubstr("no cells (0 x 0)"));
  EXPECT_THAT(refusal(uniformBitmap(0, 5, CellState::free)), HasSubstr("no cells (0 x 5)"));
  OccupancyBitmap bitmap = uniformBitmap(3, 2, CellState::free);
  bitmap.width = -3;
  EXPECT_THAT(refusal(bitmap), HasSubstr("no cells (-3 x 2)"));
  bitmap.width = 4;
  EXPECT_THAT(refusal(bitmap), HasSubstr("6 cells given for 4 x 2"));
}

TEST(TracingErrors, MeasuresThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, 0.0, -0.05}) {
    OccupancyBitmap bitmap = uniformBitmap(3, 3, CellState::free);
    bitmap.resolution = bad;
    EXPECT_THAT(refusal(bitmap), HasSubstr("resolution"));
  }
  for (const mrpt::math::TPose2D& bad :
       {mrpt::math::TPose2D{nan, 0, 0}, mrpt::math::TPose2D{0, inf, 0},
        mrpt::math::TPose2D{0, 0, nan}}) {
    OccupancyBitmap bitmap = uniformBitmap(3, 3, CellState::free);
    bitmap.pose_map_bitmap = bad;
    EXPECT_THAT(refusal(bitmap), HasSubstr("pose"));
  }
}

TEST(TracingErrors, ParametersOutOfRange) {
  const OccupancyBitmap bitmap = uniformBitmap(3, 3, CellState::free);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<TracingParams, std::string>> cases{
      {{-1.0, 0.25, 0.0}, "tolerance_cells"},
      {{nan, 0.25, 0.0}, "tolerance_cells"},
      {{1.0, -0.25, 0.0}, "min_component_area"},
      {{1.0, nan, 0.0}, "min_component_area"},
      {{1.0, 0.25, -1.0}, "max_filled_unknown_area"},
      {{1.0, 0.25, nan}, "max_filled_unknown_area"}};
  for (const auto& [params, field] : cases) {
    try {
      traceBitmap(bitmap, params);
      ADD_FAILURE() << field << " was accepted";
    } catch (const InvalidParamsError& error) {
      EXPECT_THAT(error.what(), HasSubstr(field));
    }
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
