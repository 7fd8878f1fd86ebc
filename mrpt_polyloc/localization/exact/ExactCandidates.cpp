#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/exact/ExactCandidates.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

}  // namespace

WallAnchor longestAnchor(const ObservedPolygon& seen) {
  WallAnchor anchor;
  for (std::size_t i = 0; i < seen.walls().size(); ++i) {
    const ObservedPolygon::Wall& wall = seen.walls()[i];
    const double length = (wall.to - wall.from).norm();
    const bool at_begin = seen.beginsAtVertex(i);
    if (length <= anchor.length || !(at_begin || seen.endsAtVertex(i))) continue;
    anchor = {wall.from, wall.to, at_begin, length};
  }
  if (anchor.length == 0.0) throw InvalidParamsError("no vertex of the polygon can be the map's");
  return anchor;
}

ExactCandidates::ExactCandidates(const Triangulation& triangulation, const ObservedPolygon& seen,
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
    if (!agree(*seen_, ObservedPolygon(expected, tolerance_), limit_)) return;
  } catch (const InvalidParamsError&) {
    return;  // on a wall: what is seen from there does not surround the robot
  }
  poses_.push_back(pose);
}

ExactAnswers ExactCandidates::answers() const {
  ExactAnswers answers{poses_, 0, evaluated_};
  std::sort(answers.poses.begin(), answers.poses.end(), [](const TPose2D& a, const TPose2D& b) {
    return std::tie(a.x, a.y, a.phi) < std::tie(b.x, b.y, b.phi);
  });
  return answers;
}

}  // namespace mrpt_polyloc
