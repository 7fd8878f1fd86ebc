#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/visibility/VisibleEdgeIndex.h>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// So many unseen edges between two seen ones cost less than another run.
constexpr std::uint32_t kGreatestGap = 3;

/// Whether a triangle and an axis-parallel square, whose boxes overlap, overlap themselves.
bool overlap(const Triangulation& t, const Triangulation::Face& face, const Square& square) {
  for (std::size_t i = 0; i < 3; ++i) {
    const TPoint2D a = t.vertices()[static_cast<std::size_t>(face.vertex[i])] - square.center;
    const TPoint2D b =
        t.vertices()[static_cast<std::size_t>(face.vertex[(i + 1) % 3])] - square.center;
    const double reach = square.half * (std::abs(b.x - a.x) + std::abs(b.y - a.y));
    if (a.x * b.y - a.y * b.x < -reach) return false;  // every corner is on the edge's right
  }
  return true;
}

}  // namespace

VisibleEdgeIndex::VisibleEdgeIndex(const Triangulation& triangulation, double square_size,
                                   int threads)
    : VisibleEdgeIndex(triangulation, triangulation.wallsAlone(), square_size, threads) {}

VisibleEdgeIndex::VisibleEdgeIndex(const Triangulation& triangulation, const Triangulation& walls,
                                   double square_size, int threads)
    : chains_(triangulation, walls) {
  layGrid(triangulation.box(), square_size);
  const std::size_t lists = numberLists(triangulation);
  const auto seen_walls = findRuns(walls, lists, threads, [this](std::size_t face, std::size_t i) {
    return chains_.wallNumber(face, i);
  });
  const auto seen_open =
      findRuns(triangulation, lists, threads,
               [this](std::size_t face, std::size_t i) { return chains_.openNumber(face, i); });
  lists_.begin.push_back(0);
  for (std::size_t i = 0; i < lists; ++i) {
    for (const auto* runs : {&seen_walls[i], &seen_open[i]}) {
      lists_.runs.insert(lists_.runs.end(), runs->begin(), runs->end());
      lists_.begin.push_back(static_cast<std::uint32_t>(lists_.runs.size()));
    }
  }
  lists_.runs.shrink_to_fit();
}

VisibleEdgeIndex::VisibleEdgeIndex(const Triangulation& triangulation, Lists lists)
    : chains_(triangulation, triangulation.wallsAlone()) {
  layGrid(triangulation.box(), lists.square_size);
  lists_ = std::move(lists);
  const auto require = [](bool is_met) {
    if (!is_met) throw InvalidMapError("index of visible edges: not of this map");
  };
  require(lists_.of_square.size() ==
          static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  require(lists_.begin.size() % 2 == 1 && lists_.begin.front() == 0 &&
          lists_.begin.back() == lists_.runs.size() &&
          std::is_sorted(lists_.begin.begin(), lists_.begin.end()));
  const auto count = static_cast<std::int32_t>(lists_.begin.size() / 2);
  for (const std::int32_t list : lists_.of_square) require(list >= -1 && list < count);
  for (const Run& run : lists_.runs) {
    require(std::size_t{run.first} + run.edges < chains_.vertexCount());
  }
}

/// \throws InvalidParamsError
void VisibleEdgeIndex::layGrid(const BoundingBox& box, double square_size) {
  if (!(square_size > 0.0)) {
    throw InvalidParamsError("square_size: " + std::to_string(square_size) + " is not positive");
  }
  corner_ = box.min;
  lists_.square_size = square_size;
  const double columns = std::floor((box.max.x - box.min.x) / square_size) + 1;
  const double rows = std::floor((box.max.y - box.min.y) / square_size) + 1;
  constexpr double kMostSquares = 1 << 30;
  if (columns * rows > kMostSquares) {
    throw InvalidParamsError("square_size: " + std::to_string(square_size) +
                             " gives too many squares for a map of this size");
  }
  columns_ = static_cast<int>(columns);
  rows_ = static_cast<int>(rows);
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
      return std::clamp(static_cast<int>((x - corner_.x) / lists_.square_size), 0, columns_ - 1);
    };
    const auto row = [this](double y) {
      return std::clamp(static_cast<int>((y - corner_.y) / lists_.square_size), 0, rows_ - 1);
    };
    for (int r = row(low.y); r <= row(high.y); ++r) {
      for (int c = column(low.x); c <= column(high.x); ++c) visit(f, c, r);
    }
  }
}

