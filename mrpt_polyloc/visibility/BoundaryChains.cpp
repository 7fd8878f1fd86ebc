#include <mrpt_polyloc/visibility/BoundaryChains.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mrpt_polyloc {
namespace {

/// What a half edge is to a viewer on its side.
Passage kindOf(const Triangulation& t, std::size_t face, std::size_t i) {
  const Triangulation::Face& f = t.faces()[face];
  if (f.passage[i] != Passage::open) return f.passage[i];
  const std::int32_t next = f.neighbor[i];
  const bool leads_out = f.is_free && next != Triangulation::kNone &&
                         !t.faces()[static_cast<std::size_t>(next)].is_free;
  return leads_out ? Passage::open : Passage::clear;
}

}  // namespace

BoundaryChains::BoundaryChains(const Triangulation& t) {
  const BoundingBox& box = t.box();
  origin_ = {0.5 * (box.min.x + box.max.x), 0.5 * (box.min.y + box.max.y)};
  const double half = 0.5 * std::max(box.max.x - box.min.x, box.max.y - box.min.y);
  int exponent = 0;
  std::frexp(half, &exponent);             // half < 2^exponent
  unit_ = std::ldexp(1.0, exponent - 30);  // differences stay below 2^31

  std::vector<HalfEdge> walls, open;
  for (std::size_t face = 0; face < t.faces().size(); ++face) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Passage kind = kindOf(t, face, i);
      const auto edge = static_cast<HalfEdge>(3 * face + i);
      if (kind == Passage::wall) walls.push_back(edge);
      if (kind == Passage::open) open.push_back(edge);
    }
  }
  numbers_.assign(3 * t.faces().size(), kNone);
  layOut(t, walls, walls_);
  layOut(t, open, open_);
  x_.resize(x_.size() + kPadding);
  y_.resize(y_.size() + kPadding);
}

std::int32_t BoundaryChains::fixed(double coordinate) const {
  return static_cast<std::int32_t>(std::lrint(coordinate / unit_));
}

/// The half edge of the same kind that goes on where one ends: the first border met when turning
/// around its end, through the space that it is seen from; kNone if that is of another kind.
BoundaryChains::HalfEdge BoundaryChains::following(const Triangulation& t, HalfEdge edge) const {
  std::size_t face = edge / 3, i = edge % 3;
  const Passage kind = kindOf(t, face, i);
  for (;;) {
    const std::size_t next = (i + 1) % 3;
    const Triangulation::Face& f = t.faces()[face];
    const Passage met = kindOf(t, face, next);
    if (met == kind) return static_cast<HalfEdge>(3 * face + next);
    if (met == Passage::wall || f.neighbor[next] == Triangulation::kNone) return kNone;
    const auto back = static_cast<std::int32_t>(face);
    face = static_cast<std::size_t>(f.neighbor[next]);
    const auto& neighbors = t.faces()[face].neighbor;
    i = static_cast<std::size_t>(std::find(neighbors.begin(), neighbors.end(), back) -
                                 neighbors.begin());
  }
}

void BoundaryChains::append(const Triangulation& t, HalfEdge edge, std::size_t end) {
  const Triangulation::Face& f = t.faces()[edge / 3];
  const auto vertex = static_cast<std::size_t>(f.vertex[(edge % 3 + end) % 3]);
  x_.push_back(fixedX(t.vertices()[vertex].x));
  y_.push_back(fixedY(t.vertices()[vertex].y));
}

void BoundaryChains::layOut(const Triangulation& t, const std::vector<HalfEdge>& edges,
                            std::vector<Run>& runs) {
  std::vector<HalfEdge> next(numbers_.size(), kNone);
  std::vector<char> is_followed(numbers_.size(), 0);
  for (const HalfEdge edge : edges) {
    next[edge] = following(t, edge);
    if (next[edge] != kNone) is_followed[next[edge]] = 1;
  }
  const auto chain = [&](HalfEdge start) {
    const auto first = static_cast<std::uint32_t>(x_.size());
    HalfEdge last = start;
    for (HalfEdge e = start; e != kNone && numbers_[e] == kNone; last = e, e = next[e]) {
      numbers_[e] = static_cast<std::uint32_t>(x_.size());
      append(t, e, 1);
      is_edge_.push_back(1);
    }
    append(t, last, 2);
    is_edge_.push_back(0);
    runs.push_back({first, static_cast<std::uint32_t>(x_.size()) - first - 1});
  };
  for (const HalfEdge edge : edges) {
    if (!is_followed[edge]) chain(edge);  // the open chains from their beginning
  }
  for (const HalfEdge edge : edges) {
    if (numbers_[edge] == kNone) chain(edge);  // then the closed ones from anywhere
  }
}

std::size_t BoundaryChains::bytes() const {
  return (x_.size() + y_.size() + numbers_.size()) * sizeof(std::int32_t) + is_edge_.size() +
         (walls_.size() + open_.size()) * sizeof(Run);
}

}  // namespace mrpt_polyloc
