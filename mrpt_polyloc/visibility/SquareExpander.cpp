#include <mrpt_polyloc/visibility/SquareExpander.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mrpt_polyloc {
namespace {

double cross(const TPoint2D& a, const TPoint2D& b) {
  return a.x * b.y - a.y * b.x;
}

/// The 1-norm of b - a.
double extent(const TPoint2D& a, const TPoint2D& b) {
  return std::abs(b.x - a.x) + std::abs(b.y - a.y);
}

}  // namespace

void SquareExpander::expand(const Square& square, const std::vector<std::int32_t>& faces,
                            std::vector<HalfEdge>& walls, std::vector<HalfEdge>& open) {
  square_ = square;
  walls_ = &walls;
  open_ = &open;
  for (const std::int32_t face : faces) {
    const Triangulation::Face& f = t_->faces()[static_cast<std::size_t>(face)];
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::int32_t right = f.vertex[(i + 1) % 3], left = f.vertex[(i + 2) % 3];
      push({3 * static_cast<HalfEdge>(face) + i, {right, right}, {left, left}});
    }
  }
  while (!stack_.empty()) {
    const Gap gap = stack_.back();
    stack_.pop_back();
    follow(gap);
  }
  for (const HalfEdge edge : touched_) visits_[edge].count = 0;
  touched_.clear();
}

bool SquareExpander::someLeft(const TPoint2D& limit, const TPoint2D& x) const {
  return cross(limit, x) > -square_.half * extent(limit, x);
}

bool SquareExpander::someLeft(const Limits& limits, const TPoint2D& x) const {
  return someLeft(at(limits[0]), x) && (limits[1] == limits[0] || someLeft(at(limits[1]), x));
}

bool SquareExpander::someRight(const Limits& limits, const TPoint2D& x) const {
  // Right of the ray to the limit is left of the ray to it, seen in a mirror: the sign turns.
  const auto is_right = [&](const TPoint2D& limit) {
    return cross(limit, x) < square_.half * extent(limit, x);
  };
  return is_right(at(limits[0])) && (limits[1] == limits[0] || is_right(at(limits[1])));
}

/// The limits of what is seen past the apex: it takes the place of limits that are wider from every
/// point of the square. If two limits besides it would remain, the older one goes, which can only
/// add to what is seen.
SquareExpander::Limits SquareExpander::tightened(const Limits& limits, std::int32_t apex,
                                                 bool right) const {
  const TPoint2D a = at(apex);
  const auto is_wider = [&](std::int32_t limit) {
    const TPoint2D l = at(limit);
    const double turn = right ? cross(l, a) : -cross(l, a);
    return turn > square_.half * extent(l, a);
  };
  if (!is_wider(limits[1])) return {limits[1], apex};
  if (limits[0] != limits[1] && !is_wider(limits[0])) return {limits[0], apex};
  return {apex, apex};
}

void SquareExpander::push(Gap gap) {
  const Triangulation::Face& near = t_->faces()[gap.edge / 3];
  const std::uint32_t edge = gap.edge % 3;
  const std::int32_t right = near.vertex[(edge + 1) % 3], left = near.vertex[(edge + 2) % 3];
  Visits& visits = visits_[gap.edge];
  if (visits.count > kCones) return;
  if (visits.count == 0) {
    // No point of the square on the near side: no ray leaves the face here.
    const TPoint2D r = at(right), l = at(left);
    if (cross(r, l) <= -square_.half * extent(r, l)) return;
  }
  const auto end = visits.cones.begin() + visits.count;
  if (std::find(visits.cones.begin(), end, gap) != end) return;
  if (visits.count == 0) touched_.push_back(gap.edge);
  if (visits.count < kCones) {
    visits.cones[static_cast<std::size_t>(visits.count)] = gap;
  } else {
    gap.right = {right, right};
    gap.left = {left, left};
  }
  ++visits.count;
  const bool first = visits.count == 1;
  if (near.passage[edge] == Passage::wall) {
    if (first) walls_->push_back(gap.edge);
    visits.count = kCones + 1;  // seen is seen
    return;
  }
  if (near.neighbor[edge] == Triangulation::kNone) return;
  if (first && near.passage[edge] == Passage::open) open_->push_back(gap.edge);
  stack_.push_back(gap);
}

void SquareExpander::follow(const Gap& gap) {
  const auto near = static_cast<std::int32_t>(gap.edge / 3);
  const std::int32_t next = t_->faces()[gap.edge / 3].neighbor[gap.edge % 3];
  const Triangulation::Face& far = t_->faces()[static_cast<std::size_t>(next)];
  std::uint32_t entered = 0;
  while (far.neighbor[entered] != near) ++entered;
  const std::int32_t apex = far.vertex[entered];
  const TPoint2D a = at(apex);
  const bool sees_right = someLeft(gap.right, a), sees_left = someRight(gap.left, a);
  const HalfEdge base = 3 * static_cast<HalfEdge>(next);
  if (sees_left) {
    push({base + (entered + 2) % 3, sees_right ? tightened(gap.right, apex, true) : gap.right,
          gap.left});
  }
  if (sees_right) {
    push({base + (entered + 1) % 3, gap.right,
          sees_left ? tightened(gap.left, apex, false) : gap.left});
  }
}

}  // namespace mrpt_polyloc
