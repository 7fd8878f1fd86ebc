#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/baselines/mrpt_maps.h>

#include <algorithm>

namespace mrpt_polyloc {

using mrpt::maps::COccupancyGridMap2D;

COccupancyGridMap2D gridOf(const OccupancyBitmap& bitmap, double sigma) {
  constexpr float kOccupied = 0.02F, kFree = 0.98F, kUnknown = 0.5F;  // probability of being free
  if (std::count(bitmap.cells.begin(), bitmap.cells.end(), CellState::occupied) == 0) {
    throw InvalidMapError("the grid has no occupied cell");
  }
  COccupancyGridMap2D grid;
  const auto side = static_cast<float>(bitmap.resolution);
  grid.setSize(0.0F, static_cast<float>(bitmap.width) * side, 0.0F,
               static_cast<float>(bitmap.height) * side, side, kUnknown);
  for (int row = 0; row < bitmap.height; ++row) {
    for (int column = 0; column < bitmap.width; ++column) {
      const CellState state = bitmap.at(column, row);
      if (state == CellState::unknown) continue;
      grid.setCell(column, row, state == CellState::free ? kFree : kOccupied);
    }
  }
  auto& likelihood = grid.likelihoodOptions;
  likelihood.likelihoodMethod = COccupancyGridMap2D::lmLikelihoodField_Thrun;
  likelihood.LF_decimation = 1;
  likelihood.LF_stdHit = static_cast<float>(sigma);
  likelihood.LF_maxCorrsDistance = static_cast<float>(3.0 * sigma);
  return grid;
}

}  // namespace mrpt_polyloc
