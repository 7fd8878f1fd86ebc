#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/visibility/VisibleEdgeIndex.h>
#include <mrpt_polyloc/visibility/packed_runs.h>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// So many unseen edges between two seen ones cost less than another run.
constexpr std::uint32_t kGreatestGap = 3;

std::uint64_t nextId() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

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
                                   int threads, double horizon, BuildProgress* progress)
    : chains_(triangulation), id_(nextId()) {
  requirePositive("horizon", horizon);
  lists_.layout = chains_.hash();
  lists_.horizon = horizon;
  layGrid(triangulation.box(), square_size);
  const std::size_t lists = numberLists(triangulation);
  if (progress != nullptr) progress->begin(lists);
  const std::vector<SeenRuns> seen = findRuns(triangulation, lists, threads, progress);
  lists_.begin.push_back(0);
  for (const SeenRuns& from_square : seen) {
    for (const auto* runs : {&from_square.walls, &from_square.open}) {
      lists_.begin.push_back(lists_.begin.back() + runs->size());
    }
  }
  lists_.runs.reserve(lists_.begin.back());
  for (const SeenRuns& from_square : seen) {
    for (const auto* runs : {&from_square.walls, &from_square.open}) {
      lists_.runs.insert(lists_.runs.end(), runs->begin(), runs->end());
    }
  }
}

VisibleEdgeIndex::VisibleEdgeIndex(const Triangulation& triangulation, Lists lists)
    : chains_(triangulation), id_(nextId()) {
  layGrid(triangulation.box(), lists.square_size);
  lists_ = std::move(lists);
  const auto require = [](bool is_met) {
    if (!is_met) throw InvalidMapError("index of visible edges: not of this map");
  };
  if (lists_.layout != chains_.hash()) {
    throw InvalidMapError(
        "index of visible edges: refers to walls laid out otherwise (made by another version?)");
  }
  require(lists_.begin.size() % 2 == 1 && lists_.begin.front() == 0 &&
          lists_.begin.back() == lists_.runs.size() &&
          std::is_sorted(lists_.begin.begin(), lists_.begin.end()));
  require(lists_.squares.size() == lists_.begin.size() / 2);
  require(lists_.horizon > 0.0);
  for (const SquarePlace& place : lists_.squares) {
    require(place.column >= 0 && place.column < grid_.columns() && place.row >= 0 &&
            place.row < grid_.rows() && grid_.at(place.column, place.row) == TiledGrid::kNone);
    grid_.put(place.column, place.row, static_cast<std::int32_t>(&place - lists_.squares.data()));
  }
  for (std::size_t i = 0; i + 1 < lists_.begin.size(); ++i) {
    require(arePackedRuns(lists_.runs.data() + lists_.begin[i],
                          lists_.runs.data() + lists_.begin[i + 1], chains_.vertexCount()));
  }
}

/// \throws InvalidParamsError
void VisibleEdgeIndex::layGrid(const BoundingBox& box, double square_size) {
  if (!(square_size > 0.0)) {
    throw InvalidParamsError("square_size: " + formatted("%f", square_size) + " is not positive");
  }
  corner_ = box.min;
  lists_.square_size = square_size;
  const double columns = std::floor(box.width() / square_size) + 1;
  const double rows = std::floor(box.height() / square_size) + 1;
  constexpr double kMostSquares = 1e12;  // a directory of a gigabyte
  if (columns * rows > kMostSquares || std::max(columns, rows) > kMostSquares / 1e4) {
    throw InvalidParamsError("square_size: " + formatted("%f", square_size) +
                             " gives too many squares for a map of this size");
  }
  grid_ = TiledGrid(static_cast<int>(columns), static_cast<int>(rows));
}

/// The squares that the box of a face meets.
VisibleEdgeIndex::SquareRange VisibleEdgeIndex::rangeOf(const Triangulation& t,
                                                        const Triangulation::Face& face) const {
  BoundingBox box = BoundingBox::empty();
  for (const std::int32_t v : face.vertex) {
    box.include(t.vertices()[static_cast<std::size_t>(v)]);
  }
  const auto column = [this](double x) {
    return std::clamp(static_cast<int>((x - corner_.x) / lists_.square_size), 0,
                      grid_.columns() - 1);
  };
  const auto row = [this](double y) {
    return std::clamp(static_cast<int>((y - corner_.y) / lists_.square_size), 0, grid_.rows() - 1);
  };
  return {column(box.min.x), column(box.max.x), row(box.min.y), row(box.max.y)};
}

Square VisibleEdgeIndex::square(int column, int row) const {
  // A little larger than the square: rounding may put a point of the border on the other side.
  return {{corner_.x + (column + 0.5) * lists_.square_size,
           corner_.y + (row + 0.5) * lists_.square_size},
          (0.5 + 1e-6) * lists_.square_size};
}

