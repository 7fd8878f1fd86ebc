#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/localization/exact/LimitedView.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace mrpt_polyloc {
namespace {

/// The shares of an edge between which it is within the range; false if nowhere.
bool clipped(const TPoint2D& a, const TPoint2D& b, double range, double& enters, double& leaves) {
  const TPoint2D d = b - a;
  const double square = dot(d, d), half = dot(a, d);
  const double root = half * half - square * (dot(a, a) - range * range);
  if (square <= 0.0 || root <= 0.0) return false;
  enters = std::max((-half - std::sqrt(root)) / square, 0.0);
  leaves = std::min((-half + std::sqrt(root)) / square, 1.0);
  return enters < leaves;
}

}  // namespace

LimitedView withinRange(const std::vector<TPoint2D>& polygon, double range) {
  LimitedView view;
  view.range = range;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const TPoint2D &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    double enters = 0.0, leaves = 1.0;
    if (!clipped(a, b, range, enters, leaves)) continue;
    view.vertices.push_back(a + (b - a) * enters);
    view.is_arc.push_back(false);
    if (leaves < 1.0) {  // to where the next edge enters
      view.vertices.push_back(a + (b - a) * leaves);
      view.is_arc.push_back(true);
    }
  }
  return view;
}

LimitedPolygon::LimitedPolygon(const LimitedView& view, double tolerance)
    : range_(view.range), tolerance_(tolerance) {
  requirePositive("range", range_);
  if (view.vertices.size() != view.is_arc.size()) {
    throw InvalidParamsError("a view of " + std::to_string(view.vertices.size()) +
                             " vertices and " + std::to_string(view.is_arc.size()) + " edges");
  }
  double turned = 0.0;
  for (std::size_t i = 0; i < view.vertices.size(); ++i) {
    const TPoint2D &a = view.vertices[i], &b = view.vertices[(i + 1) % view.vertices.size()];
    if (!std::isfinite(a.x) || !std::isfinite(a.y)) {
      throw InvalidParamsError("vertex " + pointText(a) + " is not finite");
    }
    if (a.norm() > range_ + 2.0 * tolerance) {
      throw InvalidParamsError("vertex " + pointText(a) + " is out of the range");
    }
    const double step = std::atan2(cross(a, b), dot(a, b));
    // Walls may meet on the circle, with an arc of no length between them.
    const bool is_long = view.vertices.size() == 1 || (b - a).norm() > tolerance;
    turned += view.is_arc[i] && is_long && step <= 0.0 ? step + kTwoPi : step;
    if (is_long) add(a, b, view.is_arc[i]);
  }
  if (pieces_.size() > 1 && continues(pieces_.back(), pieces_.front())) {
    pieces_.front().begin = pieces_.back().begin;
    pieces_.front().from = pieces_.back().from;
    pieces_.pop_back();
  }
  if (!view.vertices.empty() && std::lround(turned / kTwoPi) != 1) {
    throw InvalidParamsError("the view winds " + std::to_string(std::lround(turned / kTwoPi)) +
                             " times around the origin, not once");
  }
}

void LimitedPolygon::add(const TPoint2D& a, const TPoint2D& b, bool is_arc) {
  if (is_arc) {
    for (const TPoint2D& p : {a, b}) {
      if (p.norm() < range_ - 2.0 * tolerance_) {
        throw InvalidParamsError("the arc from " + pointText(a) + " to " + pointText(b) +
                                 " does not end at the range");
      }
    }
    pieces_.push_back({std::atan2(a.y, a.x), a, b, a * (1.0 / range_), range_, true});
    return;
  }
  const double area = cross(a, b), length = (b - a).norm();
  const double far = std::max(a.norm(), b.norm());
  if (area < -2.0 * tolerance_ * far) {
    throw InvalidParamsError("not counterclockwise and star-shaped around the origin: edge " +
                             pointText(a) + " to " + pointText(b) + " is seen from behind");
  }
  if (area <= 2.0 * tolerance_ * far) return;  // a window
  const TPoint2D normal((b.y - a.y) / length, (a.x - b.x) / length);
  const Piece piece{std::atan2(a.y, a.x), a, b, normal, area / length, false};
  if (!pieces_.empty() && continues(pieces_.back(), piece)) {
    pieces_.back().to = b;
  } else {
    pieces_.push_back(piece);
  }
}

/// Pieces of one wall may be given apart.
bool LimitedPolygon::continues(const Piece& piece, const Piece& next) const {
  return !piece.is_arc && !next.is_arc && (piece.to - next.from).norm() <= tolerance_ &&
         dot(piece.normal, next.normal) > 0.0 &&
         std::abs(dot(piece.normal, next.to) - piece.distance) <= 2.0 * tolerance_;
}

std::vector<LimitedPolygon::Piece> LimitedPolygon::walls() const {
  std::vector<Piece> walls;
  for (const Piece& piece : pieces_) {
    if (!piece.is_arc) walls.push_back(piece);
  }
  return walls;
}

bool LimitedPolygon::beginsAtVertex(std::size_t piece) const {
  const Piece& before = pieces_[(piece + pieces_.size() - 1) % pieces_.size()];
  const double slack = before.is_arc ? -4.0 * tolerance_ : 4.0 * tolerance_;
  return !pieces_[piece].is_arc && pieces_[piece].from.norm() < before.to.norm() + slack;
}

bool LimitedPolygon::endsAtVertex(std::size_t piece) const {
  const Piece& next = pieces_[(piece + 1) % pieces_.size()];
  const double slack = next.is_arc ? -4.0 * tolerance_ : 4.0 * tolerance_;
  return !pieces_[piece].is_arc && pieces_[piece].to.norm() < next.from.norm() + slack;
}

}  // namespace mrpt_polyloc
