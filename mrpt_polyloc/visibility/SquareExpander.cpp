#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/visibility/SquareExpander.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace mrpt_polyloc {
namespace {

/// A cone that keeps growing is opened to the whole edge: bounds the work.
constexpr std::int32_t kMostWidenings = 6;

/// Of the queue: finer ones save no following any more.
constexpr float kStepsPerMetre = 16.0F;
constexpr float kMostSteps = 16384.0F;

constexpr double kSqrt2 = 1.4142135623730951;
constexpr float kFar = std::numeric_limits<float>::infinity();

/// The 1-norm of b - a.
double extent(const TPoint2D& a, const TPoint2D& b) {
  return std::abs(b.x - a.x) + std::abs(b.y - a.y);
}

}  // namespace

SquareExpander::SquareExpander(const Triangulation& t, double horizon)
    : t_(&t), horizon_(horizon), origin_(t.vertices().front()), passed_(3 * t.faces().size()) {
  nodes_.reserve(t.faces().size());
  for (std::size_t face = 0; face < t.faces().size(); ++face) {
    const Triangulation::Face& f = t.faces()[face];
    Node node{f.vertex, {}, 0, 0, 0, f.is_free};
    for (std::size_t i = 0; i < 3; ++i) {
      node.across[i] = acrossOf(t, face, i);
    }
    const TPoint2D a = t.vertices()[static_cast<std::size_t>(f.vertex[0])];
    const TPoint2D b = t.vertices()[static_cast<std::size_t>(f.vertex[1])] - a;
    const TPoint2D c = t.vertices()[static_cast<std::size_t>(f.vertex[2])] - a;
    const double bb = b.x * b.x + b.y * b.y, cc = c.x * c.x + c.y * c.y;
    const double twice = 2.0 * std::max(cross(b, c), 1e-12);
    const TPoint2D m{(c.y * bb - b.y * cc) / twice, (b.x * cc - c.x * bb) / twice};
    node.x = static_cast<float>(a.x + m.x - origin_.x);
    node.y = static_cast<float>(a.y + m.y - origin_.y);
    node.squared_radius = static_cast<float>(m.x * m.x + m.y * m.y);
    nodes_.push_back(node);
  }
}

std::int32_t SquareExpander::acrossOf(const Triangulation& t, std::size_t face, std::size_t i) {
  if (t.faces()[face].passage[i] == Passage::wall) return kEnd;
  const std::int32_t next = t.faces()[face].neighbor[i];
  if (next == Triangulation::kNone) return kRim;
  const auto& neighbors = t.faces()[static_cast<std::size_t>(next)].neighbor;
  const auto back = std::find(neighbors.begin(), neighbors.end(), static_cast<std::int32_t>(face));
  return 3 * next + static_cast<std::int32_t>(back - neighbors.begin());
}

void SquareExpander::expand(const Square& square, const std::vector<std::int32_t>& faces,
                            std::vector<HalfEdge>& walls, std::vector<HalfEdge>& open) {
  square_ = square;
  center_x_ = static_cast<float>(square.center.x - origin_.x);
  center_y_ = static_cast<float>(square.center.y - origin_.y);
  walls_ = &walls;
  open_ = &open;
  const auto outside = static_cast<float>(kHorizonOutside + square.half * kSqrt2);
  for (const std::int32_t face : faces) {
    const Node& node = nodes_[static_cast<std::size_t>(face)];
    const Reach from_here = node.is_free ? Reach{kFar, false} : Reach{outside, true};
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::int32_t right = node.vertex[(i + 1) % 3], left = node.vertex[(i + 2) % 3];
      reach(3 * static_cast<HalfEdge>(face) + i, {{right, right}, {left, left}}, from_here);
    }
  }
  for (nearest_waiting_ = 0; nearest_waiting_ < queue_.size();) {
    std::vector<HalfEdge>& step = queue_[nearest_waiting_];
    if (step.empty()) {
      ++nearest_waiting_;
      continue;
    }
    const HalfEdge edge = step.back();
    step.pop_back();
    passed_[edge].is_waiting = false;
    follow(edge);
  }
  for (const HalfEdge edge : touched_) passed_[edge].count = 0;
  touched_.clear();
}

/// Whether x is inside all limits of one side, each from some point of the square.
bool SquareExpander::isSeenPast(const Limits& limits, const TPoint2D& x, Side side) const {
  const auto is_inside = [&](std::int32_t limit) {
    const TPoint2D l = at(limit);
    const double turn = side == Side::right ? cross(l, x) : -cross(l, x);
    return turn > -square_.half * extent(l, x);
  };
  return is_inside(limits[0]) && (limits[1] == limits[0] || is_inside(limits[1]));
}

/// Whether x is inside a limit, or on it, from every point of the square: x as a limit is tighter.
bool SquareExpander::isWider(std::int32_t limit, const TPoint2D& x, Side side) const {
  const TPoint2D l = at(limit);
  const double turn = side == Side::right ? cross(l, x) : -cross(l, x);
  return turn >= square_.half * extent(l, x);
}

/// The limits of what is seen past the apex: it takes the place of limits that are wider. If two
/// limits besides it would remain, the older one goes, which can only add to what is seen.
SquareExpander::Limits SquareExpander::tightened(const Limits& limits, std::int32_t apex,
                                                 Side side) const {
  const TPoint2D a = at(apex);
  if (!isWider(limits[1], a, side)) return {limits[1], apex};
  if (limits[0] != limits[1] && !isWider(limits[0], a, side)) return {limits[0], apex};
  return {apex, apex};
}

