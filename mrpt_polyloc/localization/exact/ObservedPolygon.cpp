#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/localization/exact/ObservedPolygon.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// Whether the point seen in direction u in one piece lies within the limit of the other.
bool agreeAlong(const TPoint2D& u, const ObservedPolygon::Wall& a, const ObservedPolygon::Wall& b,
                double limit) {
  if (a.is_arc && b.is_arc) return std::abs(a.distance - b.distance) <= limit;
  if (b.is_arc) return agreeAlong(u, b, a, limit);
  const double cos_b = dot(b.normal, u);
  if (cos_b <= 0.0) return false;
  if (a.is_arc) return a.distance * cos_b - b.distance <= limit;
  const double cos_a = dot(a.normal, u);
  if (cos_a <= 0.0) return false;
  return std::abs(a.distance * cos_b - b.distance * cos_a) <= limit * std::min(cos_a, cos_b);
}

}  // namespace

bool ObservedPolygon::isWithin(double length, double limit) {
  if (length > 1e-2 * tolerance_ && length < 4.0 * limit) is_clear_ = false;
  return length <= limit;
}

/// Whether b lies between a and c, within the tolerance of their line.
bool ObservedPolygon::isBetween(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c) {
  const TPoint2D ac = c - a;
  return dot(b - a, c - b) > 0.0 &&
         isWithin(std::abs(cross(ac, b - a)) / ac.norm(), 2.0 * tolerance_);
}

std::vector<TPoint2D> ObservedPolygon::cleaned(const std::vector<TPoint2D>& vertices) {
  std::vector<TPoint2D> kept;
  for (const TPoint2D& v : vertices) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y)) {
      throw InvalidParamsError("vertex " + pointText(v) + " is not finite");
    }
    if (kept.empty() || !isWithin((v - kept.back()).norm(), tolerance_)) kept.push_back(v);
  }
  while (kept.size() > 1 && isWithin((kept.front() - kept.back()).norm(), tolerance_)) {
    kept.pop_back();
  }
  std::vector<TPoint2D> corners;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const TPoint2D& before = corners.empty() ? kept.back() : corners.back();
    if (!isBetween(before, kept[i], kept[(i + 1) % kept.size()])) corners.push_back(kept[i]);
  }
  if (corners.size() < 3) {
    throw InvalidParamsError("a polygon of " + std::to_string(corners.size()) +
                             " corners: three are needed");
  }
  return corners;
}

ObservedPolygon::ObservedPolygon(const std::vector<TPoint2D>& vertices, double tolerance)
    : tolerance_(tolerance) {
  const std::vector<TPoint2D> corners = cleaned(vertices);
  double turned = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const TPoint2D &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double area = cross(a, b), length = (b - a).norm();
    const double far = std::max(a.norm(), b.norm());
    radius_ = std::max(radius_, far);
    turned += std::atan2(area, dot(a, b));
    if (dot(a, b - a) <= 0.0 && dot(b, b - a) >= 0.0 && std::abs(area) <= tolerance * length) {
      throw InvalidParamsError("the origin lies on the edge " + pointText(a) + " to " +
                               pointText(b));
    }
    if (area < -2.0 * tolerance * far) {
      throw InvalidParamsError("not counterclockwise and star-shaped around the origin: edge " +
                               pointText(a) + " to " + pointText(b) + " is seen from behind");
    }
    if (isWithin(std::abs(area) / far, 2.0 * tolerance)) continue;  // a window
    const TPoint2D normal((b.y - a.y) / length, (a.x - b.x) / length);
    walls_.push_back({std::atan2(a.y, a.x), a, b, normal, area / length, false});
  }
  if (std::lround(turned / kTwoPi) != 1) {
    throw InvalidParamsError("the polygon winds " + std::to_string(std::lround(turned / kTwoPi)) +
                             " times around the origin, not once");
  }
  for (std::size_t i = 0; i < walls_.size(); ++i) {  // windows shorter than this count as corners
    const TPoint2D& before = walls_[(i + walls_.size() - 1) % walls_.size()].to;
    isWithin(std::abs(walls_[i].from.norm() - before.norm()), 4.0 * tolerance_);
  }
}

bool ObservedPolygon::beginsAtVertex(std::size_t wall) const {
  const TPoint2D& before = walls_[(wall + walls_.size() - 1) % walls_.size()].to;
  return walls_[wall].from.norm() < before.norm() + 4.0 * tolerance_;
}

bool ObservedPolygon::endsAtVertex(std::size_t wall) const {
  return walls_[wall].to.norm() < walls_[(wall + 1) % walls_.size()].from.norm() + 4.0 * tolerance_;
}

VisibilitySkeleton ObservedPolygon::skeleton() const {
  std::vector<VisibilitySkeleton::Gap> gaps;
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const Wall& before = walls_[(i + walls_.size() - 1) % walls_.size()];
    const bool begins = beginsAtVertex(i);
    gaps.push_back({begins ? walls_[i].from : before.to, walls_[i].from, walls_[i].to, begins,
                    endsAtVertex(i)});
  }
  return VisibilitySkeleton(std::move(gaps));
}

bool agree(const ObservedPolygon& a, const ObservedPolygon& b, double limit) {
  return agree(a.walls(), b.walls(), limit);
}

bool agree(const std::vector<ObservedPolygon::Wall>& a, const std::vector<ObservedPolygon::Wall>& b,
           double limit) {
  struct Start {
    double angle;
    const ObservedPolygon::Wall* a;
    const ObservedPolygon::Wall* b;
  };
  std::vector<Start> starts;
  for (const auto& wall : a) starts.push_back({wall.begin, &wall, nullptr});
  for (const auto& wall : b) starts.push_back({wall.begin, nullptr, &wall});
  if (a.empty() || b.empty()) return false;
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& x, const Start& y) { return x.angle < y.angle; });
  const ObservedPolygon::Wall *of_a = nullptr, *of_b = nullptr;
  for (const Start& start : starts) {  // what is seen before the first start: the last walls
    if (start.a != nullptr) of_a = start.a;
    if (start.b != nullptr) of_b = start.b;
  }
  double narrow = 0.0;  // width of neighbouring sectors that are too narrow to be compared
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (starts[i].a != nullptr) of_a = starts[i].a;
    if (starts[i].b != nullptr) of_b = starts[i].b;
    const double begin = starts[i].angle;
    const double end = i + 1 < starts.size() ? starts[i + 1].angle : starts[0].angle + kTwoPi;
    const double reach =
        std::min({of_a->from.norm(), of_a->to.norm(), of_b->from.norm(), of_b->to.norm()});
    const double margin = 2.0 * limit / reach;  // breakpoints of one view may lie so far apart
    if (end - begin <= 2.0 * margin) {
      narrow += (end - begin) * reach;
      if (narrow > 16.0 * limit) return false;
      continue;
    }
    narrow = 0.0;
    const auto agreeAt = [&](double angle) {
      return agreeAlong({std::cos(angle), std::sin(angle)}, *of_a, *of_b, limit);
    };
    if (!agreeAt(begin + margin) || !agreeAt(end - margin)) return false;
    if (of_a->is_arc == of_b->is_arc) continue;
    // A wall may dip into the circle between the ends: it is nearest along its normal.
    const TPoint2D& normal = of_a->is_arc ? of_b->normal : of_a->normal;
    const double nearest = begin + wrapToTwoPi(std::atan2(normal.y, normal.x) - begin);
    if (nearest > begin + margin && nearest < end - margin && !agreeAt(nearest)) return false;
  }
  return true;
}

}  // namespace mrpt_polyloc
