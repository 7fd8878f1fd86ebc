#include <mrpt_polyloc/geometry/orientation.h>
#include <mrpt_polyloc/visibility/ViewExpander.h>

#include <cstddef>

namespace mrpt_polyloc {
namespace {

const TPoint2D& vertex(const Triangulation& t, std::int32_t v) {
  return t.vertices()[static_cast<std::size_t>(v)];
}

/// A point strictly inside a face: the given one, or one next to it if it lies on the border.
TPoint2D strictlyInside(const Triangulation& t, const Triangulation::Face& face,
                        const TPoint2D& point) {
  const TPoint2D& a = vertex(t, face.vertex[0]);
  const TPoint2D& b = vertex(t, face.vertex[1]);
  const TPoint2D& c = vertex(t, face.vertex[2]);
  const bool inside =
      orientation(a, b, point) > 0 && orientation(b, c, point) > 0 && orientation(c, a, point) > 0;
  if (inside) return point;
  constexpr double kShare = 1e-9;
  const TPoint2D centroid{(a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0};
  return {point.x + kShare * (centroid.x - point.x), point.y + kShare * (centroid.y - point.y)};
}

}  // namespace

const View& ViewExpander::expand(const TPoint2D& viewpoint) {
  view_.viewpoint = viewpoint;
  view_.ends.clear();
  view_.open.clear();
  stack_.clear();
  const int start = triangulation_->locate(viewpoint);
  if (start == Triangulation::kNone) return view_;
  const Triangulation::Face& face = triangulation_->faces()[static_cast<std::size_t>(start)];
  view_.viewpoint = strictlyInside(*triangulation_, face, viewpoint);
  for (std::int32_t i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    stack_.push_back({start, i, face.vertex[(k + 1) % 3], face.vertex[(k + 2) % 3], false});
    while (!stack_.empty()) {
      const Gap gap = stack_.back();
      stack_.pop_back();
      follow(gap);
    }
  }
  return view_;
}

void ViewExpander::follow(Gap gap) {
  const auto& faces = triangulation_->faces();
  const Triangulation::Face& near = faces[static_cast<std::size_t>(gap.face)];
  const auto edge = static_cast<std::size_t>(gap.edge);
  const std::int32_t next = near.neighbor[edge];
  const Passage passage = near.passage[edge];
  const VisibleEdge piece{near.vertex[(edge + 1) % 3], near.vertex[(edge + 2) % 3], gap.right,
                          gap.left, passage == Passage::wall};
  if (next == Triangulation::kNone || passage == Passage::wall ||
      (stop_at_open_ && passage == Passage::open)) {
    view_.ends.push_back(piece);
    return;
  }
  const Triangulation::Face& far = faces[static_cast<std::size_t>(next)];
  if (passage == Passage::open && !gap.has_left_free_space && near.is_free && !far.is_free) {
    view_.open.push_back(piece);
    gap.has_left_free_space = true;
  }

  // Seen from the viewpoint, the edge just passed runs from vertex entered + 2 of the far face
  // (right) to entered + 1 (left); its third vertex, the apex, parts what lies beyond.
  std::int32_t entered = 0;
  while (far.neighbor[static_cast<std::size_t>(entered)] != gap.face) ++entered;
  const std::int32_t apex = far.vertex[static_cast<std::size_t>(entered)];
  const TPoint2D& p = view_.viewpoint;
  const TPoint2D& a = vertex(*triangulation_, apex);
  const bool sees_right = orientation(p, vertex(*triangulation_, gap.right), a) > 0;
  const bool sees_left = orientation(p, vertex(*triangulation_, gap.left), a) < 0;
  // The left part goes on the stack first: the right one is then followed to its end before it.
  if (sees_left) {
    stack_.push_back({next, (entered + 2) % 3, sees_right ? apex : gap.right, gap.left,
                      gap.has_left_free_space});
  }
  if (sees_right) {
    stack_.push_back(
        {next, (entered + 1) % 3, gap.right, sees_left ? apex : gap.left, gap.has_left_free_space});
  }
}

}  // namespace mrpt_polyloc
