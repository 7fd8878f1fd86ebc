#include <mrpt_polyloc/base/Checksum.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/visibility/VisibilitySkeleton.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace mrpt_polyloc {
namespace {

using Gap = VisibilitySkeleton::Gap;
using mrpt::math::TPose2D;

/// How the edge in a gap ends, as a letter.
int ending(const Gap& gap) {
  return (gap.begins ? 1 : 0) + (gap.ends ? 2 : 0);
}

/// Where the least rotation of a cyclic list starts (two candidates run a race). O(q).
std::size_t leastRotation(const std::vector<Gap>& gaps) {
  const std::size_t q = gaps.size();
  std::size_t i = 0, j = 1, same = 0;
  while (i < q && j < q && same < q) {
    const int a = ending(gaps[(i + same) % q]), b = ending(gaps[(j + same) % q]);
    if (a == b) {
      ++same;
      continue;
    }
    (a > b ? i : j) += same + 1;
    if (i == j) ++j;
    same = 0;
  }
  return std::min(i, j);
}

std::size_t periodOf(const std::vector<Gap>& gaps) {
  const std::size_t q = gaps.size();
  for (std::size_t period = 1; period < q; ++period) {
    if (q % period != 0) continue;
    std::size_t i = 0;
    while (i < q && ending(gaps[i]) == ending(gaps[(i + period) % q])) ++i;
    if (i == q) return period;
  }
  return q;
}

struct Piece {
  std::int32_t vertex, right, left;
  bool begins, ends;
};

/// Pieces of a view, those merged that meet at a vertex on a straight wall.
std::vector<Piece> mergedPieces(const std::vector<TPoint2D>& vertices, const View& view,
                                double flat) {
  const auto at = [&](std::int32_t v) { return vertices[static_cast<std::size_t>(v)]; };
  const auto isFlat = [&](const Piece& piece, const Piece& next) {
    if (!piece.ends || !next.begins) return false;
    const TPoint2D a = at(piece.right), c = at(next.left), ac = c - a, ab = at(next.vertex) - a;
    return std::abs(cross(ac, ab)) <= flat * ac.norm() && dot(ab, ac - ab) > 0.0;
  };
  std::vector<Piece> pieces;
  for (const VisibleEdge& e : view.ends) {
    const Piece next{e.right_limit, e.right, e.left, e.right == e.right_limit,
                     e.left == e.left_limit};
    if (!pieces.empty() && isFlat(pieces.back(), next)) {
      pieces.back().left = next.left;
      pieces.back().ends = next.ends;
    } else {
      pieces.push_back(next);
    }
  }
  while (pieces.size() > 1 && isFlat(pieces.back(), pieces.front())) {
    pieces.front().vertex = pieces.back().vertex;
    pieces.front().right = pieces.back().right;
    pieces.front().begins = pieces.back().begins;
    pieces.pop_back();
  }
  return pieces;
}

/// The motion that carries gap i of one to gap i + shift of the other, and how well it is known.
struct Fit {
  TPose2D motion;
  TPoint2D center;  ///< of the vertices of `to`
  double spread;    ///< their root mean square distance from it
};

TPoint2D moved(const TPose2D& motion, double c, double s, const TPoint2D& p) {
  return {motion.x + c * p.x - s * p.y, motion.y + s * p.x + c * p.y};
}

Fit fitted(const std::vector<Gap>& from, const std::vector<Gap>& to, std::size_t shift) {
  const std::size_t q = from.size();
  const double share = 1.0 / static_cast<double>(q);
  TPoint2D from_center(0, 0), to_center(0, 0);
  for (std::size_t i = 0; i < q; ++i) {
    from_center = from_center + from[i].vertex * share;
    to_center = to_center + to[i].vertex * share;
  }
  double cosine = 0.0, sine = 0.0, square = 0.0;
  for (std::size_t i = 0; i < q; ++i) {
    const TPoint2D f = from[i].vertex - from_center, t = to[(i + shift) % q].vertex - to_center;
    cosine += dot(f, t);
    sine += cross(f, t);
    square += dot(t, t);
  }
  const double phi = std::atan2(sine, cosine), c = std::cos(phi), s = std::sin(phi);
  const TPoint2D turned(c * from_center.x - s * from_center.y,
                        s * from_center.x + c * from_center.y);
  return {TPose2D(to_center.x - turned.x, to_center.y - turned.y, phi), to_center,
          std::sqrt(square * share)};
}

/// Whether the points of the shorter piece lie on the line of the longer one, in its direction.
bool sameLine(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c, const TPoint2D& d,
              const Fit& fit, double tolerance) {
  const TPoint2D ab = b - a, cd = d - c;
  if (dot(ab, cd) <= 0.0) return false;
  if (dot(ab, ab) < dot(cd, cd)) return sameLine(c, d, a, b, fit, tolerance);
  const double length = ab.norm();
  for (const TPoint2D& p : {c, d}) {
    const double slack = tolerance * (1.0 + 2.0 * (p - fit.center).norm() / fit.spread);
    if (std::abs(cross(ab, p - a)) > slack * length) return false;
  }
  return true;
}

bool sameRing(const std::vector<Gap>& from, const std::vector<Gap>& to, std::size_t shift,
              double tolerance) {
  const std::size_t q = from.size();
  for (std::size_t i = 0; i < q; ++i) {
    const TPoint2D f = from[(i + 1) % q].vertex - from[i].vertex;
    const TPoint2D t = to[(i + 1 + shift) % q].vertex - to[(i + shift) % q].vertex;
    if (std::abs(f.norm() - t.norm()) > 2.0 * tolerance) return false;
  }
  return true;
}

std::optional<TPose2D> alignment(const std::vector<Gap>& from, const std::vector<Gap>& to,
                                 std::size_t shift, double tolerance) {
  if (!sameRing(from, to, shift, tolerance)) return std::nullopt;
  const Fit fit = fitted(from, to, shift);
  if (fit.spread <= 0.0) return std::nullopt;
  const double c = std::cos(fit.motion.phi), s = std::sin(fit.motion.phi);
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Gap &f = from[i], &t = to[(i + shift) % to.size()];
    if ((moved(fit.motion, c, s, f.vertex) - t.vertex).norm() > tolerance) return std::nullopt;
    if (f.begins && f.ends) continue;  // the line through both vertices
    if (!sameLine(moved(fit.motion, c, s, f.a), moved(fit.motion, c, s, f.b), t.a, t.b, fit,
                  tolerance)) {
      return std::nullopt;
    }
  }
  return fit.motion;
}

}  // namespace

