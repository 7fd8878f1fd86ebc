#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// How far the places of a map are from the border of free space, up to a limit: a table over a
/// grid, looked up in constant time. Walls and open edges bound alike: a robot is not sent into
/// what the map does not know. Immutable and thread-safe.
class POLYLOC_EXPORT ClearanceField {
 public:
  /// Side of the grid's squares [m]; coarser for maps that would have more than kMostSquares.
  static constexpr double kSquare = 0.05;
  static constexpr std::size_t kMostSquares = 40'000'000;

  /// \param limit distances beyond count as this [m]; time grows with its square
  /// \throws InvalidParamsError unless the limit is positive
  ClearanceField(const PolygonMap& map, double limit);

  /// Distance [m] of the centre of the square that holds a point to the border, at most the limit;
  /// 0 where that centre is not in free space, and for a point that is not finite.
  double at(const TPoint2D& point) const {
    // Also false for NaN.
    if (!(point.x >= origin_.x && point.y >= origin_.y)) return 0.0;
    const double column = (point.x - origin_.x) / square_, row = (point.y - origin_.y) / square_;
    if (column >= static_cast<double>(columns_) || row >= static_cast<double>(rows_)) return 0.0;
    return static_cast<double>(
        distances_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)]);
  }

  double limit() const { return limit_; }
  double square() const { return square_; }  ///< [m]

 private:
  TPoint2D centre(std::size_t column, std::size_t row) const {
    return {origin_.x + (static_cast<double>(column) + 0.5) * square_,
            origin_.y + (static_cast<double>(row) + 0.5) * square_};
  }
  void markFree(const PolygonMap& map);
  void lower(const TPoint2D& a, const TPoint2D& b);

  double limit_;
  double square_ = kSquare;
  TPoint2D origin_{0, 0};
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<float> distances_;
};

}  // namespace mrpt_polyloc
