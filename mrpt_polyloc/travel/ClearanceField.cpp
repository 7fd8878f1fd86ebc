#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/travel/ClearanceField.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {

ClearanceField::ClearanceField(const PolygonMap& map, double limit) : limit_(limit) {
  requirePositive("limit", limit);
  const BoundingBox& box = map.boundingBox();
  const double width = box.max.x - box.min.x, height = box.max.y - box.min.y;
  square_ = std::max(square_, std::sqrt(width * height / static_cast<double>(kMostSquares)));
  origin_ = box.min;
  columns_ = static_cast<std::size_t>(width / square_) + 1;
  rows_ = static_cast<std::size_t>(height / square_) + 1;
  distances_.assign(columns_ * rows_, 0.0F);
  markFree(map);
  for (const Ring* ring : map.rings()) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      lower(ring->vertices[i], ring->vertices[(i + 1) % ring->size()]);
    }
  }
}

/// Row by row between the crossings of the border: rings of one map are nested, or apart.
void ClearanceField::markFree(const PolygonMap& map) {
  std::vector<std::vector<double>> crossings(rows_);
  for (const Ring* ring : map.rings()) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      const TPoint2D& a = ring->vertices[i];
      const TPoint2D& b = ring->vertices[(i + 1) % ring->size()];
      const double low = std::min(a.y, b.y), high = std::max(a.y, b.y);
      const double first = std::max(0.0, std::floor((low - origin_.y) / square_ - 1.0));
      for (auto row = static_cast<std::size_t>(first); row < rows_; ++row) {
        const double y = centre(0, row).y;
        if (y < low) continue;
        if (y >= high) break;
        crossings[row].push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
      }
    }
  }
  for (std::size_t row = 0; row < rows_; ++row) {
    std::vector<double>& at = crossings[row];
    std::sort(at.begin(), at.end());
    for (std::size_t k = 0; k + 1 < at.size(); k += 2) {
      const double first = std::max(0.0, std::ceil((at[k] - origin_.x) / square_ - 0.5));
      for (auto column = static_cast<std::size_t>(first);
           column < columns_ && centre(column, row).x < at[k + 1]; ++column) {
        distances_[row * columns_ + column] = static_cast<float>(limit_);
      }
    }
  }
}

/// Takes in one edge of the border: only squares within the limit of it can change.
void ClearanceField::lower(const TPoint2D& a, const TPoint2D& b) {
  const auto index = [&](double value, double from, std::size_t count) {
    const double at = std::floor((value - from) / square_);
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count - 1)));
  };
  const std::size_t column0 = index(std::min(a.x, b.x) - limit_, origin_.x, columns_);
  const std::size_t column1 = index(std::max(a.x, b.x) + limit_, origin_.x, columns_);
  const std::size_t row0 = index(std::min(a.y, b.y) - limit_, origin_.y, rows_);
  const std::size_t row1 = index(std::max(a.y, b.y) + limit_, origin_.y, rows_);
  const TPoint2D along = b - a;
  const double length = along.norm();
  for (std::size_t row = row0; row <= row1; ++row) {
    // Of a long slanting edge only the stretch of the row near its line.
    std::size_t first = column0, last = column1;
    if (std::abs(along.y) > 1e-12) {
      const double y = centre(0, row).y;
      const double reach = limit_ * length / std::abs(along.y) + square_;
      const double x = a.x + along.x * (y - a.y) / along.y;
      first = std::max(first, index(x - reach, origin_.x, columns_));
      last = std::min(last, index(x + reach, origin_.x, columns_));
    }
    for (std::size_t column = first; column <= last; ++column) {
      float& distance = distances_[row * columns_ + column];
      if (distance <= 0.0F) continue;
      distance =
          std::min(distance, static_cast<float>(distanceToSegment(centre(column, row), a, b)));
    }
  }
}

}  // namespace mrpt_polyloc
