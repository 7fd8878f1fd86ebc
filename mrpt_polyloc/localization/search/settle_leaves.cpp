#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/search/bound_costs.h>
#include <mrpt_polyloc/localization/search/settle_leaves.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

constexpr auto kWindow = static_cast<std::int64_t>(SearchTree::kWindow[0]);
constexpr std::int64_t kWindows = static_cast<std::int64_t>(kBandBins) / kWindow;

/// A point of the grid of leaves and windows.
struct Cell {
  std::int64_t column, row, window;

  std::int64_t key() const {
    constexpr std::int64_t kRows = std::int64_t{1} << 28, kRoom = 128;
    return (column * kRows + row) * kRoom + window;
  }
  Cell beside(std::int64_t columns, std::int64_t rows, std::int64_t windows) const {
    return {column + columns, row + rows, (window + windows + kWindows) % kWindows};
  }
};

/// Where a cell's point is, by its key: open addressing, for most cells that are asked for are not
/// there.
class CellTable {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// The number kept with the key, kNone if it is not there.
  std::uint32_t find(std::int64_t key) const {
    if (slots_.empty()) return kNone;
    for (std::size_t i = slotOf(key);; i = (i + 1) & (slots_.size() - 1)) {
      if (slots_[i].number == kNone || slots_[i].key == key) return slots_[i].number;
    }
  }
  /// A key that is not there.
  void insert(std::int64_t key, std::uint32_t number) {
    constexpr std::size_t kLeastSlots = 256;
    if (2 * (size_ + 1) > slots_.size()) {
      std::vector<Slot> before(std::max(kLeastSlots, 2 * slots_.size()));
      before.swap(slots_);
      for (const Slot& slot : before) {
        if (slot.number != kNone) place(slot);
      }
    }
    place({key, number});
    ++size_;
  }

 private:
  struct Slot {
    std::int64_t key = 0;
    std::uint32_t number = kNone;
  };
  std::size_t slotOf(std::int64_t key) const {
    constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15U;
    return ((static_cast<std::uint64_t>(key) * kGolden) >> 32) & (slots_.size() - 1);
  }
  void place(const Slot& slot) {
    std::size_t i = slotOf(slot.key);
    while (slots_[i].number != kNone) i = (i + 1) & (slots_.size() - 1);
    slots_[i] = slot;
  }

  std::vector<Slot> slots_;  ///< a power of two, at most half of them taken
  std::size_t size_ = 0;
};

/// The leaves within reach, as basins of their costs.
class Basins {
 public:
  explicit Basins(SeedPoses& leaves) : leaves_(leaves) {}

  void add(std::size_t leaf) {
    const TPoint2D middle = leaves_.middle(leaf);
    const double size = leaves_.leafSize();
    const Cell cell{static_cast<std::int64_t>(std::floor(middle.x / size)),
                    static_cast<std::int64_t>(std::floor(middle.y / size)),
                    static_cast<std::int64_t>(leaves_.leaves()[leaf].heading) / kWindow};
    const std::uint32_t found = points_.find(cell.key());
    if (found == CellTable::kNone) {
      points_.insert(cell.key(), static_cast<std::uint32_t>(order_.size()));
      order_.push_back({cell, leaf, 1, 0});
    } else {
      Point& point = order_[found];
      ++point.leaves;
      if (isCheaper(leaf, point.leaf)) point.leaf = leaf;
    }
  }

  /// A bottom, cheapest first, and how many leaves lead to it, itself included.
  struct Basin {
    std::size_t leaf, leaves;
  };
  std::vector<Basin> find(const Budget& budget) {
    std::vector<std::size_t> downhill(order_.size());
    constexpr std::size_t kLeastInARow = 64;
    budget.forEach(order_.size(), kLeastInARow,
                   [&](std::size_t i) { downhill[i] = cheapestNeighbour(i); });
    std::vector<std::size_t> by_cost(order_.size());
    for (std::size_t i = 0; i < by_cost.size(); ++i) by_cost[i] = i;
    std::sort(by_cost.begin(), by_cost.end(), [this](std::size_t a, std::size_t b) {
      return isCheaper(order_[a].leaf, order_[b].leaf);
    });
    std::vector<Basin> basins;
    std::vector<std::size_t> bottoms;
    for (const std::size_t i : by_cost) {
      const std::size_t next = downhill[i];
      order_[i].basin = order_[next].basin;  // known, for it is cheaper
      if (next == i || isFarAndLevel(i, bottoms[order_[i].basin])) {
        order_[i].basin = basins.size();
        basins.push_back({order_[i].leaf, 0});
        bottoms.push_back(i);
      }
      basins[order_[i].basin].leaves += order_[i].leaves;
    }
    return basins;
  }

 private:
  struct Point {
    Cell cell;
    std::size_t leaf;    ///< the cheapest there
    std::size_t leaves;  ///< that are there: a square that a border crosses has several
    std::size_t basin;
  };

  /// A total order, so that ways down end.
  bool isCheaper(std::size_t a, std::size_t b) const {
    const float cost_a = leaves_.cost(a), cost_b = leaves_.cost(b);
    return cost_a < cost_b || (cost_a == cost_b && a < b);
  }

