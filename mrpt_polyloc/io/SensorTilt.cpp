#include <mrpt_polyloc/io/SensorTilt.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_polyloc {

namespace {

constexpr double kLevel = 1e-9;                    // [rad]
constexpr double kGreatestTilt = 0.1745329251994;  // [rad] 10 degrees, see the header
constexpr double kNearestFloor = 3.0;              // [m]
constexpr double kFloorShare = 0.95;               // for a floor or a pose that is not quite so
constexpr double kLeastHeight = 0.02;              // [m]
constexpr double kAssumedHeight = 0.3;             // [m] of lasers on indoor robots, the lower ones
constexpr double kInfiniteRange = std::numeric_limits<double>::infinity();

}  // namespace

SensorTilt::SensorTilt(double yaw, double pitch, double roll, double height)
    : yaw_(yaw),
      height_(height > kLeastHeight ? height : kAssumedHeight),
      height_known_(height > kLeastHeight) {
  const double cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
  const double cr = std::cos(roll), sr = std::sin(roll);
  row_[0][0] = cy * cp, row_[0][1] = cy * sp * sr - sy * cr;
  row_[1][0] = sy * cp, row_[1][1] = sy * sp * sr + cy * cr;
  row_[2][0] = -sp, row_[2][1] = cp * sr;
  angle_ = std::asin(std::min(1.0, std::hypot(row_[2][0], row_[2][1])));
  upside_down_ = cp * cr < 0.0;
  level_ = angle_ < kLevel;
  if (level_ && cp < 0.0) yaw_ = std::atan2(row_[1][0], row_[0][0]);  // pitch pi turns it, too
}

SensorTilt::Projection SensorTilt::project(double bearing) const {
  if (level_) return {upside_down_ ? yaw_ - bearing : yaw_ + bearing, 1.0, kInfiniteRange};
  const double c = std::cos(bearing), s = std::sin(bearing);
  const double x = row_[0][0] * c + row_[0][1] * s, y = row_[1][0] * c + row_[1][1] * s;
  const double z = row_[2][0] * c + row_[2][1] * s;
  return {std::atan2(y, x), std::hypot(x, y), z < 0.0 ? height_ / -z : kInfiniteRange};
}

double SensorTilt::greatestReading(const Projection& beam) const {
  return height_known_ ? kFloorShare * beam.floor_range : kInfiniteRange;
}

bool SensorTilt::isRefused(double nearest_floor_range) const {
  return angle_ > kGreatestTilt || nearest_floor_range < kNearestFloor;
}

}  // namespace mrpt_polyloc