Square VisibleEdgeIndex::square(int column, int row) const {
  // A little larger than the square: rounding may put a point of the border on the other side.
  return {{corner_.x + (column + 0.5) * lists_.square_size,
           corner_.y + (row + 0.5) * lists_.square_size},
          (0.5 + 1e-6) * lists_.square_size};
}

std::size_t VisibleEdgeIndex::numberLists(const Triangulation& t) {
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
  lists_.of_square.assign(touches_free.size(), -1);
  std::int32_t lists = 0;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      bool near_free = false;
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows_ - 1); ++r) {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, columns_ - 1); ++c) {
          near_free |= touches_free[number(c, r)] != 0;
        }
      }
      if (near_free) lists_.of_square[number(column, row)] = lists++;
    }
  }
  return static_cast<std::size_t>(lists);
}

template <class Numbers>
std::vector<std::vector<VisibleEdgeIndex::Run>> VisibleEdgeIndex::findRuns(
    const Triangulation& t, std::size_t lists, int threads, const Numbers& number) const {
  std::vector<Square> squares(lists, Square{{0, 0}, 0});
  std::vector<std::vector<std::int32_t>> faces(lists);
  forEachOverlap(t, [&](std::size_t f, int column, int row) {
    const std::int32_t list =
        lists_.of_square[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                         static_cast<std::size_t>(column)];
    if (list < 0) return;
    const auto i = static_cast<std::size_t>(list);
    squares[i] = square(column, row);
    if (overlap(t, t.faces()[f], squares[i])) faces[i].push_back(static_cast<std::int32_t>(f));
  });

  struct Worker {
    SquareExpander expander;
    std::vector<SquareExpander::HalfEdge> ends;
    std::vector<std::uint32_t> numbers;
  };
  tbb::enumerable_thread_specific<Worker> workers([&t] {
    return Worker{SquareExpander(t), {}, {}};
  });
  std::vector<std::vector<Run>> runs(lists);
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, lists, 16), [&](const auto& range) {
      Worker& worker = workers.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        worker.ends.clear();
        worker.numbers.clear();
        worker.expander.expand(squares[i], faces[i], worker.ends);
        for (const SquareExpander::HalfEdge edge : worker.ends) {
          const std::uint32_t n = number(edge / 3, edge % 3);
          if (n != BoundaryChains::kNone) worker.numbers.push_back(n);
        }
        runs[i] = runsOf(worker.numbers);
      }
    });
  });
  return runs;
}

/// Runs that cover edges, with small gaps filled: what is listed without being seen is hidden
/// behind the rest.
std::vector<VisibleEdgeIndex::Run> VisibleEdgeIndex::runsOf(
    std::vector<std::uint32_t>& numbers) const {
  std::sort(numbers.begin(), numbers.end());
  std::vector<Run> runs;
  for (const std::uint32_t number : numbers) {
    if (!runs.empty()) {
      Run& last = runs.back();
      std::uint32_t end = last.first + last.edges;
      if (number - end <= kGreatestGap) {
        while (end < number && chains_.isEdge(end)) ++end;
        if (end == number) {
          last.edges = number + 1 - last.first;
          continue;
        }
      }
    }
    runs.push_back({number, 1});
  }
  return runs;
}

std::int64_t VisibleEdgeIndex::squareNumber(const TPoint2D& point) const {
  const double column = std::floor((point.x - corner_.x) / lists_.square_size);
  const double row = std::floor((point.y - corner_.y) / lists_.square_size);
  if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_)) return -1;
  return lists_.of_square[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                          static_cast<std::size_t>(column)];
}

VisibleEdgeIndex::EdgeRuns VisibleEdgeIndex::edgeRuns(std::int64_t number) const {
  const std::uint32_t* begin = &lists_.begin[2 * static_cast<std::size_t>(number)];
  const Run* runs = lists_.runs.data();
  return {runs + begin[0], begin[1] - begin[0], runs + begin[1], begin[2] - begin[1]};
}

std::size_t VisibleEdgeIndex::bytes() const {
  return chains_.bytes() + lists_.of_square.size() * sizeof(std::int32_t) +
         lists_.begin.size() * sizeof(std::uint32_t) + lists_.runs.size() * sizeof(Run);
}

}  // namespace mrpt_polyloc