VisibilitySkeleton::VisibilitySkeleton(std::vector<Gap> gaps) : gaps_(std::move(gaps)) {
  if (gaps_.empty()) throw InvalidParamsError("a visibility skeleton without gaps");
  start_ = leastRotation(gaps_);
  period_ = periodOf(gaps_);
  Fnv hash;
  const std::size_t q = gaps_.size();
  for (std::size_t i = 0; i < q; ++i) {
    hash.addNumber(static_cast<std::uint64_t>(ending(gaps_[(start_ + i) % q])));
    ring_length_ += (gaps_[(i + 1) % q].vertex - gaps_[i].vertex).norm();
  }
  key_ = hash.value();
}

VisibilitySkeleton skeletonOf(const Triangulation& triangulation, const View& view, double flat) {
  const std::vector<TPoint2D>& vertices = triangulation.vertices();
  const auto at = [&](std::int32_t v) { return vertices[static_cast<std::size_t>(v)]; };
  std::vector<Gap> gaps;
  for (const Piece& piece : mergedPieces(vertices, view, flat)) {
    gaps.push_back({at(piece.vertex), at(piece.right), at(piece.left), piece.begins, piece.ends});
  }
  return VisibilitySkeleton(std::move(gaps));
}

VisibilitySkeleton skeletonOf(const VisibilityCells& cells, std::size_t cell,
                              ViewExpander& expander, double flat) {
  return skeletonOf(cells.triangulation(), expander.expand(cells.representative(cell)), flat);
}

std::vector<TPose2D> alignments(const VisibilitySkeleton& from, const VisibilitySkeleton& to,
                                double tolerance) {
  std::vector<TPose2D> found;
  const std::size_t q = from.size();
  if (q != to.size() || from.key() != to.key() || from.period() != to.period()) return found;
  for (std::size_t k = 0; k < q; k += from.period()) {
    const std::size_t shift = (to.start() + q - from.start() + k) % q;
    const auto motion = alignment(from.gaps(), to.gaps(), shift, tolerance);
    if (motion) found.push_back(*motion);
  }
  return found;
}

}  // namespace mrpt_polyloc
