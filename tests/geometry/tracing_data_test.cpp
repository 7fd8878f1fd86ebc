#include "tests/support/data_dir.h"
#include "tests/support/pgm.h"
#include "tracing_oracle.h"
#include <mrpt_polyloc/geometry/tracing.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

namespace mrpt_polyloc::test {
namespace {

std::vector<std::string> imagesIn(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".pgm") paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

bool hasOtherStateAround(const OccupancyBitmap& bitmap, int column, int row) {
  const bool is_free = bitmap.at(column, row) == CellState::free;
  for (int y = row - 1; y <= row + 1; ++y) {
    for (int x = column - 1; x <= column + 1; ++x) {
      if ((bitmap.at(x, y) == CellState::free) != is_free) return true;
    }
  }
  return false;
}

/// Cells whose state the map changes although no border is within a cell of their centre.
int countWronglyChangedCells(const PolygonMap& map, const OccupancyBitmap& bitmap) {
  const std::vector<bool> free = freeCentres(map, bitmap.width, bitmap.height);
  int count = 0;
  for (int row = 0; row < bitmap.height; ++row) {
    for (int column = 0; column < bitmap.width; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * static_cast<std::size_t>(bitmap.width) +
                            static_cast<std::size_t>(column);
      const bool changed = free[i] != (bitmap.cells[i] == CellState::free);
      count += changed && !hasOtherStateAround(bitmap, column, row);
    }
  }
  return count;
}

void checkTracing(OccupancyBitmap bitmap) {
  bitmap.resolution = 1.0;  // so that the checks are exact
  TracingParams params;
  params.min_component_area = 100.0;
  const FloodedBitmap flooded = floodComponents(bitmap, 100);

  const PolygonMap simplified = traceBitmap(bitmap, params);
  params.tolerance_cells = 0.0;
  const PolygonMap exact = traceBitmap(bitmap, params);

  EXPECT_DOUBLE_EQ(exact.area(), static_cast<double>(flooded.free_cells));
  const SideCounts sides = countSides(flooded.bitmap);
  EXPECT_DOUBLE_EQ(exact.openPerimeter(), static_cast<double>(sides.open));
  EXPECT_DOUBLE_EQ(exact.perimeter(), static_cast<double>(sides.open + sides.wall));
  EXPECT_DOUBLE_EQ(exact.wallsBeyondLength(), static_cast<double>(sides.beyond));
  EXPECT_EQ(simplified.components().size(), static_cast<std::size_t>(flooded.component_count));
  EXPECT_EQ(simplified.holeCount(), exact.holeCount());
  EXPECT_EQ(findCrossingInSquares(simplified, 16.0), "");
  EXPECT_EQ(countWronglyChangedCells(simplified, flooded.bitmap), 0);
}

TEST(TracingData, RealGridsKeepTheirFreeSpaceAndTopology) {
  POLYLOC_DATA_OR_SKIP(data);
  int count = 0;
  for (const std::string folder : {"/scans", "/grids"}) {
    for (const std::string& path : imagesIn(data + folder)) {
      SCOPED_TRACE(path);
      const OccupancyBitmap bitmap = readPgm(path, 0.05);
      const auto start = std::chrono::steady_clock::now();
      const PolygonMap map = traceBitmap(bitmap);
      const std::chrono::duration<double, std::milli> took =
          std::chrono::steady_clock::now() - start;
      std::printf("%-28s %5d x %4d cells: %6zu vertices %5zu holes %5zu walls beyond %6.1f ms\n",
                  std::filesystem::path(path).parent_path().filename().c_str(), bitmap.width,
                  bitmap.height, map.vertexCount(), map.holeCount(), map.wallsBeyond().size(),
                  took.count());
      checkTracing(bitmap);
      ++count;
    }
  }
  EXPECT_GT(count, 0) << "no maps in " << data;
}

}  // namespace
}  // namespace mrpt_polyloc::test