  /// Along a corridor all is level: its poses are as good as the bottom, but far from it, so that
  /// one of each metre is taken for a bottom of its own.
  bool isFarAndLevel(std::size_t i, std::size_t bottom) const {
    constexpr double kFar = 1.0, kLevel = 0.03;  // [m]
    const Point &point = order_[i], &other = order_[bottom];
    const auto cells = std::max(std::abs(point.cell.column - other.cell.column),
                                std::abs(point.cell.row - other.cell.row));
    return static_cast<double>(cells) * leaves_.leafSize() >= kFar &&
           static_cast<double>(leaves_.cost(point.leaf) - leaves_.cost(other.leaf)) <= kLevel;
  }

  std::size_t cheapestNeighbour(std::size_t i) const {
    std::size_t best = i;
    for (std::int64_t columns = -1; columns <= 1; ++columns) {
      for (std::int64_t rows = -1; rows <= 1; ++rows) {
        for (std::int64_t windows = -1; windows <= 1; ++windows) {
          const std::uint32_t found =
              points_.find(order_[i].cell.beside(columns, rows, windows).key());
          if (found == CellTable::kNone) continue;
          if (isCheaper(order_[found].leaf, order_[best].leaf)) best = found;
        }
      }
    }
    return best;
  }

  SeedPoses& leaves_;
  CellTable points_;
  std::vector<Point> order_;
};

/// Nearly the same optimum.
bool isNear(const TPose2D& a, const TPose2D& b) {
  constexpr double kNear = 0.05, kNearHeading = 0.02;  // [m], [rad]
  return std::hypot(a.x - b.x, a.y - b.y) < kNear && angleBetween(a.phi, b.phi) < kNearHeading;
}

/// A leaf's bound by the bins of its window: never less than its own.
unsigned boundByBins(const SeedPoses& leaves, std::size_t leaf, const BandQuery& query) {
  static_assert(kWindow == 2, "windows of leaves are of two bins");
  const std::uint32_t first = leaves.leaves()[leaf].heading;
  const std::uint32_t headings[] = {first, first + 1};
  unsigned bounds[] = {0, 0};
  boundCostsOfBins(leaves.bands(leaf), query, headings, 2, bounds);
  return std::min(bounds[0], bounds[1]);
}

}  // namespace

SettledLeaves settleLeaves(SeedPoses& leaves, unsigned limit, double least, const BandQuery& query,
                           const PoseScorer& scorer, const Budget& budget,
                           const CertifiedSearchParams& params) {
  SettledLeaves result;
  const unsigned least_units =
      std::isfinite(least) ? query.units(least) : std::numeric_limits<unsigned>::max();
  const double reach =
      leaves.areFew(params.max_candidates) ? std::numeric_limits<double>::infinity() : params.reach;
  const auto within_reach = static_cast<float>(least + reach);
  enum class Fate : char { outside, bounded, distant, left };
  const auto fate_of = [&](std::size_t i) {
    const unsigned bound = leaves.leaves()[i].bound;
    if (bound > limit) return Fate::outside;
    if (bound > least_units) return Fate::bounded;
    if (leaves.costIfWorthwhile(i, within_reach) > within_reach) return Fate::distant;
    return boundByBins(leaves, i, query) > least_units ? Fate::bounded : Fate::left;
  };
  constexpr std::size_t kLeastInARow = 256;
  std::vector<Fate> fates(leaves.leaves().size());
  budget.forEach(fates.size(), kLeastInARow, [&](std::size_t i) { fates[i] = fate_of(i); });
  Basins basins(leaves);
  for (std::size_t i = 0; i < fates.size(); ++i) {
    if (fates[i] == Fate::bounded) ++result.counts.bounded;
    if (fates[i] == Fate::distant) ++result.counts.distant;
    if (fates[i] == Fate::left) basins.add(i);
  }

  // Where some steps end, what is left to the optimum is less than this [m]: beside racks 0.06 in
  // 99 of 100 cases.
  constexpr double kLastSteps = 0.12;
  const double most_cost = query.meters(limit);
  const std::vector<Basins::Basin> found = basins.find(budget);
  struct Lowered {
    bool is_decided = false;
    std::optional<ScoredPose> optimum;
  };
  std::vector<Lowered> lowered(std::min(found.size(), params.max_lowered));
  budget.forEach(lowered.size(), 1, [&](std::size_t i) {
    if (budget.isSpent()) return;
    lowered[i] = {true, scorer.nearOptimum(leaves.pose(found[i].leaf), most_cost + kLastSteps)};
  });
  lowered.resize(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!lowered[i].is_decided) {
      result.counts.undecided += found[i].leaves;
      continue;
    }
    ++result.counts.lowered;
    result.counts.drained += found[i].leaves - 1;
    const std::optional<ScoredPose>& optimum = lowered[i].optimum;
    if (!optimum || optimum->cost > most_cost) continue;
    const TPose2D& pose = optimum->refined.pose_map_beams;
    const bool is_known = std::any_of(
        result.optima.begin(), result.optima.end(),
        [&pose](const PoseCandidate& other) { return isNear(pose, other.pose_map_beams); });
    if (!is_known) result.optima.push_back({pose, optimum->cost});
  }
  std::stable_sort(result.optima.begin(), result.optima.end(),
                   [](const PoseCandidate& a, const PoseCandidate& b) { return a.cost < b.cost; });
  return result;
}

}  // namespace mrpt_polyloc
