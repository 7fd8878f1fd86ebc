#include <mrpt_polyloc/geometry/chain_simplification.h>
#include <mrpt_polyloc/geometry/vertex_bitmap.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <queue>
#include <tuple>
#include <unordered_set>
#include <utility>

namespace mrpt_polyloc {
namespace {

double squaredDistance(const LatticePoint& p, const LatticePoint& a, const LatticePoint& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double px = p.x - a.x;
  const double py = p.y - a.y;
  const double along = px * dx + py * dy;
  const double squared_length = dx * dx + dy * dy;
  if (along <= 0.0) return px * px + py * py;
  if (along >= squared_length) {
    return (px - dx) * (px - dx) + (py - dy) * (py - dy);
  }
  const double across = static_cast<double>(cross(a, b, p));
  return across * across / squared_length;
}

/// The tolerance of one chain in lattice units.
double toleranceOf(const BorderChains& borders, const BorderChain& chain, double tolerance_cells) {
  const double tolerance = tolerance_cells * kLatticePerCell;
  if (!borders.isClosed(chain)) return tolerance;
  LatticePoint low = borders.first(chain);
  LatticePoint high = low;
  for (std::size_t i = chain.begin; i < chain.end; ++i) {
    const LatticePoint& p = borders.points[i];
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return std::min(tolerance, 0.5 * std::min(high.x - low.x, high.y - low.y));
}

/// Chains with all points that a simplified border has to stay close to, and which of them are its
/// vertices so far.
struct PreparedChains {
  BorderChains borders;
  std::vector<char> is_vertex;    ///< per point
  std::vector<double> tolerance;  ///< per chain, in lattice units

  void add(const LatticePoint& point, bool vertex) {
    borders.points.push_back(point);
    is_vertex.push_back(vertex);
  }
};

/// Whether the side from point i to point i + 1 is a step of a staircase between inner points.
bool isStep(const BorderChains& borders, const BorderChain& chain, std::size_t i) {
  if (i <= chain.begin || i + 2 >= chain.end) return false;
  const LatticePoint* const p = borders.points.data() + i;
  const bool one_cell = std::abs(p[1].x - p[0].x) + std::abs(p[1].y - p[0].y) == kLatticePerCell;
  return one_cell && (cross(p[-1], p[0], p[1]) > 0) != (cross(p[0], p[1], p[2]) > 0);
}

/// Shrinks steps to their midpoints. Never changes the topology: what is cut off lies within half a
/// cell of a side, where no other border can be without touching that side.
PreparedChains shrinkSteps(const BorderChains& borders, double tolerance_cells) {
  PreparedChains prepared;
  for (BorderChain chain : borders.chains) {
    const double tolerance = toleranceOf(borders, chain, tolerance_cells);
    const bool shrink = tolerance >= 0.5 * kLatticePerCell;
    const std::size_t begin = prepared.borders.points.size();
    bool after_step = false;
    for (std::size_t i = chain.begin; i < chain.end; ++i) {
      const LatticePoint& p = borders.points[i];
      const bool before_step = shrink && isStep(borders, chain, i);
      prepared.add(p, !before_step && !after_step);
      if (before_step) {
        const LatticePoint& q = borders.points[i + 1];
        prepared.add({(p.x + q.x) / 2, (p.y + q.y) / 2}, true);
      }
      after_step = before_step;
    }
    chain.begin = begin;
    chain.end = prepared.borders.points.size();
    prepared.borders.chains.push_back(chain);
    prepared.tolerance.push_back(tolerance);
  }
  return prepared;
}

/// Chains that are one straight edge between two nodes: no second one may be laid over it.
class StraightChains {
 public:
  void insert(const LatticePoint& a, const LatticePoint& b) { keys_.insert(key(a, b)); }
  bool contains(const LatticePoint& a, const LatticePoint& b) const {
    return keys_.count(key(a, b)) != 0;
  }

 private:
  using Key = std::pair<std::uint64_t, std::uint64_t>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      return std::hash<std::uint64_t>()(key.first * 0x9E3779B97F4A7C15ULL ^ key.second);
    }
  };
  static Key key(const LatticePoint& a, const LatticePoint& b) {
    return std::minmax({latticeKey(a), latticeKey(b)});
  }

  std::unordered_set<Key, Hash> keys_;
};

/// Removes vertices chain by chain.
class Simplifier {
 public:
  Simplifier(const PreparedChains& prepared, int width, int height)
      : prepared_(prepared), vertices_(width * kLatticePerCell + 1, height * kLatticePerCell + 1) {}