/// All squares that touch free space, and those next to them.
std::size_t VisibleEdgeIndex::numberLists(const Triangulation& t) {
  TiledGrid touched(grid_.columns(), grid_.rows());
  for (const Triangulation::Face& face : t.faces()) {
    if (!face.is_free) continue;
    const SquareRange range = rangeOf(t, face);
    for (int row = range.first_row; row <= range.last_row; ++row) {
      for (int column = range.first_column; column <= range.last_column; ++column) {
        if (touched.at(column, row) == TiledGrid::kNone && overlap(t, face, square(column, row))) {
          touched.put(column, row, 1);
        }
      }
    }
  }
  touched.forEach([this](int column, int row, std::int32_t) {
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, grid_.rows() - 1); ++r) {
      for (int c = std::max(column - 1, 0); c <= std::min(column + 1, grid_.columns() - 1); ++c) {
        grid_.put(c, r, 0);
      }
    }
  });
  grid_.forEach([this](int column, int row, std::int32_t) {
    grid_.put(column, row, static_cast<std::int32_t>(lists_.squares.size()));
    lists_.squares.push_back({column, row});
  });
  return lists_.squares.size();
}

std::vector<VisibleEdgeIndex::SeenRuns> VisibleEdgeIndex::findRuns(const Triangulation& t,
                                                                   std::size_t lists, int threads,
                                                                   BuildProgress* progress) const {
  std::vector<std::vector<std::int32_t>> faces(lists);
  for (std::size_t f = 0; f < t.faces().size(); ++f) {
    const SquareRange range = rangeOf(t, t.faces()[f]);
    grid_.forEachIn(
        range.first_column, range.last_column, range.first_row, range.last_row,
        [&](int column, int row, std::int32_t list) {
          if (overlap(t, t.faces()[f], square(column, row))) {
            faces[static_cast<std::size_t>(list)].push_back(static_cast<std::int32_t>(f));
          }
        });
  }

  struct Worker {
    SquareExpander expander;
    std::vector<SquareExpander::HalfEdge> walls, open;
    std::vector<std::uint32_t> numbers;
  };
  tbb::enumerable_thread_specific<Worker> workers([&] {
    return Worker{SquareExpander(t, lists_.horizon), {}, {}, {}};
  });
  std::vector<SeenRuns> runs(lists);
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, lists, 16), [&](const auto& range) {
      Worker& worker = workers.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        worker.walls.clear();
        worker.open.clear();
        const SquarePlace& place = lists_.squares[i];
        worker.expander.expand(square(place.column, place.row), faces[i], worker.walls,
                               worker.open);
        worker.numbers.clear();
        for (const auto edge : worker.walls) {
          worker.numbers.push_back(chains_.wallNumber(edge / 3, edge % 3));
        }
        runs[i].walls = packedRunsOf(worker.numbers);
        worker.numbers.clear();
        for (const auto edge : worker.open) {
          worker.numbers.push_back(chains_.openNumber(edge / 3, edge % 3));
        }
        runs[i].open = packedRunsOf(worker.numbers);
      }
      if (progress != nullptr) progress->take(range.size());
    });
  });
  return runs;
}

/// Runs that cover edges, with small gaps filled: what is listed without being seen is hidden
/// behind the rest.
std::vector<std::uint8_t> VisibleEdgeIndex::packedRunsOf(
    std::vector<std::uint32_t>& numbers) const {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
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
  std::vector<std::uint8_t> packed;
  packRuns(runs, packed);
  packed.shrink_to_fit();
  return packed;
}

std::int64_t VisibleEdgeIndex::squareNumber(const TPoint2D& point) const {
  const double column = std::floor((point.x - corner_.x) / lists_.square_size);
  const double row = std::floor((point.y - corner_.y) / lists_.square_size);
  if (!(column >= 0 && row >= 0 && column < grid_.columns() && row < grid_.rows())) return -1;
  return grid_.at(static_cast<int>(column), static_cast<int>(row));
}

void VisibleEdgeIndex::take(std::int64_t number, EdgeRuns& runs) const {
  if (runs.index_ == id_ && runs.square_ == number) return;
  runs.index_ = id_;
  runs.square_ = number;
  if (number < 0) {
    runs.walls = chains_.walls();
    runs.open = chains_.open();
    return;
  }
  const std::uint64_t* begin = &lists_.begin[2 * static_cast<std::size_t>(number)];
  const std::uint8_t* bytes = lists_.runs.data();
  runs.walls.clear();
  runs.open.clear();
  unpackRuns(bytes + begin[0], bytes + begin[1], runs.walls);
  unpackRuns(bytes + begin[1], bytes + begin[2], runs.open);
}

VisibleEdgeIndex::EdgeRuns VisibleEdgeIndex::edgeRuns(std::int64_t number) const {
  EdgeRuns runs;
  take(number, runs);
  return runs;
}

bool VisibleEdgeIndex::seesOpen(std::int64_t number) const {
  if (number < 0) return !chains_.open().empty();
  const std::uint64_t* begin = &lists_.begin[2 * static_cast<std::size_t>(number)];
  return begin[1] < begin[2];
}

std::size_t VisibleEdgeIndex::bytes() const {
  return chains_.bytes() + grid_.bytes() + lists_.squares.size() * sizeof(SquarePlace) +
         lists_.begin.size() * sizeof(std::uint64_t) + lists_.runs.size();
}

}  // namespace mrpt_polyloc
