#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/geometry/convex_pieces.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace mrpt_polyloc {
namespace {

constexpr double kLeastArea = 1e-9;  // [m2]: slivers where rounding decides

/// A triangle cut down to a square, or several joined.
struct Piece {
  std::vector<TPoint2D> polygon;         ///< convex, counterclockwise
  std::vector<std::int32_t> faces;       ///< that it is made of
  std::vector<std::int32_t> neighbors;   ///< faces across edges that can be passed
  std::vector<TPoint2D> border_middles;  ///< of its edges on a border of free space
};

/// A polygon that is being cut; of each edge the one of the triangle that it comes from.
struct CutVertex {
  TPoint2D point;
  int edge;  ///< of the triangle, along the edge that starts here; kSide for a side of the square
};
constexpr int kSide = -1;

/// Keeps what lies where sign * (coordinate - limit) >= 0.
void clip(std::vector<CutVertex>& polygon, double TPoint2D::*coordinate, double sign,
          double limit) {
  std::vector<CutVertex> kept;
  kept.reserve(polygon.size() + 1);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const CutVertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double from = sign * (a.point.*coordinate - limit);
    const double to = sign * (b.point.*coordinate - limit);
    if (from >= 0.0) kept.push_back(a);
    if ((from < 0.0) == (to < 0.0)) continue;
    TPoint2D crossing = a.point + (b.point - a.point) * (from / (from - to));
    crossing.*coordinate = limit;
    kept.push_back({crossing, from >= 0.0 ? kSide : a.edge});
  }
  polygon = std::move(kept);
}

/// The smallest convex polygon around points, without those in the middle of an edge.
std::vector<TPoint2D> convexHull(std::vector<TPoint2D> points) {
  std::sort(points.begin(), points.end(), [](const TPoint2D& p, const TPoint2D& q) {
    return p.x < q.x || (p.x == q.x && p.y < q.y);
  });
  std::vector<TPoint2D> hull;
  const auto add = [&hull](const TPoint2D& p, std::size_t least) {
    // As rounding leaves them: a triple that turns by less than this is straight.
    constexpr double kStraight = 1e-13;
    while (hull.size() >= least + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= kStraight) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const TPoint2D& p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, lower);
  hull.pop_back();
  return hull;
}

bool meets(const std::vector<std::int32_t>& a, const std::vector<std::int32_t>& b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

/// Whether none of the points lies inside a convex polygon.
bool areOnBorder(const std::vector<TPoint2D>& points, const std::vector<TPoint2D>& polygon) {
  constexpr double kOn = 1e-9;  // [m]
  return std::all_of(points.begin(), points.end(), [&polygon](const TPoint2D& p) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const TPoint2D &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if (cross(a, b, p) < kOn * std::hypot(b.x - a.x, b.y - a.y)) return true;
    }
    return false;
  });
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Joins two pieces if they are neighbours and their union is convex.
bool join(Piece& a, const Piece& b) {
  if (!meets(a.neighbors, b.faces)) return false;
  std::vector<TPoint2D> points = a.polygon;
  append(points, b.polygon);
  std::vector<TPoint2D> hull = convexHull(std::move(points));
  constexpr double kRounding = 1e-11;  // [m2]
  const double gap = signedArea(hull) - signedArea(a.polygon) - signedArea(b.polygon);
  if (gap > kRounding || !areOnBorder(a.border_middles, hull) ||
      !areOnBorder(b.border_middles, hull)) {
    return false;
  }
  a.polygon = std::move(hull);
  append(a.faces, b.faces);
  append(a.neighbors, b.neighbors);
  append(a.border_middles, b.border_middles);
  return true;
}