  BorderChains run() {
    const BorderChains& borders = prepared_.borders;
    for (std::size_t i = 0; i < borders.points.size(); ++i) {
      if (prepared_.is_vertex[i]) vertices_.insert(borders.points[i]);
    }
    for (const BorderChain& chain : borders.chains) {
      if (chain.end - chain.begin == 2) {
        straight_.insert(borders.first(chain), borders.last(chain));
      }
    }
    BorderChains simplified;
    simplified.chains.reserve(borders.chains.size());
    for (std::size_t c = 0; c < borders.chains.size(); ++c) {
      simplify(c);
      BorderChain result = borders.chains[c];
      result.begin = simplified.points.size();
      for (std::size_t i = 0; i < size_; i = next_[i]) simplified.points.push_back(point_[i]);
      result.end = simplified.points.size();
      simplified.chains.push_back(result);
    }
    return simplified;
  }

 private:
  /// The vertex that is cheapest to remove comes first, among equals the first of the chain.
  struct Candidate {
    double cost;
    std::size_t index;
    std::uint32_t version;
    bool operator>(const Candidate& other) const {
      return std::tie(cost, index) > std::tie(other.cost, other.index);
    }
  };
  using Queue = std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>>;

  void simplify(std::size_t chain_index) {
    load(chain_index);
    if (limit_ == 0.0) return;
    Queue queue;
    for (std::size_t i = next_[0]; i + 1 < size_; i = next_[i]) offer(i, queue);
    while (!queue.empty()) {
      const Candidate candidate = queue.top();
      queue.pop();
      const std::size_t i = candidate.index;
      if (candidate.version != version_[i] || !isRemovable(i)) continue;
      remove(i);
      if (previous_[i] > 0) offer(previous_[i], queue);
      if (next_[i] + 1 < size_) offer(next_[i], queue);
    }
  }

  void load(std::size_t chain_index) {
    const BorderChain& chain = prepared_.borders.chains[chain_index];
    point_ = prepared_.borders.points.data() + chain.begin;
    size_ = chain.end - chain.begin;
    closed_ = prepared_.borders.isClosed(chain);
    limit_ = prepared_.tolerance[chain_index] * prepared_.tolerance[chain_index];
    previous_.resize(size_);
    next_.assign(size_, size_);
    version_.assign(size_, 0);
    vertex_count_ = 1;
    for (std::size_t i = 1, last = 0; i < size_; ++i) {
      if (!prepared_.is_vertex[chain.begin + i]) continue;
      previous_[i] = last;
      next_[last] = i;
      last = i;
      ++vertex_count_;
    }
  }

  void offer(std::size_t i, Queue& queue) {
    ++version_[i];
    const double cost = removalCost(i);
    if (cost <= limit_) queue.push({cost, i, version_[i]});
  }

  /// Greatest squared distance of the exact border's points from the edge that would replace them,
  /// or anything beyond the limit.
  double removalCost(std::size_t i) const {
    const LatticePoint& a = point_[previous_[i]];
    const LatticePoint& b = point_[next_[i]];
    double cost = 0.0;
    for (std::size_t k = previous_[i] + 1; k < next_[i] && cost <= limit_; ++k) {
      cost = std::max(cost, squaredDistance(point_[k], a, b));
    }
    return cost;
  }

  bool isRemovable(std::size_t i) {
    if (closed_ && vertex_count_ <= 4) return false;  // three and the first one again
    const LatticePoint& a = point_[previous_[i]];
    const LatticePoint& b = point_[next_[i]];
    const bool becomes_straight = vertex_count_ == 3;
    if (becomes_straight && straight_.contains(a, b)) return false;
    return !vertices_.hasOtherIn({a, point_[i], b});
  }

  void remove(std::size_t i) {
    vertices_.erase(point_[i]);
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    ++version_[i];
    --vertex_count_;
    if (vertex_count_ == 2) straight_.insert(point_[0], point_[size_ - 1]);
  }

  const PreparedChains& prepared_;
  VertexBitmap vertices_;
  StraightChains straight_;

  // The chain at hand: a doubly linked list of vertices among its points.
  const LatticePoint* point_ = nullptr;
  std::size_t size_ = 0;
  std::size_t vertex_count_ = 0;
  bool closed_ = false;
  double limit_ = 0.0;  ///< squared tolerance
  std::vector<std::size_t> previous_;
  std::vector<std::size_t> next_;
  std::vector<std::uint32_t> version_;
};

}  // namespace

BorderChains simplifyChains(const BorderChains& borders, int width, int height,
                            double tolerance_cells) {
  const PreparedChains prepared = shrinkSteps(borders, tolerance_cells);
  return Simplifier(prepared, width, height).run();
}

}  // namespace mrpt_polyloc
