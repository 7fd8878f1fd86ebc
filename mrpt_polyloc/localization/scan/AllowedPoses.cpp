#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/localization/scan/AllowedPoses.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kRounding = 1e-9;  // m, rad

}  // namespace

bool AllowedPoses::contains(const TPose2D& pose) const {
  if (prior_->compass &&
      angleBetween(pose.phi, prior_->compass->heading) > prior_->compass->tolerance + kRounding) {
    return false;
  }
  if (prior_->near) {
    const TPoint2D arm = turned(sensor_, pose.phi);
    const double away =
        std::hypot(pose.x - arm.x - prior_->near->x, pose.y - arm.y - prior_->near->y);
    if (away > prior_->near->radius + kRounding) return false;
  }
  return triangulation_->isFreeOrBeside({pose.x, pose.y}, beside_);
}

TPose2D AllowedPoses::nearest(const TPose2D& pose) const {
  TPose2D moved = pose;
  if (prior_->compass) {
    const double off = std::remainder(pose.phi - prior_->compass->heading, kTwoPi);
    const double tolerance = prior_->compass->tolerance;
    if (std::abs(off) > tolerance) moved.phi += std::clamp(off, -tolerance, tolerance) - off;
  }
  if (prior_->near) {
    const TPoint2D arm = turned(sensor_, moved.phi);
    const double dx = moved.x - arm.x - prior_->near->x, dy = moved.y - arm.y - prior_->near->y;
    const double away = std::hypot(dx, dy);
    if (away > prior_->near->radius) {
      const double share = prior_->near->radius / away - 1.0;
      moved.x += share * dx;
      moved.y += share * dy;
    }
  }
  return moved;
}

TPose2D AllowedPoses::lastOnTheWay(const TPose2D& from, const TPose2D& to) const {
  const double turn = std::remainder(to.phi - from.phi, kTwoPi);
  const auto at = [&](double share) {
    return TPose2D(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
                   from.phi + share * turn);
  };
  constexpr int kHalvings = 10;  // of at most some decimetres
  double allowed = 0.0, forbidden = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (allowed + forbidden);
    (contains(at(middle)) ? allowed : forbidden) = middle;
  }
  return at(allowed);
}

}  // namespace mrpt_polyloc
