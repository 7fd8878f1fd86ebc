#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/geometry/orientation.h>
#include <mrpt_polyloc/visibility/VisibilityCells.h>
#include <mrpt_polyloc/visibility/segment_crossings.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace mrpt_polyloc {
namespace {

using Edges = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// Memory while the arrangement is built: the peak measured for floors of 100,000 cells.
constexpr double kBytesPerCell = 1750.0;

/// The least range that greatestRange() tries [m]: below it next to nothing is told apart.
constexpr double kLeastRange = 0.0625;

/// About this many cells share a bucket of the point location grid.
constexpr double kCellsPerBucket = 1.0;

/// Free space ends at its boundary: walls beyond would only add vertices.
PolygonMap withoutWallsBeyond(const PolygonMap& map) {
  return PolygonMap(map.components());
}

double checkedRange(double range) {
  if (std::isinf(range) && range > 0.0) return range;
  requirePositive("range", range);
  return range;
}

bool isFree(const Triangulation& t, std::int32_t face) {
  return face != Triangulation::kNone && t.faces()[static_cast<std::size_t>(face)].is_free;
}

/// The edges of the free faces that bound free space, free on the left; or those between them.
Edges edgesOf(const Triangulation& t, bool boundary) {
  Edges edges;
  for (std::size_t f = 0; f < t.faces().size(); ++f) {
    const Triangulation::Face& face = t.faces()[f];
    if (!face.is_free) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const bool is_boundary = face.passage[i] != Passage::clear || !isFree(t, face.neighbor[i]);
      // Dividing edges once, from one of their two sides.
      const bool is_wanted =
          boundary ? is_boundary : !is_boundary && face.neighbor[i] > static_cast<std::int32_t>(f);
      if (is_wanted) edges.emplace_back(face.vertex[(i + 1) % 3], face.vertex[(i + 2) % 3]);
    }
  }
  return edges;
}

/// Counts no further than to `enough` cells.
CellEstimate estimateOf(const Triangulation& t, const CriticalSegments& critical, double range,
                        std::size_t enough = std::numeric_limits<std::size_t>::max()) {
  const Edges dividers = std::isfinite(range) ? edgesOf(t, false) : Edges{};
  CellEstimate estimate;
  estimate.windows = critical.segments.size();
  estimate.dividers = dividers.size();
  if (estimate.cells() < enough) {
    estimate.crossings = countCrossings(critical.segments, dividers, t.vertices(), enough);
  }
  return estimate;
}

/// Twice the area over the perimeter: about the width, of a thin polygon too.
double widthOf(const std::vector<TPoint2D>& polygon) {
  double perimeter = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    perimeter += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  }
  return perimeter > 0.0 ? 2.0 * signedArea(polygon) / perimeter : 0.0;
}

std::string overBudget(const CellEstimate& estimate, std::size_t budget) {
  return formatted(
      "%zu critical segments with %zu crossings make up to %zu visibility cells, more than the "
      "budget of %zu; they would take about %.0f MB. Limit the range of the cells, or use the "
      "certified search, which needs none",
      estimate.windows, estimate.crossings, estimate.cells(), budget, estimate.megabytes());
}

}  // namespace

double CellEstimate::megabytes() const {
  return static_cast<double>(cells()) * kBytesPerCell * 1e-6;
}

CellBudgetError::CellBudgetError(const CellEstimate& e, std::size_t budget)
    : std::runtime_error(overBudget(e, budget)), estimate(e) {}

CellEstimate VisibilityCells::estimate(const PolygonMap& map, double range) {
  const Triangulation triangulation(withoutWallsBeyond(map));
  return estimateOf(triangulation,
                    mrpt_polyloc::criticalSegments(triangulation, checkedRange(range)), range);
}

double VisibilityCells::greatestRange(const PolygonMap& map, std::size_t max_cells) {
  const Triangulation triangulation(withoutWallsBeyond(map));
  const BoundingBox& box = triangulation.box();
  const double diagonal = std::hypot(box.width(), box.height());
  // Upwards, so that no count is much longer than the budget is high.
  double greatest = 0.0;
  for (int step = 0;; ++step) {
    const double limit = kLeastRange * std::pow(2.0, 0.5 * step);
    const double range = limit < diagonal ? limit : kUnlimitedRange;
    const CellEstimate estimate = estimateOf(
        triangulation, mrpt_polyloc::criticalSegments(triangulation, range), range, max_cells + 1);
    if (estimate.cells() > max_cells) {
      if (step == 0) throw CellBudgetError(VisibilityCells::estimate(map, range), max_cells);
      return greatest;
    }
    greatest = range;
    if (std::isinf(range)) return greatest;
  }
}

