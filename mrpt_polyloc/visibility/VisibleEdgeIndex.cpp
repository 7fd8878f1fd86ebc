#include <mrpt_polyloc/geometry/errors.h>
#include <mrpt_polyloc/visibility/VisibleEdgeIndex.h>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace mrpt_polyloc {
namespace {

using HalfEdge = std::uint32_t;  // 3 * face + edge

using Square = VisibleEdgeIndex::Square;

double turn(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Whether c is left of the ray from some point of the square through `limit`.
bool someLeft(const Square& s, const TPoint2D& limit, const TPoint2D& c) {
  return turn(s.corners[0], limit, c) > 0 || turn(s.corners[1], limit, c) > 0 ||
         turn(s.corners[2], limit, c) > 0 || turn(s.corners[3], limit, c) > 0;
}
bool someRight(const Square& s, const TPoint2D& limit, const TPoint2D& c) {
  return turn(s.corners[0], limit, c) < 0 || turn(s.corners[1], limit, c) < 0 ||
         turn(s.corners[2], limit, c) < 0 || turn(s.corners[3], limit, c) < 0;
}

/// Whether a triangle and an axis-parallel square, whose boxes overlap, overlap themselves.
bool overlap(const Triangulation& t, const Triangulation::Face& face, const Square& square) {
  for (std::size_t i = 0; i < 3; ++i) {
    const TPoint2D& a = t.vertices()[static_cast<std::size_t>(face.vertex[i])];
    const TPoint2D& b = t.vertices()[static_cast<std::size_t>(face.vertex[(i + 1) % 3])];
    const bool parts = std::all_of(square.corners.begin(), square.corners.end(),
                                   [&](const TPoint2D& c) { return turn(a, b, c) < 0; });
    if (parts) return false;
  }
  return true;
}

/// Weak visibility from squares; keeps its memory, one per thread.
class SquareExpander {
 public:
  explicit SquareExpander(const Triangulation& t) : t_(&t), visits_(3 * t.faces().size()) {}

  /// The walls and open edges seen from somewhere in the square, given the faces that overlap it.
  void expand(const Square& square, const std::vector<std::int32_t>& faces,
              std::vector<HalfEdge>& walls, std::vector<HalfEdge>& open) {
    square_ = &square;
    walls_ = &walls;
    open_ = &open;
    for (const std::int32_t face : faces) {
      for (std::uint32_t i = 0; i < 3; ++i) start(face, i);
    }
    while (!stack_.empty()) {
      const Gap gap = stack_.back();
      stack_.pop_back();
      follow(gap);
    }
    for (const HalfEdge edge : touched_) visits_[edge] = {};
    touched_.clear();
  }

 private:
  struct Gap {
    HalfEdge edge;
    std::int32_t right, left;
  };
  /// The cones by which a half edge was reached: up to kCones different ones; after that the widest
  /// possible cone, that of the edge itself, stands for all. Bounds the work where many holes offer
  /// many ways.
  static constexpr int kCones = 3;
  struct Visits {
    int count = 0;
    std::array<std::pair<std::int32_t, std::int32_t>, kCones> cones{};
  };

  const TPoint2D& at(std::int32_t v) const { return t_->vertices()[static_cast<std::size_t>(v)]; }

  void start(std::int32_t face, std::uint32_t i) {
    const Triangulation::Face& f = t_->faces()[static_cast<std::size_t>(face)];
    push({3 * static_cast<HalfEdge>(face) + i, f.vertex[(i + 1) % 3], f.vertex[(i + 2) % 3]});
  }

  void push(Gap gap) {
    Visits& visits = visits_[gap.edge];
    if (visits.count > kCones) return;
    const std::pair<std::int32_t, std::int32_t> cone{gap.right, gap.left};
    const auto end = visits.cones.begin() + visits.count;
    if (std::find(visits.cones.begin(), end, cone) != end) return;
    if (visits.count == 0) touched_.push_back(gap.edge);
    if (visits.count < kCones) {
      visits.cones[static_cast<std::size_t>(visits.count)] = cone;
    } else {
      const Triangulation::Face& f = t_->faces()[gap.edge / 3];
      gap.right = f.vertex[(gap.edge % 3 + 1) % 3];
      gap.left = f.vertex[(gap.edge % 3 + 2) % 3];
    }
    ++visits.count;
    const bool first = visits.count == 1;
    const Triangulation::Face& near = t_->faces()[gap.edge / 3];
    const std::uint32_t edge = gap.edge % 3;
    const std::int32_t next = near.neighbor[edge];
    if (near.passage[edge] == Passage::wall) {
      if (first) walls_->push_back(gap.edge);
      return;
    }
    if (next == Triangulation::kNone) return;
    if (first && near.passage[edge] == Passage::open && near.is_free &&
        !t_->faces()[static_cast<std::size_t>(next)].is_free) {
      open_->push_back(gap.edge);
    }
    stack_.push_back(gap);
  }

  void follow(const Gap& gap) {
    const auto near = static_cast<std::int32_t>(gap.edge / 3);
    const std::int32_t next = t_->faces()[gap.edge / 3].neighbor[gap.edge % 3];
    const Triangulation::Face& far = t_->faces()[static_cast<std::size_t>(next)];
    std::uint32_t entered = 0;
    while (far.neighbor[entered] != near) ++entered;
    const std::int32_t apex = far.vertex[entered];
    const bool sees_right = someLeft(*square_, at(gap.right), at(apex));
    const bool sees_left = someRight(*square_, at(gap.left), at(apex));
    const HalfEdge base = 3 * static_cast<HalfEdge>(next);
    if (sees_left) {
      push({base + (entered + 2) % 3, sees_right ? apex : gap.right, gap.left});
    }
    if (sees_right) {
      push({base + (entered + 1) % 3, gap.right, sees_left ? apex : gap.left});
    }
  }

  const Triangulation* t_;
  const Square* square_ = nullptr;
  std::vector<HalfEdge>* walls_ = nullptr;
  std::vector<HalfEdge>* open_ = nullptr;
  std::vector<Visits> visits_;
  std::vector<HalfEdge> touched_;
  std::vector<Gap> stack_;
};

}  // namespace

VisibleEdgeIndex::VisibleEdgeIndex(const Triangulation& triangulation, double cell_size,
                                   int threads)
    : cell_size_(cell_size) {
  if (!(cell_size > 0.0)) throw InvalidParamsError("cell_size must be positive");
  const BoundingBox& box = triangulation.box();
  corner_ = box.min;
  origin_ = {0.5 * (box.min.x + box.max.x), 0.5 * (box.min.y + box.max.y)};
  columns_ = static_cast<int>((box.max.x - box.min.x) / cell_size_) + 1;
  rows_ = static_cast<int>((box.max.y - box.min.y) / cell_size_) + 1;
  numberLists(triangulation);
  buildLists(triangulation, threads);
}

template <class Visitor>
void VisibleEdgeIndex::forEachOverlap(const Triangulation& t, Visitor&& visit) const {
  for (std::size_t f = 0; f < t.faces().size(); ++f) {
    const Triangulation::Face& face = t.faces()[f];
    TPoint2D low = t.vertices()[static_cast<std::size_t>(face.vertex[0])], high = low;
    for (const std::int32_t v : face.vertex) {
      const TPoint2D& p = t.vertices()[static_cast<std::size_t>(v)];
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const auto column = [this](double x) {
      return std::clamp(static_cast<int>((x - corner_.x) / cell_size_), 0, columns_ - 1);
    };
    const auto row = [this](double y) {
      return std::clamp(static_cast<int>((y - corner_.y) / cell_size_), 0, rows_ - 1);
    };
    for (int r = row(low.y); r <= row(high.y); ++r) {
      for (int c = column(low.x); c <= column(high.x); ++c) visit(f, c, r);
    }
  }
}

VisibleEdgeIndex::Square VisibleEdgeIndex::square(int column, int row) const {
  // A little larger than the cell: rounding may put a point of the border on the other side.
  const double slack = 1e-6 * cell_size_;
  const double x0 = corner_.x + column * cell_size_ - slack, x1 = x0 + cell_size_ + 2 * slack;
  const double y0 = corner_.y + row * cell_size_ - slack, y1 = y0 + cell_size_ + 2 * slack;
  return {{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}};
}

void VisibleEdgeIndex::numberLists(const Triangulation& t) {
  std::vector<char> touches_free(static_cast<std::size_t>(columns_) *
                                 static_cast<std::size_t>(rows_));
  const auto number = [this](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  };
  forEachOverlap(t, [&](std::size_t f, int column, int row) {
    char& touches = touches_free[number(column, row)];
    if (!touches && t.faces()[f].is_free) touches = overlap(t, t.faces()[f], square(column, row));
  });
  list_of_cell_.assign(touches_free.size(), -1);
  std::int32_t lists = 0;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      bool near_free = false;
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows_ - 1); ++r) {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, columns_ - 1); ++c) {
          near_free |= touches_free[number(c, r)] != 0;
        }
      }
      if (near_free) list_of_cell_[number(column, row)] = lists++;
    }
  }
  list_begin_.assign(2 * static_cast<std::size_t>(lists) + 1, 0);
}