/// The squares of the grid that free faces meet, and which faces meet them.
class FacesOfSquares {
 public:
  FacesOfSquares(const Triangulation& t, const TPoint2D& corner, double size)
      : t_(t), corner_(corner), size_(size) {
    for (std::size_t f = 0; f < t.faces().size(); ++f) {
      if (t.faces()[f].is_free) takeFace(f);
    }
    // By square, row by row, its faces in the triangulation's order.
    std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
      return std::tie(a.row, a.column, a.face) < std::tie(b.row, b.column, b.face);
    });
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const bool is_new =
          i == 0 || pairs_[i].row != pairs_[i - 1].row || pairs_[i].column != pairs_[i - 1].column;
      if (is_new) first_.push_back(i);
    }
    first_.push_back(pairs_.size());
  }

  std::size_t squares() const { return first_.size() - 1; }

  /// The convex pieces of free space in a square.
  std::vector<Piece> pieces(std::size_t square) const;

  std::int32_t column(std::size_t square) const { return pairs_[first_[square]].column; }
  std::int32_t row(std::size_t square) const { return pairs_[first_[square]].row; }

 private:
  struct Pair {
    std::int32_t row, column;
    std::int32_t face;
  };

  void takeFace(std::size_t f) {
    const auto box = BoundingBox::of(std::array{corner(f, 0), corner(f, 1), corner(f, 2)});
    const auto place = [this](double offset) {
      return std::max(static_cast<std::int32_t>(std::floor(offset / size_)), 0);
    };
    for (std::int32_t r = place(box.min.y - corner_.y); r <= place(box.max.y - corner_.y); ++r) {
      for (std::int32_t c = place(box.min.x - corner_.x); c <= place(box.max.x - corner_.x); ++c) {
        if (!misses(f, c, r)) pairs_.push_back({r, c, static_cast<std::int32_t>(f)});
      }
    }
  }
  const TPoint2D& corner(std::size_t face, std::size_t i) const {
    return t_.vertices()[static_cast<std::size_t>(t_.faces()[face].vertex[i])];
  }
  /// Whether all of a square lies beyond one edge of a face.
  bool misses(std::size_t face, std::int32_t column, std::int32_t row) const {
    const TPoint2D middle{corner_.x + (column + 0.5) * size_, corner_.y + (row + 0.5) * size_};
    for (std::size_t i = 0; i < 3; ++i) {
      const TPoint2D &a = corner(face, i), &b = corner(face, (i + 1) % 3);
      const double reach = 0.5 * size_ * (std::abs(b.x - a.x) + std::abs(b.y - a.y));
      if (cross(a, b, middle) < -reach) return true;
    }
    return false;
  }

  const Triangulation& t_;
  TPoint2D corner_;
  double size_;
  std::vector<Pair> pairs_;
  std::vector<std::size_t> first_;  ///< of each square, in `pairs_`, and the end
};

std::vector<Piece> FacesOfSquares::pieces(std::size_t square) const {
  const double left = corner_.x + column(square) * size_, right = left + size_;
  const double bottom = corner_.y + row(square) * size_, top = bottom + size_;
  std::vector<Piece> pieces;
  for (std::size_t k = first_[square]; k < first_[square + 1]; ++k) {
    const auto f = static_cast<std::size_t>(pairs_[k].face);
    const Triangulation::Face& face = t_.faces()[f];
    std::vector<CutVertex> cut;
    for (int i = 0; i < 3; ++i) {
      // The edge that starts at vertex i lies opposite vertex i + 2.
      cut.push_back({corner(f, static_cast<std::size_t>(i)), (i + 2) % 3});
    }
    clip(cut, &TPoint2D::x, 1.0, left);
    clip(cut, &TPoint2D::x, -1.0, right);
    clip(cut, &TPoint2D::y, 1.0, bottom);
    clip(cut, &TPoint2D::y, -1.0, top);
    Piece piece;
    if (cut.size() < 3) continue;
    for (const CutVertex& vertex : cut) piece.polygon.push_back(vertex.point);
    piece.polygon = convexHull(std::move(piece.polygon));  // without repeated vertices
    if (piece.polygon.size() < 3 || signedArea(piece.polygon) < kLeastArea) continue;
    for (std::size_t i = 0; i < cut.size(); ++i) {
      if (cut[i].edge == kSide) continue;
      const auto edge = static_cast<std::size_t>(cut[i].edge);
      if (face.passage[edge] == Passage::clear && face.neighbor[edge] != Triangulation::kNone) {
        piece.neighbors.push_back(face.neighbor[edge]);
      } else {
        piece.border_middles.push_back((cut[i].point + cut[(i + 1) % cut.size()].point) * 0.5);
      }
    }
    piece.faces.push_back(pairs_[k].face);
    pieces.push_back(std::move(piece));
  }
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      for (std::size_t k = pieces.size() - 1; k > i; --k) {
        if (!join(pieces[i], pieces[k])) continue;
        pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(k));
        is_changed = true;
      }
    }
  }
  return pieces;
}

}  // namespace

ConvexPieces convexPieces(const Triangulation& triangulation, const TPoint2D& corner, double size,
                          int threads) {
  const FacesOfSquares squares(triangulation, corner, size);
  std::vector<std::vector<Piece>> pieces(squares.squares());
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    const tbb::blocked_range<std::size_t> all(0, pieces.size(), 256);
    tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) pieces[i] = squares.pieces(i);
    });
  });
  ConvexPieces result;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const Piece& piece : pieces[i]) {
      result.pieces.push_back({squares.column(i), squares.row(i),
                               static_cast<std::uint32_t>(result.vertices.size()),
                               static_cast<std::uint32_t>(piece.polygon.size())});
      append(result.vertices, piece.polygon);
    }
  }
  return result;
}

}  // namespace mrpt_polyloc
