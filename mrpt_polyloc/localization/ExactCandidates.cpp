#include <mrpt_polyloc/geometry/angles.h>
#include <mrpt_polyloc/geometry/errors.h>
#include <mrpt_polyloc/localization/ExactCandidates.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

Hypothesis toHypothesis(const TPose2D& pose, std::size_t count, double tolerance) {
  Hypothesis hypothesis;
  hypothesis.pose_map_robot = pose;
  hypothesis.covariance.setZero();
  for (int i = 0; i < 3; ++i) hypothesis.covariance(i, i) = tolerance * tolerance;
  hypothesis.weight = 1.0 / static_cast<double>(count);
  return hypothesis;
}

}  // namespace

WallAnchor longestAnchor(const SeenPolygon& seen) {
  WallAnchor anchor;
  for (std::size_t i = 0; i < seen.walls().size(); ++i) {
    const SeenPolygon::Wall& wall = seen.walls()[i];
    const double length = (wall.to - wall.from).norm();
    const bool at_begin = seen.beginsAtVertex(i);
    if (length <= anchor.length || !(at_begin || seen.endsAtVertex(i))) continue;
    anchor = {wall.from, wall.to, at_begin, length};
  }
  if (anchor.length == 0.0) throw InvalidParamsError("no vertex of the polygon can be the map's");
  return anchor;
}

ExactCandidates::ExactCandidates(const Triangulation& triangulation, const SeenPolygon& seen,
                                 const PosePrior& prior, double tolerance)
    : triangulation_(&triangulation),
      seen_(&seen),
      prior_(&prior),
      tolerance_(tolerance),
      anchor_(longestAnchor(seen)),
      // Both ends of the anchor may be off, which turns all that is seen about it.
      slack_(2.0 * tolerance / anchor_.length),
      limit_(2.0 * tolerance + 2.0 * slack_ * seen.radius()),
      expander_(triangulation, true) {}

bool ExactCandidates::isAllowed(const TPose2D& pose) const {
  if (prior_->compass &&
      angleBetween(pose.phi, prior_->compass->heading) > prior_->compass->tolerance + slack_) {
    return false;
  }
  return !prior_->near ||
         std::hypot(pose.x - prior_->near->x, pose.y - prior_->near->y) <= prior_->near->radius;
}

bool ExactCandidates::isKnown(const TPose2D& pose) const {
  return std::any_of(poses_.begin(), poses_.end(), [&](const TPose2D& known) {
    return std::hypot(pose.x - known.x, pose.y - known.y) <= 2.0 * limit_ &&
           angleBetween(pose.phi, known.phi) <= 2.0 * slack_;
  });
}

void ExactCandidates::consider(const TPose2D& pose) {
  const TPoint2D point(pose.x, pose.y);
  if (!isAllowed(pose) || !triangulation_->isFree(point) || isKnown(pose)) return;
  ++evaluated_;
  std::vector<TPoint2D> expected = visibilityPolygon(*triangulation_, expander_.expand(point));
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  for (TPoint2D& vertex : expected) {
    const TPoint2D d = vertex - point;
    vertex = {c * d.x + s * d.y, c * d.y - s * d.x};
  }
  try {
    if (!agree(*seen_, SeenPolygon(expected, tolerance_), limit_)) return;
  } catch (const InvalidParamsError&) {
    return;  // on a wall: what is seen from there does not surround the robot
  }
  poses_.push_back(pose);
}

LocalizationResult ExactCandidates::result(std::size_t max_hypotheses) {
  std::sort(poses_.begin(), poses_.end(), [](const TPose2D& a, const TPose2D& b) {
    return std::tie(a.x, a.y, a.phi) < std::tie(b.x, b.y, b.phi);
  });
  LocalizationResult result;
  result.statistics.evaluated = evaluated_;
  result.match_probability = poses_.empty() ? 0.0 : 1.0;  // without noise nothing is left to chance
  result.status = poses_.empty()       ? LocalizationStatus::no_match
                  : poses_.size() == 1 ? LocalizationStatus::unique
                                       : LocalizationStatus::ambiguous;
  const std::size_t count = std::min(poses_.size(), max_hypotheses);
  for (std::size_t i = 0; i < count; ++i) {
    result.hypotheses.push_back(toHypothesis(poses_[i], count, tolerance_));
  }
  return result;
}

}  // namespace mrpt_polyloc
