#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/MapIndexParts.h>
#include <mrpt_polyloc/localization/search/search_index_file.h>

#include <fstream>
#include <utility>

namespace mrpt_polyloc {

namespace {

// Measured on floors of 90 to 10,000 m2 and on maps of real buildings: 1.5 to 2.7 KB, 30 to 250 us,
// the most on ragged maps with many open edges, where many are seen from everywhere.
constexpr double kBytesPerLeaf = 2400.0;
constexpr double kSecondsPerLeaf = 90e-6;

}  // namespace

void MapIndexParams::check() const {
  requireInRange("leaf_size", leaf_size, 0.01, 10.0);
  requirePositive("horizon", horizon);
  requireInRange("threads", threads, 0.0, 1024.0);
}

MapIndexParts::MapIndexParts(PolygonMap polygon_map, const MapIndexParams& parameters)
    : map(std::move(polygon_map)), params(parameters) {
  params.check();
}

const Triangulation& MapIndexParts::triangulation() const {
  return triangulation_.get([this] { return Triangulation(map); });
}

const RangePredictor& MapIndexParts::predictor(BuildProgress* progress) const {
  return predictor_.get([&] {
    return RangePredictor(triangulation(), kLeavesPerSquare * params.leaf_size, params.threads,
                          params.horizon, progress);
  });
}

const SearchTree& MapIndexParts::tree(BuildProgress* progress) const {
  return tree_.get([&] {
    return SearchTree(triangulation(), predictor(), {params.leaf_size, params.threads}, progress);
  });
}

void MapIndexParts::take(VisibleEdgeIndex::Lists edges, SearchTree::Data data) {
  if (edges.square_size != kLeavesPerSquare * data.leaf_size) {
    throw InvalidMapError("index: its parts are not of one size");
  }
  SearchTreeParams{data.leaf_size, params.threads}.check();
  // What lies elsewhere than the map is a bad file's. Leaves are cut from it, to rounding.
  BoundingBox within = triangulation().box();
  const TPoint2D margin(data.leaf_size, data.leaf_size);
  within.min -= margin;
  within.max += margin;
  for (const BoundingBox& box : data.levels.back().boxes) {
    if (!within.contains(box.min) || !within.contains(box.max)) {
      throw InvalidMapError("index: leaves outside the map");
    }
  }
  params.leaf_size = data.leaf_size;
  params.horizon = edges.horizon;
  predictor_.get([&] { return RangePredictor(triangulation(), std::move(edges)); });
  tree_.get([&] { return SearchTree(std::move(data)); });
}

std::size_t MapIndexParts::bytes() const {
  std::size_t sum = 0;
  if (triangulation_.isMade()) sum += triangulation_.value().bytes();
  if (predictor_.isMade()) {
    sum += predictor_.value().index().bytes() + predictor_.value().wallDistances().bytes();
  }
  if (tree_.isMade()) sum += tree_.value().bytes();
  return sum;
}

MapIndex::MapIndex(std::unique_ptr<MapIndexParts> parts) : parts_(std::move(parts)) {}
MapIndex::~MapIndex() = default;

MapIndexEstimate MapIndex::estimate(const PolygonMap& map, const MapIndexParams& params) {
  params.check();
  // Leaves: squares of free space, and along its borders those that are cut, mostly in two.
  const double leaf = params.leaf_size;
  const double leaves = map.area() / (leaf * leaf) + 2.0 * map.perimeter() / leaf;
  return {kBytesPerLeaf * leaves, kSecondsPerLeaf * leaves};
}

MapIndex::Ptr MapIndex::build(PolygonMap map, const MapIndexParams& params,
                              const ProgressFunction& progress) {
  const Stopwatch watch;
  auto parts = std::make_unique<MapIndexParts>(std::move(map), params);
  constexpr double kEdgesShare = 0.4;  // of the time, measured
  BuildProgress edges(&progress, 0.0, kEdgesShare), tree(&progress, kEdgesShare, 1.0);
  parts->predictor(&edges);
  parts->tree(&tree);
  parts->build_seconds = watch.seconds();
  return Ptr(new MapIndex(std::move(parts)));
}

MapIndex::Ptr MapIndex::deferred(PolygonMap map, const MapIndexParams& params) {
  return Ptr(new MapIndex(std::make_unique<MapIndexParts>(std::move(map), params)));
}

MapIndex::Ptr MapIndex::load(std::istream& in, PolygonMap map, const std::string& file) {
  const Stopwatch watch;
  SearchIndex stored = readIndex(in, file, map.hash());
  auto parts = std::make_unique<MapIndexParts>(std::move(map), MapIndexParams{});
  try {
    parts->take(std::move(stored.edges), std::move(stored.tree));
  } catch (const InvalidMapError& error) {
    throw FormatError(file, "", error.what());
  } catch (const InvalidParamsError& error) {
    throw FormatError(file, "", error.what());
  }
  parts->build_seconds = watch.seconds();
  return Ptr(new MapIndex(std::move(parts)));
}

MapIndex::Ptr MapIndex::load(const std::string& path, PolygonMap map) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FormatError(path, "", "cannot be read");
  return load(file, std::move(map), path);
}

void MapIndex::save(std::ostream& out) const {
  writeIndex(out, parts_->predictor().index().lists(), parts_->tree().data(), parts_->map.hash());
}

const PolygonMap& MapIndex::map() const {
  return parts_->map;
}
double MapIndex::leafSize() const {
  return parts_->params.leaf_size;
}
std::size_t MapIndex::bytes() const {
  return parts_->bytes();
}
double MapIndex::buildSeconds() const {
  return parts_->build_seconds;
}

}  // namespace mrpt_polyloc
