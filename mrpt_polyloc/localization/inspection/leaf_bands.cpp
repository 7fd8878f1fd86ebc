#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/localization/MapIndexParts.h>
#include <mrpt_polyloc/localization/inspection/leaf_bands.h>
#include <mrpt_polyloc/localization/search/QuantizedRange.h>

#include <cstdint>
#include <limits>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPoint2D;

bool holds(const SearchTree& tree, std::size_t leaf, const TPoint2D& point) {
  const BoundingBox& box = tree.box(0, leaf);
  if (point.x < box.min.x || point.x > box.max.x || point.y < box.min.y || point.y > box.max.y) {
    return false;
  }
  const TPoint2D* p = tree.polygon(leaf);
  const std::size_t n = tree.polygonSize(leaf);
  for (std::size_t i = 0; i < n; ++i) {
    if (cross(p[(i + 1) % n] - p[i], point - p[i]) < 0.0) return false;
  }
  return true;
}

LeafBands::Bin binOf(const SearchTree::Bands& bands, std::size_t b) {
  const double unit = QuantizedRange::unit(bands.scale);
  LeafBands::Bin bin;
  bin.near = unit * bands.near_low[b];
  const bool is_bounded = bands.wall_high[b] < QuantizedRange::kGreatest;
  bin.wall = is_bounded ? unit * bands.wall_high[b] : std::numeric_limits<double>::infinity();
  if (bands.gap_high[b] > bands.gap_low[b]) {
    bin.gap_low = unit * bands.gap_low[b];
    bin.gap_high = unit * bands.gap_high[b];
  }
  return bin;
}

}  // namespace

std::optional<LeafBands> leafBandsAt(const MapIndex& index, const TPoint2D& point) {
  const SearchTree& tree = index.parts().tree();
  const std::size_t count = tree.nodes(0).size();
  for (std::size_t leaf = 0; leaf < count; ++leaf) {
    if (!holds(tree, leaf, point)) continue;
    LeafBands found;
    found.leaf = leaf;
    found.polygon.assign(tree.polygon(leaf), tree.polygon(leaf) + tree.polygonSize(leaf));
    found.width = kBandBinWidth;
    const SearchTree::Bands bands = tree.bands(0, leaf);
    for (std::size_t b = 0; b < kBandBins; ++b) found.bins.push_back(binOf(bands, b));
    return found;
  }
  return std::nullopt;
}

}  // namespace mrpt_polyloc