/// Limits that hold for two cones: those of either that are wider than some of the other; where
/// there is none, the end of the edge.
SquareExpander::Limits SquareExpander::joined(const Limits& a, const Limits& b, std::int32_t end,
                                              Side side) const {
  Limits result{end, end};
  int count = 0;
  const auto take = [&](std::int32_t limit, const Limits& others) {
    const bool holds = isWider(limit, at(others[0]), side) || isWider(limit, at(others[1]), side);
    if (!holds || (count > 0 && result[0] == limit) || count == 2) return;
    if (count == 0) result = {limit, limit};
    result[1] = limit;
    ++count;
  };
  for (const std::int32_t limit : a) take(limit, b);
  for (const std::int32_t limit : b) take(limit, a);
  return result;
}

/// The least distance of a segment from the centre, rounded down.
float SquareExpander::nearest(const TPoint2D& a, const TPoint2D& b) const {
  return static_cast<float>(distanceToSegment({0, 0}, a, b) * (1.0 - 1e-6) - 1e-6);
}

/// Not less than the distance of any of its points from any of the square.
float SquareExpander::farthest(const TPoint2D& a, const TPoint2D& b) const {
  const double from_center = std::max(std::hypot(a.x, a.y), std::hypot(b.x, b.y));
  return static_cast<float>((from_center + kSqrt2 * square_.half) * (1.0 + 1e-6) + 1e-6);
}

/// How far rays see that have passed an edge.
SquareExpander::Reach SquareExpander::past(HalfEdge edge, const Reach& reach) const {
  const Node& near = nodes_[edge / 3];
  const Node& far = nodes_[static_cast<std::size_t>(near.across[edge % 3]) / 3];
  if (near.is_free == far.is_free) return reach;
  if (far.is_free) return reach.is_from_outside ? Reach{kFar, false} : reach;
  if (reach.horizon < kFar) return reach;  // has left free space before
  const std::int32_t right = near.vertex[(edge % 3 + 1) % 3],
                     left = near.vertex[(edge % 3 + 2) % 3];
  const double behind = horizon_ + kSqrt2 * square_.half;  // of a point's ray, from the centre
  return {farthest(at(right), at(left)) + static_cast<float>(behind), false};
}

void SquareExpander::reach(HalfEdge edge, const Cone& cone, Reach reach) {
  const Node& near = nodes_[edge / 3];
  const std::uint32_t i = edge % 3;
  const std::int32_t right = near.vertex[(i + 1) % 3], left = near.vertex[(i + 2) % 3];
  Passed& passed = passed_[edge];
  if (passed.count > 0 && near.across[i] < 0) return;  // an end, listed
  const TPoint2D r = at(right), l = at(left);
  if (reach.horizon < kFar && nearest(r, l) > reach.horizon) return;
  if (passed.count == 0) {
    // No point of the square on the near side: no ray leaves the face here.
    if (cross(r, l) <= -square_.half * extent(r, l)) return;
    touched_.push_back(edge);
    passed.count = 1;
    passed.reach = reach;
    passed.cone = cone;
    if (near.across[i] == kEnd) walls_->push_back(edge);
    if (near.across[i] >= 0) wait(edge, near.across[i]);
    return;
  }
  const Reach wide_reach{std::max(passed.reach.horizon, reach.horizon),
                         passed.reach.is_from_outside || reach.is_from_outside};
  const bool sees_farther = wide_reach.horizon > passed.reach.horizon ||
                            wide_reach.is_from_outside != passed.reach.is_from_outside;
  const bool is_open_whole = passed.count > kMostWidenings;
  Cone wide = passed.cone;
  if (!is_open_whole) {
    wide = {joined(passed.cone.right, cone.right, right, Side::right),
            joined(passed.cone.left, cone.left, left, Side::left)};
  }
  const bool is_wider = wide.right != passed.cone.right || wide.left != passed.cone.left;
  if (!is_wider && !sees_farther) return;
  if (!is_open_whole && ++passed.count > kMostWidenings) wide = {{right, right}, {left, left}};
  passed.cone = wide;
  passed.reach = wide_reach;
  if (!passed.is_waiting) wait(edge, near.across[i]);
}

void SquareExpander::wait(HalfEdge edge, std::int32_t across) {
  const Node& node = nodes_[static_cast<std::size_t>(across) / 3];
  const float x = node.x - center_x_, y = node.y - center_y_;
  // 0 first: what is no number, of a triangle without area, counts as near.
  const float distance = std::sqrt(std::max(0.0F, x * x + y * y - node.squared_radius));
  const auto step = static_cast<std::size_t>(std::min(distance * kStepsPerMetre, kMostSteps));
  if (step >= queue_.size()) queue_.resize(step + 1);
  queue_[step].push_back(edge);
  nearest_waiting_ = std::min(nearest_waiting_, step);
  passed_[edge].is_waiting = true;
}

void SquareExpander::follow(HalfEdge edge) {
  const Cone cone = passed_[edge].cone;
  const Reach before = passed_[edge].reach, reach_past = past(edge, before);
  if (before.horizon == kFar && reach_past.horizon < kFar) open_->push_back(edge);
  const auto across = static_cast<HalfEdge>(nodes_[edge / 3].across[edge % 3]);
  const HalfEdge entered = across % 3, base = across - entered;
  const std::int32_t apex = nodes_[across / 3].vertex[entered];
  const TPoint2D a = at(apex);
  const bool sees_right = isSeenPast(cone.right, a, Side::right);
  const bool sees_left = isSeenPast(cone.left, a, Side::left);
  if (sees_left) {
    reach(base + (entered + 2) % 3,
          {sees_right ? tightened(cone.right, apex, Side::right) : cone.right, cone.left},
          reach_past);
  }
  if (sees_right) {
    reach(base + (entered + 1) % 3,
          {cone.right, sees_left ? tightened(cone.left, apex, Side::left) : cone.left}, reach_past);
  }
}

}  // namespace mrpt_polyloc