void VisibleEdgeIndex::buildLists(const Triangulation& t, int threads) {
  const std::size_t lists = list_begin_.size() / 2;
  std::vector<Square> squares(lists);
  std::vector<std::vector<std::int32_t>> faces(lists);
  forEachOverlap(t, [&](std::size_t f, int column, int row) {
    const std::int32_t list =
        list_of_cell_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(column)];
    if (list < 0) return;
    const auto i = static_cast<std::size_t>(list);
    squares[i] = square(column, row);
    if (overlap(t, t.faces()[f], squares[i])) faces[i].push_back(static_cast<std::int32_t>(f));
  });

  std::vector<std::vector<HalfEdge>> walls(lists), open(lists);
  tbb::enumerable_thread_specific<SquareExpander> expanders([&t] { return SquareExpander(t); });
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, lists, 16), [&](const auto& range) {
      SquareExpander& expander = expanders.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        expander.expand(squares[i], faces[i], walls[i], open[i]);
        std::sort(walls[i].begin(), walls[i].end());
        std::sort(open[i].begin(), open[i].end());
      }
    });
  });
  flatten(t, walls, open);
}

void VisibleEdgeIndex::flatten(const Triangulation& t,
                               const std::vector<std::vector<std::uint32_t>>& walls,
                               const std::vector<std::vector<std::uint32_t>>& open) {
  constexpr auto kUnused = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> number_of(3 * t.faces().size(), kUnused);
  const auto number = [&](HalfEdge half_edge) {
    std::uint32_t& n = number_of[half_edge];
    if (n == kUnused) {
      n = static_cast<std::uint32_t>(edges_.size());
      const Triangulation::Face& f = t.faces()[half_edge / 3];
      const auto at = [&](HalfEdge i) {
        return t.vertices()[static_cast<std::size_t>(f.vertex[i % 3])] - origin_;
      };
      const TPoint2D a = at(half_edge % 3 + 1), b = at(half_edge % 3 + 2);
      edges_.push_back({static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(b.x),
                        static_cast<float>(b.y)});
    }
    return n;
  };
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (const HalfEdge e : walls[i]) list_.push_back(number(e));
    list_begin_[2 * i + 1] = static_cast<std::uint32_t>(list_.size());
    for (const HalfEdge e : open[i]) list_.push_back(number(e));
    list_begin_[2 * i + 2] = static_cast<std::uint32_t>(list_.size());
  }
}

std::int64_t VisibleEdgeIndex::cellNumber(const TPoint2D& point) const {
  const double column = std::floor((point.x - corner_.x) / cell_size_);
  const double row = std::floor((point.y - corner_.y) / cell_size_);
  if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_)) return -1;
  return list_of_cell_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                       static_cast<std::size_t>(column)];
}

VisibleEdgeIndex::Cell VisibleEdgeIndex::cell(std::int64_t number) const {
  const std::uint32_t* begin = &list_begin_[2 * static_cast<std::size_t>(number)];
  return {list_.data() + begin[0], begin[1] - begin[0], list_.data() + begin[1],
          begin[2] - begin[1]};
}

std::size_t VisibleEdgeIndex::bytes() const {
  return edges_.size() * sizeof(Edge) + list_of_cell_.size() * sizeof(std::int32_t) +
         (list_begin_.size() + list_.size()) * sizeof(std::uint32_t);
}

}  // namespace mrpt_polyloc
