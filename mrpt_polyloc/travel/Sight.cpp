#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/travel/Sight.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// Neighbours farther apart than this have something unseen between them: twice the spacing of the
/// coarsest lasers in use, of one degree, with a beam missing.
constexpr double kWidestGap = 3.5 * kDegree;

/// Nothing stands where the robot does, this share of its own radius around.
constexpr double kWithinRobot = 0.8;

}  // namespace

Sight::Sight(const std::vector<PlacedScan>& scans, double own_radius) {
  std::size_t hits_of_newest = 0;
  for (const PlacedScan& placed : scans) {
    const RangeScan& scan = placed.scan;
    Rays rays{scan.beamFrameFromRobot(placed.pose), {}, {}};
    const double own = std::max(0.0, own_radius - scan.sensor().norm());
    std::vector<std::pair<double, double>> sorted;
    for (const Beam& beam : scan.beams()) {
      if (beam.kind == BeamKind::invalid) continue;
      sorted.emplace_back(std::remainder(beam.bearing, kTwoPi), std::max(beam.range, own));
      if (beam.kind != BeamKind::hit) continue;
      const double direction = rays.pose.phi + beam.bearing;
      hits_.emplace_back(rays.pose.x + beam.range * std::cos(direction),
                         rays.pose.y + beam.range * std::sin(direction));
    }
    std::sort(sorted.begin(), sorted.end());
    const std::size_t count = sorted.size();
    for (std::size_t i = 0; i < count; ++i) {
      rays.bearings.push_back(sorted[i].first);
      rays.ranges.push_back(sorted[i].second);
      const double next = i + 1 < count ? sorted[i + 1].first : sorted[0].first + kTwoPi;
      if (next - sorted[i].first <= kWidestGap) continue;
      // Blind rays, close enough that no disc passes between them.
      const auto blind = static_cast<int>((next - sorted[i].first) / kDegree);
      for (int k = 1; k < blind; ++k) {
        rays.bearings.push_back(sorted[i].first + (next - sorted[i].first) * k / blind);
        rays.ranges.push_back(own);
      }
    }
    if (count == 0) continue;
    // Those behind the last beam may have passed pi.
    std::vector<std::pair<double, double>> all;
    for (std::size_t i = 0; i < rays.bearings.size(); ++i) {
      all.emplace_back(std::remainder(rays.bearings[i], kTwoPi), rays.ranges[i]);
    }
    std::sort(all.begin(), all.end());
    for (std::size_t i = 0; i < all.size(); ++i) {
      rays.bearings[i] = all[i].first;
      rays.ranges[i] = all[i].second;
    }
    rays_.push_back(std::move(rays));
    if (&placed == &scans.front()) hits_of_newest = hits_.size();
  }
  if (rays_.empty() || hits_of_newest == 0) return;
  const auto older = hits_.begin() + static_cast<std::ptrdiff_t>(hits_of_newest);
  hits_.erase(std::remove_if(older, hits_.end(),
                             [&](const TPoint2D& hit) {
                               const TPose2D& robot = scans.front().pose;
                               const double away = std::hypot(hit.x - robot.x, hit.y - robot.y);
                               return away < kWithinRobot * own_radius ||
                                      seesThrough(rays_[0], hit);
                             }),
              hits_.end());
}

/// Whether rays close together pass a hit of another scan on all sides.
bool Sight::seesThrough(const Rays& rays, const TPoint2D& hit) {
  constexpr double kBeside = 0.08;        // [m]
  constexpr std::ptrdiff_t kFewRays = 3;  // fewer might miss the leg of a table
  const double dx = hit.x - rays.pose.x, dy = hit.y - rays.pose.y;
  const double distance = std::hypot(dx, dy);
  if (distance <= kBeside) return false;
  const double direction = std::remainder(std::atan2(dy, dx) - rays.pose.phi, kTwoPi);
  const double half = std::asin(kBeside / distance);
  std::ptrdiff_t beside = 0;
  for (const double turn : {-kTwoPi, 0.0, kTwoPi}) {  // bearings end at pi
    const auto first =
        std::lower_bound(rays.bearings.begin(), rays.bearings.end(), direction + turn - half);
    beside += std::upper_bound(first, rays.bearings.end(), direction + turn + half) - first;
  }
  return beside >= kFewRays && sees(rays, hit, kBeside);
}

bool Sight::seesDisc(const TPoint2D& centre, double radius) const {
  return std::any_of(rays_.begin(), rays_.end(),
                     [&](const Rays& rays) { return sees(rays, centre, radius); });
}

/// The seen region is star-shaped around the sensor: a disc lies in it if no ray ends before it
/// leaves the disc.
bool Sight::sees(const Rays& rays, const TPoint2D& centre, double radius) {
  const double dx = centre.x - rays.pose.x, dy = centre.y - rays.pose.y;
  const double distance = std::hypot(dx, dy);
  const double direction = std::remainder(std::atan2(dy, dx) - rays.pose.phi, kTwoPi);
  const double half = distance > radius ? std::asin(radius / distance) : kPi;
  const auto count = static_cast<std::ptrdiff_t>(rays.bearings.size());
  const auto isFree = [&](std::ptrdiff_t at) {
    const auto i = static_cast<std::size_t>((at % count + count) % count);
    const double off = std::remainder(rays.bearings[i] - direction, kTwoPi);
    // A ray just beside the disc stands for the gap up to it.
    const double across = std::min(distance * std::abs(std::sin(off)), radius);
    const double exit = distance * std::cos(off) + std::sqrt(radius * radius - across * across);
    return rays.ranges[i] >= exit;
  };
  if (half >= kPi) {
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      if (!isFree(i)) return false;
    }
    return true;
  }
  const auto first = std::lower_bound(rays.bearings.begin(), rays.bearings.end(), direction) -
                     rays.bearings.begin();
  // From the middle outwards to either side, one ray beyond the disc included.
  for (const std::ptrdiff_t step : {std::ptrdiff_t{-1}, std::ptrdiff_t{1}}) {
    std::ptrdiff_t at = step > 0 ? first : first - 1;
    for (std::ptrdiff_t k = 0; k < count; ++k, at += step) {
      if (!isFree(at)) return false;
      const auto i = static_cast<std::size_t>((at % count + count) % count);
      if (angleBetween(rays.bearings[i], direction) >= half) break;
    }
  }
  return true;
}

}  // namespace mrpt_polyloc
