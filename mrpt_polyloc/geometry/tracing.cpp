#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/geometry/bitmap_regions.h>
#include <mrpt_polyloc/geometry/border_chains.h>
#include <mrpt_polyloc/geometry/chain_simplification.h>
#include <mrpt_polyloc/geometry/ring_assembly.h>
#include <mrpt_polyloc/geometry/tracing.h>

#include <cmath>
#include <limits>
#include <string>

namespace mrpt_polyloc {
namespace {

void checkBitmap(const OccupancyBitmap& bitmap) {
  const auto fail = [](const std::string& reason) {
    throw InvalidMapError("occupancy bitmap: " + reason);
  };
  const std::string size = std::to_string(bitmap.width) + " x " + std::to_string(bitmap.height);
  if (bitmap.width <= 0 || bitmap.height <= 0) fail("no cells (" + size + ")");
  const auto width = static_cast<std::size_t>(bitmap.width);
  const auto height = static_cast<std::size_t>(bitmap.height);
  if (bitmap.cells.size() != width * height) {
    fail(std::to_string(bitmap.cells.size()) + " cells given for " + size);
  }
  // Regions are numbered, lattice points measured with 32 bits.
  if (width * height > std::numeric_limits<std::int32_t>::max() / kLatticePerCell) {
    fail(size + " cells are too many");
  }
  if (!std::isfinite(bitmap.resolution) || bitmap.resolution <= 0.0) {
    fail("resolution " + formatted("%g", bitmap.resolution) + " is not a positive length");
  }
  const mrpt::math::TPose2D& pose = bitmap.pose_map_bitmap;
  if (!std::isfinite(pose.x) || !std::isfinite(pose.y) || !std::isfinite(pose.phi)) {
    fail("its pose (" + formatted("%g", pose.x) + ", " + formatted("%g", pose.y) + ", " +
         formatted("%g", pose.phi) + ") is not finite");
  }
}

LatticePlacement placementOf(const OccupancyBitmap& bitmap) {
  const mrpt::math::TPose2D pose = bitmap.pose_map_bitmap;
  const double step = bitmap.resolution / kLatticePerCell;
  const double along = step * std::cos(pose.phi);
  const double across = step * std::sin(pose.phi);
  return [=](const LatticePoint& p) {
    return TPoint2D{pose.x + along * p.x - across * p.y, pose.y + across * p.x + along * p.y};
  };
}

}  // namespace

void TracingParams::check() const {
  requireNotNegative("tolerance_cells", tolerance_cells);
  requireNotNegative("min_component_area", min_component_area);
  requireNotNegative("max_filled_unknown_area", max_filled_unknown_area);
}

PolygonMap traceBitmap(const OccupancyBitmap& bitmap, const TracingParams& params) {
  params.check();
  checkBitmap(bitmap);
  // 0.25 m2 are 100 cells of 0.05 m, but not quite in binary fractions.
  constexpr double kRounding = 1e-9;
  const double cell_area = bitmap.resolution * bitmap.resolution;
  const RegionGrid regions =
      labelRegions(bitmap, params.min_component_area / cell_area * (1.0 - kRounding),
                   params.max_filled_unknown_area / cell_area * (1.0 + kRounding));
  if (regions.componentCount() == 0) {
    throw InvalidMapError("occupancy bitmap: no free component of at least " +
                          formatted("%g", params.min_component_area) + " m2");
  }
  const BorderChains borders =
      simplifyChains(traceBorders(regions), bitmap.width, bitmap.height, params.tolerance_cells);
  const LatticePlacement place = placementOf(bitmap);
  return PolygonMap(assemblePolygons(borders, regions.componentCount(), place),
                    collectWallsBeyond(borders, place), bitmap.resolution);
}

}  // namespace mrpt_polyloc