VisibilityCells::VisibilityCells(const PolygonMap& map, const VisibilityCellsParams& params)
    : range_(checkedRange(params.range)),
      triangulation_(withoutWallsBeyond(map)),
      critical_(mrpt_polyloc::criticalSegments(triangulation_, range_)) {
  const CellEstimate estimate = estimateOf(triangulation_, critical_, range_);
  if (estimate.cells() > params.max_cells) throw CellBudgetError(estimate, params.max_cells);
  faces_ = arrangeSegments(triangulation_.vertices(), edgesOf(triangulation_, true),
                           std::isfinite(range_) ? edgesOf(triangulation_, false) : Edges{},
                           critical_.segments);
  buildBuckets();
}

std::vector<TPoint2D> VisibilityCells::polygon(std::size_t cell) const {
  std::vector<TPoint2D> points;
  points.reserve(edgeCount(cell));
  for (std::size_t e = faces_.first[cell]; e < faces_.first[cell + 1]; ++e) {
    points.push_back(vertex(e));
  }
  return points;
}

std::vector<VisibilityCells::Change> VisibilityCells::changesAcross(std::size_t cell,
                                                                    std::size_t edge) const {
  std::vector<Change> changes;
  const std::size_t e = faces_.first[cell] + edge;
  for (std::size_t w = faces_.edges[e].first_window; w < faces_.edges[e + 1].first_window; ++w) {
    const std::int32_t window = faces_.windows[w];
    const CriticalSegment& segment =
        critical_.segments[static_cast<std::size_t>(std::abs(window) - 1)];
    // An edge that runs with the segment has its cell left of it, where the obstacle hides u if it
    // stands on the left.
    const bool appears = (window > 0) == segment.obstacle_left;
    for (std::uint32_t k = 0; k < segment.flipped_count; ++k) {
      changes.push_back({critical_.flipped[segment.first_flipped + k], appears});
    }
  }
  return changes;
}

double VisibilityCells::area(std::size_t cell) const {
  return signedArea(polygon(cell));
}

TPoint2D VisibilityCells::representative(std::size_t cell) const {
  const std::vector<TPoint2D> points = polygon(cell);
  const TPoint2D origin = points.front();
  double twice = 0.0, x = 0.0, y = 0.0, mean_x = 0.0, mean_y = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TPoint2D& p = points[i];
    const TPoint2D& q = points[(i + 1) % points.size()];
    const double ax = p.x - origin.x, ay = p.y - origin.y;
    const double bx = q.x - origin.x, by = q.y - origin.y;
    const double cross = ax * by - ay * bx;
    twice += cross;
    x += cross * (ax + bx);
    y += cross * (ay + by);
    mean_x += ax / static_cast<double>(points.size());
    mean_y += ay / static_cast<double>(points.size());
  }
  const TPoint2D mean{origin.x + mean_x, origin.y + mean_y};
  if (twice <= 0.0) return mean;  // rounded to nothing
  const TPoint2D center{origin.x + x / (3.0 * twice), origin.y + y / (3.0 * twice)};
  // In a sliver rounding may carry the centre of gravity out; the mean errs far less.
  return violation(cell, center) == 0.0 ? center : mean;
}

double VisibilityCells::violation(std::size_t cell, const TPoint2D& point) const {
  double worst = 0.0;
  const std::size_t begin = faces_.first[cell], end = faces_.first[cell + 1];
  for (std::size_t e = begin; e < end; ++e) {
    const TPoint2D& a = vertex(e);
    const TPoint2D& b = vertex(e + 1 < end ? e + 1 : begin);
    if (orientation(a, b, point) >= 0) continue;
    const double twice_area = (b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x);
    worst = std::max({worst, -twice_area, std::numeric_limits<double>::min()});
  }
  return worst;
}

template <class Visitor>
void VisibilityCells::forEachBucket(std::size_t cell, Visitor&& visit) const {
  const BoundingBox& box = triangulation_.box();
  BoundingBox around = BoundingBox::empty();
  for (std::size_t e = faces_.first[cell]; e < faces_.first[cell + 1]; ++e) {
    around.include(vertex(e));
  }
  const auto index = [this](double length, std::size_t count) {
    return std::min(static_cast<std::size_t>(std::max(length, 0.0) / bucket_size_), count - 1);
  };
  const std::size_t last_row = index(around.max.y - box.min.y, bucket_rows_);
  const std::size_t last_column = index(around.max.x - box.min.x, bucket_columns_);
  for (std::size_t row = index(around.min.y - box.min.y, bucket_rows_); row <= last_row; ++row) {
    for (std::size_t c = index(around.min.x - box.min.x, bucket_columns_); c <= last_column; ++c) {
      visit(row * bucket_columns_ + c);
    }
  }
}

