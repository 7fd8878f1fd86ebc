#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/geometry/constrained_delaunay.h>
#include <mrpt_polyloc/geometry/orientation.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace mrpt_polyloc {
namespace {

/// About this many faces share a bucket of the point location grid.
constexpr double kFacesPerBucket = 2.0;

/// Whether a point lies in a closed triangle.
bool holds(const Triangulation& t, const Triangulation::Face& face, const TPoint2D& point) {
  for (std::size_t i = 0; i < 3; ++i) {
    const TPoint2D& a = t.vertices()[static_cast<std::size_t>(face.vertex[(i + 1) % 3])];
    const TPoint2D& b = t.vertices()[static_cast<std::size_t>(face.vertex[(i + 2) % 3])];
    if (orientation(a, b, point) < 0) return false;
  }
  return true;
}

}  // namespace

Triangulation::Triangulation(const PolygonMap& map) {
  constexpr double kMargin = 1.0;
  const BoundingBox& bounds = map.boundingBox();
  box_ = {{bounds.min.x - kMargin, bounds.min.y - kMargin},
          {bounds.max.x + kMargin, bounds.max.y + kMargin}};
  std::tie(vertices_, faces_) = constrainedDelaunay(map, box_);
  buildBuckets();
}

void Triangulation::buildBuckets() {
  const double width = box_.width(), height = box_.height();
  const double buckets = std::max(1.0, static_cast<double>(faces_.size()) / kFacesPerBucket);
  bucket_size_ = std::max(std::sqrt(width * height / buckets), std::max(width, height) / 4096.0);
  bucket_columns_ = static_cast<int>(width / bucket_size_) + 1;
  bucket_rows_ = static_cast<int>(height / bucket_size_) + 1;
  buckets_.resize(static_cast<std::size_t>(bucket_columns_) *
                  static_cast<std::size_t>(bucket_rows_));
  int face = 0;  // row by row, back and forth: each walk starts next to the last one's end
  for (int row = 0; row < bucket_rows_; ++row) {
    for (int step = 0; step < bucket_columns_; ++step) {
      const int column = row % 2 == 0 ? step : bucket_columns_ - 1 - step;
      const TPoint2D center{std::min(box_.min.x + (column + 0.5) * bucket_size_, box_.max.x),
                            std::min(box_.min.y + (row + 0.5) * bucket_size_, box_.max.y)};
      face = walk(face, center);
      buckets_[static_cast<std::size_t>(row) * static_cast<std::size_t>(bucket_columns_) +
               static_cast<std::size_t>(column)] = face;
    }
  }
}

int Triangulation::walk(int face, const TPoint2D& point) const {
  // A straight visibility walk ends in a Delaunay triangulation, but may turn in circles in a
  // constrained one: after as many steps as there are faces, look at them all.
  for (std::size_t step = 0; step <= faces_.size(); ++step) {
    const Face& f = faces_[static_cast<std::size_t>(face)];
    int next = face;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + step) % 3;  // another first edge each step: rarely in circles
      const TPoint2D& a = vertices_[static_cast<std::size_t>(f.vertex[(i + 1) % 3])];
      const TPoint2D& b = vertices_[static_cast<std::size_t>(f.vertex[(i + 2) % 3])];
      if (f.neighbor[i] != kNone && orientation(a, b, point) < 0) {
        next = f.neighbor[i];
        break;
      }
    }
    if (next == face) return face;
    face = next;
  }
  const auto found = std::find_if(faces_.begin(), faces_.end(),
                                  [&](const Face& f) { return holds(*this, f, point); });
  return found == faces_.end() ? kNone : static_cast<int>(found - faces_.begin());
}

int Triangulation::locate(const TPoint2D& point) const {
  if (!box_.contains(point)) return kNone;
  const int column =
      std::min(static_cast<int>((point.x - box_.min.x) / bucket_size_), bucket_columns_ - 1);
  const int row =
      std::min(static_cast<int>((point.y - box_.min.y) / bucket_size_), bucket_rows_ - 1);
  return walk(buckets_[static_cast<std::size_t>(row) * static_cast<std::size_t>(bucket_columns_) +
                       static_cast<std::size_t>(column)],
              point);
}

bool Triangulation::isFree(const TPoint2D& point) const {
  const int face = locate(point);
  return face != kNone && faces_[static_cast<std::size_t>(face)].is_free;
}

bool Triangulation::isFreeOrBeside(const TPoint2D& point, double distance) const {
  const int first = locate(point);
  if (first == kNone) return false;
  std::vector<int> reached{first};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const Face& face = faces_[static_cast<std::size_t>(reached[i])];
    if (face.is_free) return true;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const int next = face.neighbor[edge];
      if (next == kNone || face.passage[edge] == Passage::wall) continue;
      const TPoint2D& a = vertices_[static_cast<std::size_t>(face.vertex[(edge + 1) % 3])];
      const TPoint2D& b = vertices_[static_cast<std::size_t>(face.vertex[(edge + 2) % 3])];
      if (distanceToSegment(point, a, b) > distance) continue;
      if (std::find(reached.begin(), reached.end(), next) == reached.end()) reached.push_back(next);
    }
  }
  return false;
}

std::size_t Triangulation::bytes() const {
  return vertices_.size() * sizeof(TPoint2D) + faces_.size() * sizeof(Face) +
         buckets_.size() * sizeof(std::int32_t);
}

}  // namespace mrpt_polyloc
