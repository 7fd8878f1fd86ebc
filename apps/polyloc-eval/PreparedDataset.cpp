#include "PreparedDataset.h"

#include "../common/map_input.h"
#include <mrpt_polyloc/base/Checksum.h>
#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/baselines/rasterize.h>
#include <mrpt_polyloc/evaluation/stretches.h>
#include <mrpt_polyloc/io/bitmap_files.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/io/result_json.h>
#include <mrpt_polyloc/io/wkt.h>

#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

using nlohmann::ordered_json;

PolygonMap loadDatasetMap(const Program& program, const DatasetEntry& entry, double scale) {
  if (entry.plan.empty()) return loadMapWithWarnings(program, entry.map, scale).map;
  const std::string place = entry.map + ": " + entry.name;
  try {
    RepairedMap repaired = repairMap(parseWkt(entry.plan, place));
    warnOfRepairs(program, place, repaired.repairs);
    return std::move(repaired.map);
  } catch (const InvalidMapError& error) {
    throw InvalidMapError(place + ": " + error.what());
  }
}

EvaluationInputs simulateInputs(const PolygonMap& map, const SimulationInput& simulation) {
  EvaluationInputs inputs;
  for (const SimulatedScan& scan :
       simulateScans(map, simulation.params(), simulation.count, simulation.seed)) {
    inputs.scans.push_back(toRangeScan(scan.observation));
    inputs.truth.push_back(scan.truth.pose_map_robot);
  }
  return inputs;
}

std::string hashOf(const EvaluationInputs& inputs) {
  Checksum sum;
  const auto add = [&](double number) { sum.add(&number, sizeof number); };
  for (const RangeScan& scan : inputs.scans) {
    add(scan.stamp());
    for (const Beam& beam : scan.beams()) {
      add(beam.bearing);
      add(beam.range);
      add(static_cast<double>(beam.kind));
    }
  }
  for (const auto& pose : inputs.truth) {
    for (const double value : {pose.x, pose.y, pose.phi}) add(value);
  }
  if (inputs.good) {
    for (const std::size_t row : *inputs.good) add(static_cast<double>(row));
  }
  return hashText(sum.value());
}

/// The stretch of the drive that each evaluated row belongs to. They are cut on all rows, for the
/// few that are evaluated may be far apart and still of one place; simulated scans are no drive.
std::vector<std::size_t> stretchesOfRows(const PreparedDataset& dataset, bool is_simulated) {
  std::vector<std::size_t> stretches(dataset.rows.size());
  std::iota(stretches.begin(), stretches.end(), std::size_t{0});
  if (is_simulated) return stretches;
  const std::vector<std::size_t> whole = stretchesOf(dataset.inputs.truth);
  for (std::size_t i = 0; i < stretches.size(); ++i) stretches[i] = whole[dataset.rows[i]];
  return stretches;
}

/// Centimetres from the box's corner, x and y in turn.
ordered_json toCentimetres(const std::vector<TPoint2D>& points, const TPoint2D& corner) {
  ordered_json flat = ordered_json::array();
  for (const TPoint2D& point : points) {
    flat.push_back(std::lround(100.0 * (point.x - corner.x)));
    flat.push_back(std::lround(100.0 * (point.y - corner.y)));
  }
  return flat;
}

ordered_json outlineOf(const PolygonMap& map) {
  const BoundingBox& box = map.boundingBox();
  ordered_json outline = {{"x", box.min.x},
                          {"y", box.min.y},
                          {"width", box.max.x - box.min.x},
                          {"height", box.max.y - box.min.y}};
  ordered_json rings = ordered_json::array(), open = rings, beyond = rings;
  for (const Ring* ring : map.rings()) {
    rings.push_back(toCentimetres(ring->vertices, box.min));
    for (std::size_t i = 0; i < ring->size(); ++i) {
      if (ring->kinds[i] != EdgeKind::open) continue;
      open.push_back(
          toCentimetres({ring->vertices[i], ring->vertices[(i + 1) % ring->size()]}, box.min));
    }
  }
  for (const Polyline& wall : map.wallsBeyond()) beyond.push_back(toCentimetres(wall, box.min));
  outline["rings"] = std::move(rings);
  outline["open"] = std::move(open);
  outline["beyond"] = std::move(beyond);
  return outline;
}

}  // namespace

ordered_json PreparedDataset::description(const DatasetEntry& entry,
                                          const Tolerance& tolerance) const {
  ordered_json json;
  json["statistics"] = mapStatistics(map);
  json["simulated"] = entry.simulation.has_value();
  json["good"] = inputs.good ? ordered_json(*inputs.good) : ordered_json(nullptr);
  json["stretches"] = stretchesOfRows(*this, entry.simulation.has_value());
  json["tolerance_m"] = tolerance.distance;
  json["tolerance_deg"] = toDegrees(tolerance.angle);
  json["outline"] = outlineOf(map);
  return json;
}

OccupancyBitmap PreparedDataset::bitmap(const DatasetEntry& entry, double cell) const {
  if (entry.plan.empty()) {
    if (auto bitmap = loadBitmap(entry.map)) return *std::move(bitmap);
  }
  return rasterize(map, cell);
}

PreparedDataset prepareDataset(const Program& program, const DatasetEntry& entry,
                               const EvaluationOptions& options) {
  const Stopwatch watch;
  PreparedDataset dataset{loadDatasetMap(program, entry, options.search.scale), {}, {}, 0.0, {}};
  dataset.map_s = watch.seconds();
  dataset.inputs = entry.simulation ? simulateInputs(dataset.map, *entry.simulation)
                                    : loadInputs(program, options);
  for (std::size_t row = 0; row < dataset.inputs.scans.size(); row += entry.every) {
    dataset.rows.push_back(row);
  }
  dataset.inputs_hash = hashOf(dataset.inputs);
  return dataset;
}

}  // namespace mrpt_polyloc::apps
