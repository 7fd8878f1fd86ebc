#include <mrpt_polyloc/geometry/angles.h>
#include <mrpt_polyloc/geometry/params_check.h>
#include <mrpt_polyloc/localization/ExactLocalizer.h>
#include <mrpt_polyloc/localization/SeenPolygon.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

double angleOf(const TPoint2D& from, const TPoint2D& to) {
  return std::atan2(to.y - from.y, to.x - from.x);
}

TPoint2D turned(const TPoint2D& p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

/// A wall of the view, of which an end is a vertex of the map.
struct Anchor {
  TPoint2D from, to;
  bool at_begin = false;
  double length = 0.0;
};

Anchor longestAnchor(const SeenPolygon& seen) {
  Anchor anchor;
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

bool isAllowed(const PosePrior& prior, const TPose2D& pose, double slack) {
  if (prior.compass &&
      angleBetween(pose.phi, prior.compass->heading) > prior.compass->tolerance + slack) {
    return false;
  }
  return !prior.near ||
         std::hypot(pose.x - prior.near->x, pose.y - prior.near->y) <= prior.near->radius;
}

Hypothesis toHypothesis(const TPose2D& pose, std::size_t count, double tolerance) {
  Hypothesis hypothesis;
  hypothesis.pose_map_robot = pose;
  hypothesis.covariance.setZero();
  for (int i = 0; i < 3; ++i) hypothesis.covariance(i, i) = tolerance * tolerance;
  hypothesis.weight = 1.0 / static_cast<double>(count);
  return hypothesis;
}

}  // namespace

void ExactLocalizerParams::check() const {
  requireInRange("tolerance", tolerance, 1e-8, 1e-2);
  requireInRange("max_hypotheses", static_cast<double>(max_hypotheses), 1.0, 1e6);
}

ExactLocalizer::ExactLocalizer(const PolygonMap& map, ExactLocalizerParams params)
    : params_(params), triangulation_(map) {
  params_.check();
  const auto& vertices = triangulation_.vertices();
  for (const Triangulation::Face& face : triangulation_.faces()) {
    for (std::size_t i = 0; face.is_free && i < 3; ++i) {
      if (face.passage[i] == Passage::clear) continue;
      borders_.push_back({vertices[static_cast<std::size_t>(face.vertex[(i + 1) % 3])],
                          vertices[static_cast<std::size_t>(face.vertex[(i + 2) % 3])]});
    }
  }
}

std::size_t ExactLocalizer::bytes() const {
  return borders_.size() * sizeof(Border) +
         triangulation_.faces().size() * sizeof(Triangulation::Face) +
         triangulation_.vertices().size() * sizeof(TPoint2D);
}

LocalizationResult ExactLocalizer::localize(const std::vector<TPoint2D>& view,
                                            const PosePrior& prior) const {
  prior.check();
  const SeenPolygon seen(view, params_.tolerance);
  const Anchor anchor = longestAnchor(seen);
  const TPoint2D& anchor_point = anchor.at_begin ? anchor.from : anchor.to;
  // Both ends of the anchor may be off, which turns all that is seen about it.
  const double slack = 2.0 * params_.tolerance / anchor.length;
  const double limit = 2.0 * params_.tolerance + 2.0 * slack * seen.radius();

  ViewExpander expander(triangulation_, true);
  LocalizationResult result;
  std::vector<TPose2D> poses;
  for (const Border& border : borders_) {
    TPose2D pose(0, 0, angleOf(border.from, border.to) - angleOf(anchor.from, anchor.to));
    pose.phi = std::remainder(pose.phi, kTwoPi);
    const TPoint2D point =
        (anchor.at_begin ? border.from : border.to) - turned(anchor_point, pose.phi);
    pose.x = point.x;
    pose.y = point.y;
    if (!isAllowed(prior, pose, slack) || !triangulation_.isFree(point)) continue;
    ++result.statistics.evaluated;
    std::vector<TPoint2D> expected = visibilityPolygon(triangulation_, expander.expand(point));
    for (TPoint2D& vertex : expected) vertex = turned(vertex - point, -pose.phi);
    try {
      if (!agree(seen, SeenPolygon(expected, params_.tolerance), limit)) continue;
    } catch (const InvalidParamsError&) {
      continue;  // on a wall: what is seen from there does not surround the robot
    }
    poses.push_back(pose);
  }
  std::sort(poses.begin(), poses.end(), [](const TPose2D& a, const TPose2D& b) {
    return std::tie(a.x, a.y, a.phi) < std::tie(b.x, b.y, b.phi);
  });
  result.match_probability = poses.empty() ? 0.0 : 1.0;  // without noise nothing is left to chance
  result.status = poses.empty()       ? LocalizationStatus::no_match
                  : poses.size() == 1 ? LocalizationStatus::unique
                                      : LocalizationStatus::ambiguous;
  if (poses.size() > params_.max_hypotheses) poses.resize(params_.max_hypotheses);
  for (const TPose2D& pose : poses) {
    result.hypotheses.push_back(toHypothesis(pose, poses.size(), params_.tolerance));
  }
  return result;
}

}  // namespace mrpt_polyloc