void VisibilityCells::buildBuckets() {
  const BoundingBox& box = triangulation_.box();
  const double width = box.width(), height = box.height();
  const double buckets = std::max(1.0, static_cast<double>(size()) / kCellsPerBucket);
  bucket_size_ = std::max(std::sqrt(width * height / buckets), std::max(width, height) / 4096.0);
  bucket_columns_ = static_cast<std::size_t>(width / bucket_size_) + 1;
  bucket_rows_ = static_cast<std::size_t>(height / bucket_size_) + 1;
  first_in_bucket_.assign(bucket_columns_ * bucket_rows_ + 1, 0);
  // A cell rounded to nothing holds no point, but its edges seem to hold all those on their line.
  for (std::size_t cell = 0; cell < size(); ++cell) {
    if (area(cell) <= 0.0) continue;
    forEachBucket(cell, [this](std::size_t bucket) { ++first_in_bucket_[bucket + 1]; });
  }
  for (std::size_t b = 1; b < first_in_bucket_.size(); ++b) {
    first_in_bucket_[b] += first_in_bucket_[b - 1];
  }
  bucket_cells_.resize(first_in_bucket_.back());
  std::vector<std::uint32_t> next(first_in_bucket_.begin(), first_in_bucket_.end() - 1);
  for (std::size_t cell = 0; cell < size(); ++cell) {
    if (area(cell) <= 0.0) continue;
    forEachBucket(cell, [&](std::size_t bucket) {
      bucket_cells_[next[bucket]++] = static_cast<std::uint32_t>(cell);
    });
  }
}

std::int32_t VisibilityCells::locate(const TPoint2D& point) const {
  if (!triangulation_.isFree(point)) return kNone;
  const BoundingBox& box = triangulation_.box();
  const auto column = static_cast<std::size_t>((point.x - box.min.x) / bucket_size_);
  const auto row = static_cast<std::size_t>((point.y - box.min.y) / bucket_size_);
  const std::size_t bucket =
      std::min(row, bucket_rows_ - 1) * bucket_columns_ + std::min(column, bucket_columns_ - 1);
  // Rounded polygons may leave gaps between them: the cell that misses the point least.
  std::int32_t nearest = kNone;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = first_in_bucket_[bucket]; k < first_in_bucket_[bucket + 1]; ++k) {
    const double miss = violation(bucket_cells_[k], point);
    if (miss >= least) continue;
    least = miss;
    nearest = static_cast<std::int32_t>(bucket_cells_[k]);
    if (miss == 0.0) break;
  }
  return nearest;
}

double VisibilityCells::distanceOutside(std::size_t cell, const TPoint2D& point) const {
  double worst = 0.0;
  const std::size_t begin = faces_.first[cell], end = faces_.first[cell + 1];
  for (std::size_t e = begin; e < end; ++e) {
    const TPoint2D& a = vertex(e);
    const TPoint2D& b = vertex(e + 1 < end ? e + 1 : begin);
    const double x = b.x - a.x, y = b.y - a.y, length = std::hypot(x, y);
    if (length <= 0.0) continue;
    worst = std::max(worst, (y * (point.x - a.x) - x * (point.y - a.y)) / length);
  }
  return worst;
}

std::vector<TPoint2D> VisibilityCells::tiedPoints(double width) const {
  std::vector<std::uint32_t> degree(faces_.vertices.size(), 0);
  std::vector<bool> on_boundary(faces_.vertices.size(), false);
  std::vector<bool> is_tied(faces_.vertices.size(), false);
  std::vector<TPoint2D> points;
  for (std::size_t cell = 0; cell < size(); ++cell) {
    if (widthOf(polygon(cell)) < width) points.push_back(representative(cell));
    for (std::size_t i = 0; i < edgeCount(cell); ++i) {
      const std::size_t begin = faces_.first[cell];
      const auto from = static_cast<std::size_t>(faces_.edges[begin + i].from);
      const auto to =
          static_cast<std::size_t>(faces_.edges[begin + (i + 1) % edgeCount(cell)].from);
      ++degree[from];
      if (neighbor(cell, i) == kNone) on_boundary[from] = on_boundary[to] = true;
      const std::vector<Change> changes = changesAcross(cell, i);
      const bool conflicting = std::any_of(changes.begin(), changes.end(), [&](const Change& c) {
        return c.appears != changes.front().appears;
      });
      if (!conflicting || neighbor(cell, i) < static_cast<std::int32_t>(cell)) continue;
      is_tied[from] = is_tied[to] = true;
      points.push_back((faces_.vertices[from] + faces_.vertices[to]) * 0.5);
    }
  }
  for (std::size_t v = 0; v < degree.size(); ++v) {
    if (!on_boundary[v] && (is_tied[v] || degree[v] > 4)) points.push_back(faces_.vertices[v]);
  }
  return points;
}

std::size_t VisibilityCells::memory() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return bytes(faces_.vertices) + bytes(faces_.first) + bytes(faces_.edges) +
         bytes(faces_.windows) + bytes(first_in_bucket_) + bytes(bucket_cells_) +
         bytes(critical_.segments) + bytes(critical_.flipped);
}

}  // namespace mrpt_polyloc
