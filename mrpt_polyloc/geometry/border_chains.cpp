#include <mrpt_polyloc/geometry/border_chains.h>

#include <algorithm>
#include <array>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// Directions are counted counterclockwise: 0 = +x, 1 = +y, 2 = -x, 3 = -y.
constexpr int kDirections = 4;
constexpr std::array<int, kDirections> kStepX{1, 0, -1, 0};
constexpr std::array<int, kDirections> kStepY{0, 1, 0, -1};

/// Corner (x, y) of the grid is the lower left one of cell (x, y).
struct Corner {
  int x;
  int y;

  LatticePoint point() const { return {x * kLatticePerCell, y * kLatticePerCell}; }
  Corner next(int direction) const {
    return {x + kStepX[static_cast<std::size_t>(direction)],
            y + kStepY[static_cast<std::size_t>(direction)]};
  }
};
bool operator==(const Corner& a, const Corner& b) {
  return a.x == b.x && a.y == b.y;
}

int opposite(int direction) {
  return (direction + 2) % kDirections;
}

/// The cells around a corner, counterclockwise from the upper right one. The side in direction d
/// has cell[d] to its left and cell[d - 1] to its right.
struct Surroundings {
  std::array<std::int32_t, kDirections> cell;

  std::int32_t left(int direction) const { return cell[static_cast<std::size_t>(direction)]; }
  std::int32_t right(int direction) const {
    return cell[static_cast<std::size_t>((direction + 3) % kDirections)];
  }
  bool hasSide(int direction) const { return left(direction) != right(direction); }
  int degree() const {
    int count = 0;
    for (int d = 0; d < kDirections; ++d) count += hasSide(d);
    return count;
  }
};

class Tracer {
 public:
  explicit Tracer(const RegionGrid& grid)
      : grid_(grid),
        columns_(static_cast<std::size_t>(grid.width()) + 1),
        traced_{std::vector<bool>(columns_ * rows()), std::vector<bool>(columns_ * rows())} {}

  BorderChains trace() {
    forEachBorderCorner([this](const Corner& corner, const Surroundings& around) {
      if (around.degree() <= 2) return;
      for (int d = 0; d < kDirections; ++d) {
        if (around.hasSide(d) && !isTraced(corner, d)) follow(corner, d);
      }
    });
    // What is left are free-standing loops; the first corner met lies at the lower left.
    forEachBorderCorner([this](const Corner& corner, const Surroundings& around) {
      if (around.hasSide(0) && around.hasSide(1) && !isTraced(corner, 0)) follow(corner, 0);
    });
    return std::move(borders_);
  }

 private:
  std::size_t rows() const { return static_cast<std::size_t>(grid_.height()) + 1; }

  Surroundings around(const Corner& c) const {
    const std::int32_t* const above = grid_.row(c.y) + c.x;
    const std::int32_t* const below = grid_.row(c.y - 1) + c.x;
    return {{above[0], above[-1], below[-1], below[0]}};
  }

  template <class Visitor>
  void forEachBorderCorner(Visitor&& visit) const {
    for (int y = 0; y <= grid_.height(); ++y) {
      const std::int32_t* const above = grid_.row(y);
      const std::int32_t* const below = grid_.row(y - 1);
      for (int x = 0; x <= grid_.width(); ++x) {
        const std::int32_t region = above[x];
        if (region == above[x - 1] && region == below[x] && region == below[x - 1]) continue;
        visit(Corner{x, y}, Surroundings{{region, above[x - 1], below[x - 1], below[x]}});
      }
    }
  }

  /// A side is named by its lower or left corner and whether it is vertical.
  std::vector<bool>::reference traced(Corner corner, int direction) {
    if (direction >= 2) corner = corner.next(direction);
    return traced_[static_cast<std::size_t>(direction % 2)]
                  [static_cast<std::size_t>(corner.y) * columns_ +
                   static_cast<std::size_t>(corner.x)];
  }
  bool isTraced(const Corner& corner, int direction) { return traced(corner, direction); }

  void follow(const Corner& start, int direction) {
    const Surroundings at_start = around(start);
    BorderChain chain{borders_.points.size(), 0, at_start.left(direction),
                      at_start.right(direction)};
    borders_.points.push_back(start.point());
    Corner corner = start;
    while (true) {
      traced(corner, direction) = true;
      corner = corner.next(direction);
      const Surroundings here = around(corner);
      if (corner == start || here.degree() != 2) break;
      const int turn = nextDirection(here, direction);
      if (turn != direction) borders_.points.push_back(corner.point());
      direction = turn;
    }
    borders_.points.push_back(corner.point());
    chain.end = borders_.points.size();
    if (chain.right >= 0) {
      std::reverse(borders_.points.begin() + static_cast<std::ptrdiff_t>(chain.begin),
                   borders_.points.end());
      std::swap(chain.left, chain.right);
    }
    borders_.chains.push_back(chain);
  }

  static int nextDirection(const Surroundings& here, int direction) {
    for (int d = 0; d < kDirections; ++d) {
      if (d != opposite(direction) && here.hasSide(d)) return d;
    }
    return direction;
  }

  const RegionGrid& grid_;
  std::size_t columns_;
  std::array<std::vector<bool>, 2> traced_;
  BorderChains borders_;
};

}  // namespace

BorderChains traceBorders(const RegionGrid& grid) {
  return Tracer(grid).trace();
}

}  // namespace mrpt_polyloc
