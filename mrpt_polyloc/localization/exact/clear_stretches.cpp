#include <mrpt_polyloc/localization/exact/clear_stretches.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPoint2D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Coordinates along the base edge and to the left of it.
class Frame {
 public:
  explicit Frame(const BorderEdge& base) : origin_(base.from) {
    const TPoint2D d = base.to - base.from;
    along_ = d * (1.0 / d.norm());
  }
  TPoint2D operator()(const TPoint2D& p) const {
    const TPoint2D d = p - origin_;
    return {along_.x * d.x + along_.y * d.y, along_.x * d.y - along_.y * d.x};
  }

 private:
  TPoint2D origin_, along_;
};

/// Stretches that overlap or touch, joined.
std::vector<Stretch> joined(std::vector<Stretch> stretches, double tolerance) {
  std::sort(stretches.begin(), stretches.end());
  std::vector<Stretch> all;
  for (const Stretch& s : stretches) {
    if (!all.empty() && s.first <= all.back().second + tolerance) {
      all.back().second = std::max(all.back().second, s.second);
    } else {
      all.push_back(s);
    }
  }
  return all;
}

std::vector<Stretch> common(const std::vector<Stretch>& a, const std::vector<Stretch>& b) {
  std::vector<Stretch> both;
  for (const Stretch& s : a) {
    for (const Stretch& t : b) {
      const Stretch u(std::max(s.first, t.first), std::min(s.second, t.second));
      if (u.first <= u.second) both.push_back(u);
    }
  }
  return both;
}

/// Each stretch without the inside of `cut`.
std::vector<Stretch> without(const std::vector<Stretch>& stretches, const Stretch& cut) {
  std::vector<Stretch> rest;
  for (const Stretch& s : stretches) {
    if (cut.second <= s.first || cut.first >= s.second) {
      rest.push_back(s);
      continue;
    }
    if (s.first <= cut.first) rest.emplace_back(s.first, cut.first);
    if (cut.second <= s.second) rest.emplace_back(cut.second, s.second);
  }
  return rest;
}

/// The part of an edge with low <= y <= high; false if there is none.
bool clipToStrip(TPoint2D& a, TPoint2D& b, double low, double high) {
  if (std::max(a.y, b.y) <= low || std::min(a.y, b.y) >= high) return false;
  const auto cut = [](TPoint2D& p, const TPoint2D& q, double y) {
    p = {p.x + (q.x - p.x) * (y - p.y) / (q.y - p.y), y};
  };
  if (a.y < low) cut(a, b, low);
  if (b.y < low) cut(b, a, low);
  if (a.y > high) cut(a, b, high);
  if (b.y > high) cut(b, a, high);
  return true;
}

/// Where on the line y = 0 points are nearer than `radius` to an edge: what a disk and the two long
/// sides around the edge leave of it. Empty (first > second) if nowhere.
Stretch nearer(const TPoint2D& a, const TPoint2D& b, double radius) {
  Stretch stretch(kInfinity, -kInfinity);
  const auto take = [&stretch](double x) {
    stretch = {std::min(stretch.first, x), std::max(stretch.second, x)};
  };
  for (const TPoint2D& p : {a, b}) {
    if (std::abs(p.y) >= radius) continue;
    const double half = std::sqrt(radius * radius - p.y * p.y);
    take(p.x - half);
    take(p.x + half);
  }
  const TPoint2D d = b - a;
  const double length = d.norm();
  if (length <= 0.0) return stretch;
  const TPoint2D aside(-d.y * radius / length, d.x * radius / length);
  for (const double side : {-1.0, 1.0}) {
    const TPoint2D p = a + aside * side, q = b + aside * side;
    if ((p.y > 0.0) != (q.y > 0.0)) take(p.x + (q.x - p.x) * p.y / (p.y - q.y));
  }
  return stretch;
}

/// Where edges on the line y = height that run in direction `sign` cover a chord of half length
/// `half` around x.
std::vector<Stretch> covered(const std::vector<std::pair<TPoint2D, TPoint2D>>& edges, double height,
                             double sign, double half, double tolerance) {
  std::vector<Stretch> on_line;
  for (const auto& [a, b] : edges) {
    if (std::abs(a.y - height) > tolerance || std::abs(b.y - height) > tolerance) continue;
    if ((b.x - a.x) * sign > 0.0) on_line.emplace_back(std::min(a.x, b.x), std::max(a.x, b.x));
  }
  std::vector<Stretch> centers;
  for (const Stretch& s : joined(std::move(on_line), tolerance)) {
    const Stretch inside(s.first + half, s.second - half);
    if (inside.first <= inside.second) {
      centers.push_back(inside);
    } else if (inside.first <= inside.second + tolerance) {  // as long as the chord
      const double middle = 0.5 * (s.first + s.second);
      centers.emplace_back(middle, middle);
    }
  }
  return centers;
}

}  // namespace

std::vector<Stretch> clearStretches(const std::vector<BorderEdge>& edges, const BorderEdge& base,
                                    double distance, std::optional<double> opposite, double range,
                                    double tolerance) {
  const Frame frame(base);
  std::vector<std::pair<TPoint2D, TPoint2D>> framed;
  framed.reserve(edges.size());
  for (const BorderEdge& e : edges) framed.emplace_back(frame(e.from), frame(e.to));
  const auto halfChord = [&](double d) { return std::sqrt(std::max(range * range - d * d, 0.0)); };
  const double half = halfChord(distance);
  std::vector<Stretch> clear = covered(framed, 0.0, 1.0, half, tolerance);
  double high = kInfinity;
  if (opposite) {
    high = *opposite - tolerance;
    clear =
        common(clear, covered(framed, *opposite, -1.0, halfChord(*opposite - distance), tolerance));
  }
  // Chords that begin on the base; those on edges further on are found from there.
  const double length = frame(base.to).x;
  clear = common(clear, {{half, half + length}});
  for (auto [a, b] : framed) {
    if (!clipToStrip(a, b, tolerance, high)) continue;
    a.y -= distance;
    b.y -= distance;
    const Stretch cut = nearer(a, b, range - tolerance);
    if (cut.first < cut.second) clear = without(clear, cut);
  }
  return clear;
}

}  // namespace mrpt_polyloc
