#include <mrpt_polyloc/base/Checksum.h>
#include <mrpt_polyloc/visibility/BoundaryChains.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mrpt_polyloc {
namespace {

using HalfEdge = std::uint32_t;  // 3 * face + edge

/// The half edge of the same kind that goes on where one ends: the first border met when turning
/// around its end, through the space that it is seen from; kNone if that is of another kind.
HalfEdge following(const Triangulation& t, HalfEdge edge, Passage kind) {
  std::size_t face = edge / 3, i = edge % 3;
  for (;;) {
    const std::size_t next = (i + 1) % 3;
    const Triangulation::Face& f = t.faces()[face];
    const Passage met = t.passageOutwards(face, next);
    if (met == kind) return static_cast<HalfEdge>(3 * face + next);
    if (met == Passage::wall || f.neighbor[next] == Triangulation::kNone) {
      return BoundaryChains::kNone;
    }
    const auto back = static_cast<std::int32_t>(face);
    face = static_cast<std::size_t>(f.neighbor[next]);
    const auto& neighbors = t.faces()[face].neighbor;
    i = static_cast<std::size_t>(std::find(neighbors.begin(), neighbors.end(), back) -
                                 neighbors.begin());
  }
}

}  // namespace

BoundaryChains::BoundaryChains(const Triangulation& triangulation) {
  const BoundingBox& box = triangulation.box();
  origin_ = {0.5 * (box.min.x + box.max.x), 0.5 * (box.min.y + box.max.y)};
  const double half = 0.5 * std::max(box.width(), box.height());
  int exponent = 0;
  std::frexp(half, &exponent);             // half < 2^exponent
  unit_ = std::ldexp(1.0, exponent - 30);  // differences stay below 2^31
  layOut(triangulation, Passage::wall, wall_numbers_, walls_);
  layOut(triangulation, Passage::open, open_numbers_, open_);
  x_.resize(x_.size() + kPadding);
  y_.resize(y_.size() + kPadding);
}

std::int32_t BoundaryChains::fixed(double coordinate) const {
  return static_cast<std::int32_t>(std::lrint(coordinate / unit_));
}

void BoundaryChains::append(const TPoint2D& vertex, bool is_edge) {
  x_.push_back(fixedX(vertex.x));
  y_.push_back(fixedY(vertex.y));
  is_edge_.push_back(is_edge ? 1 : 0);
}

void BoundaryChains::layOut(const Triangulation& t, Passage kind,
                            std::vector<std::uint32_t>& numbers, std::vector<Run>& runs) {
  std::vector<HalfEdge> edges;
  for (std::size_t face = 0; face < t.faces().size(); ++face) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (t.passageOutwards(face, i) == kind) edges.push_back(static_cast<HalfEdge>(3 * face + i));
    }
  }
  numbers.assign(3 * t.faces().size(), kNone);
  std::vector<HalfEdge> next(numbers.size(), kNone);
  std::vector<char> is_followed(numbers.size(), 0);
  for (const HalfEdge edge : edges) {
    next[edge] = following(t, edge, kind);
    if (next[edge] != kNone) is_followed[next[edge]] = 1;
  }
  const auto end = [&t](HalfEdge edge, std::size_t which) {  // 1: where it starts, 2: where it ends
    const Triangulation::Face& face = t.faces()[edge / 3];
    return t.vertices()[static_cast<std::size_t>(face.vertex[(edge % 3 + which) % 3])];
  };
  const auto chain = [&](HalfEdge start) {
    const auto first = static_cast<std::uint32_t>(x_.size());
    HalfEdge last = start;
    for (HalfEdge e = start; e != kNone && numbers[e] == kNone; last = e, e = next[e]) {
      numbers[e] = static_cast<std::uint32_t>(x_.size());
      append(end(e, 1), true);
    }
    append(end(last, 2), false);
    runs.push_back({first, static_cast<std::uint32_t>(x_.size()) - first - 1});
  };
  for (const HalfEdge edge : edges) {
    if (!is_followed[edge]) chain(edge);  // the open chains from their beginning
  }
  for (const HalfEdge edge : edges) {
    if (numbers[edge] == kNone) chain(edge);  // then the closed ones from anywhere
  }
}

std::uint64_t BoundaryChains::hash() const {
  Checksum checksum;
  checksum.add(&origin_.x, sizeof(origin_.x));
  checksum.add(&origin_.y, sizeof(origin_.y));
  checksum.add(&unit_, sizeof(unit_));
  checksum.add(x_.data(), x_.size() * sizeof(x_[0]));
  checksum.add(y_.data(), y_.size() * sizeof(y_[0]));
  checksum.add(is_edge_.data(), is_edge_.size());
  return checksum.value();
}

std::size_t BoundaryChains::bytes() const {
  return (x_.size() + y_.size() + wall_numbers_.size() + open_numbers_.size()) *
             sizeof(std::int32_t) +
         is_edge_.size() + (walls_.size() + open_.size()) * sizeof(Run);
}

}  // namespace mrpt_polyloc
