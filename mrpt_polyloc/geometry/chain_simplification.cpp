#include <mrpt_polyloc/geometry/chain_simplification.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <unordered_set>

namespace mrpt_polyloc {
namespace {

std::int64_t floorDivide(std::int64_t a, std::int64_t b) {
  const std::int64_t quotient = a / b;
  return quotient - (a % b != 0 && (a < 0) != (b < 0));
}

double squaredDistance(const Corner& p, const Corner& a, const Corner& b) {
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

/// One bit per corner of the bitmap: whether a chain has a vertex there now.
class VertexBitmap {
 public:
  VertexBitmap(int width, int height)
      : words_per_row_(static_cast<std::size_t>(width) / 64 + 1),
        words_(words_per_row_ * (static_cast<std::size_t>(height) + 1), 0) {}

  void set(const Corner& c) { word(c) |= bit(c); }
  void clear(const Corner& c) { word(c) &= ~bit(c); }

  /// Whether a vertex lies in the closed triangle, its own corners aside.
  bool hasOtherVertexIn(const std::array<Corner, 3>& triangle) {
    for (const Corner& c : triangle) clear(c);
    const bool found = hasVertexIn(triangle);
    for (const Corner& c : triangle) set(c);
    return found;
  }

 private:
  static std::uint64_t bit(const Corner& c) { return std::uint64_t{1} << (c.x % 64); }
  std::uint64_t& word(const Corner& c) {
    return words_[static_cast<std::size_t>(c.y) * words_per_row_ +
                  static_cast<std::size_t>(c.x) / 64];
  }

  bool hasVertexIn(const std::array<Corner, 3>& t) const {
    const auto [low, high] = std::minmax({t[0].y, t[1].y, t[2].y});
    for (std::int32_t y = low; y <= high; ++y) {
      std::int64_t from = std::numeric_limits<std::int64_t>::max();
      std::int64_t to = std::numeric_limits<std::int64_t>::min();
      for (std::size_t i = 0; i < 3; ++i) {
        Corner a = t[i];
        Corner b = t[(i + 1) % 3];
        if (a.y > b.y) std::swap(a, b);
        if (y < a.y || y > b.y || a.y == b.y) continue;
        const std::int64_t rise = b.y - a.y;
        const std::int64_t run = static_cast<std::int64_t>(b.x - a.x) * (y - a.y);
        from = std::min(from, a.x - floorDivide(-run, rise));
        to = std::max(to, a.x + floorDivide(run, rise));
      }
      if (from <= to && hasVertexInRow(y, from, to)) return true;
    }
    return false;
  }

  bool hasVertexInRow(std::int32_t y, std::int64_t from, std::int64_t to) const {
    const std::uint64_t* const row = words_.data() + static_cast<std::size_t>(y) * words_per_row_;
    const std::int64_t first = from / 64;
    const std::int64_t last = to / 64;
    for (std::int64_t i = first; i <= last; ++i) {
      std::uint64_t bits = row[i];
      if (i == first) bits &= ~std::uint64_t{0} << (from % 64);
      if (i == last) bits &= ~std::uint64_t{0} >> (63 - to % 64);
      if (bits != 0) return true;
    }
    return false;
  }

  std::size_t words_per_row_;
  std::vector<std::uint64_t> words_;
};

/// Chains that are one straight edge between two nodes: no second one may be laid over it.
class StraightChains {
 public:
  explicit StraightChains(int width) : columns_(static_cast<std::uint64_t>(width) + 1) {}

  void insert(const Corner& a, const Corner& b) { keys_.insert(key(a, b)); }
  bool contains(const Corner& a, const Corner& b) const { return keys_.count(key(a, b)) != 0; }

 private:
  std::uint64_t id(const Corner& c) const {
    return static_cast<std::uint64_t>(c.y) * columns_ + static_cast<std::uint64_t>(c.x);
  }
  std::uint64_t key(const Corner& a, const Corner& b) const {
    const auto [low, high] = std::minmax({id(a), id(b)});  // by value
    return low << 32 | high;
  }

  std::uint64_t columns_;
  std::unordered_set<std::uint64_t> keys_;
};

class Simplifier {
 public:
  Simplifier(const BorderChains& borders, int width, int height, double tolerance)
      : borders_(borders), tolerance_(tolerance), vertices_(width, height), straight_(width) {}

  BorderChains run() {
    for (const Corner& corner : borders_.corners) vertices_.set(corner);
    for (const BorderChain& chain : borders_.chains) {
      if (chain.end - chain.begin == 2)
        straight_.insert(borders_.first(chain), borders_.last(chain));
    }
    BorderChains simplified;
    simplified.chains.reserve(borders_.chains.size());
    for (const BorderChain& chain : borders_.chains) {
      simplify(chain);
      BorderChain result = chain;
      result.begin = simplified.corners.size();
      for (std::size_t i = 0; i < size_; i = next_[i]) simplified.corners.push_back(corner_[i]);
      result.end = simplified.corners.size();
      simplified.chains.push_back(result);
    }
    return simplified;
  }

 private:
  /// The corner that is cheapest to remove comes first, among equals the first of the chain.
  struct Candidate {
    double cost;
    std::size_t index;
    std::uint32_t version;
    bool operator>(const Candidate& other) const {
      return std::tie(cost, index) > std::tie(other.cost, other.index);
    }
  };
  using Queue = std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>>;

  void simplify(const BorderChain& chain) {
    corner_ = borders_.corners.data() + chain.begin;
    size_ = chain.end - chain.begin;
    closed_ = borders_.isClosed(chain);
    left_ = size_;
    previous_.resize(size_);
    next_.resize(size_);
    version_.assign(size_, 0);
    for (std::size_t i = 0; i < size_; ++i) {
      previous_[i] = i - 1;
      next_[i] = i + 1;
    }
    const double tolerance = chainTolerance();
    limit_ = tolerance * tolerance;
    if (limit_ == 0.0) return;
    Queue queue;
    for (std::size_t i = 1; i + 1 < size_; ++i) offer(i, queue);
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

  double chainTolerance() const {
    if (!closed_) return tolerance_;
    const auto [left, right] = std::minmax_element(
        corner_, corner_ + size_, [](const Corner& a, const Corner& b) { return a.x < b.x; });
    const auto [low, high] = std::minmax_element(
        corner_, corner_ + size_, [](const Corner& a, const Corner& b) { return a.y < b.y; });
    return std::min(tolerance_, 0.5 * std::min(right->x - left->x, high->y - low->y));
  }

  void offer(std::size_t i, Queue& queue) {
    ++version_[i];
    const double cost = removalCost(i);
    if (cost <= limit_) queue.push({cost, i, version_[i]});
  }

  /// Greatest squared distance of the original corners from the edge that would replace them, or
  /// anything beyond the limit.
  double removalCost(std::size_t i) const {
    const Corner& a = corner_[previous_[i]];
    const Corner& b = corner_[next_[i]];
    double cost = 0.0;
    for (std::size_t k = previous_[i] + 1; k < next_[i] && cost <= limit_; ++k) {
      cost = std::max(cost, squaredDistance(corner_[k], a, b));
    }
    return cost;
  }

  bool isRemovable(std::size_t i) {
    if (closed_ && left_ <= 4) return false;  // three corners and the first one again
    const Corner& a = corner_[previous_[i]];
    const Corner& b = corner_[next_[i]];
    const bool becomes_straight = previous_[i] == 0 && next_[i] == size_ - 1;
    if (becomes_straight && straight_.contains(a, b)) return false;
    return !vertices_.hasOtherVertexIn({a, corner_[i], b});
  }

  void remove(std::size_t i) {
    vertices_.clear(corner_[i]);
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    ++version_[i];
    --left_;
    if (left_ == 2) straight_.insert(corner_[0], corner_[size_ - 1]);
  }

  const BorderChains& borders_;
  const double tolerance_;
  VertexBitmap vertices_;
  StraightChains straight_;

  // The chain at hand: a doubly linked list over its corners.
  const Corner* corner_ = nullptr;
  std::size_t size_ = 0;
  std::size_t left_ = 0;  ///< corners not removed
  bool closed_ = false;
  double limit_ = 0.0;  ///< squared tolerance
  std::vector<std::size_t> previous_;
  std::vector<std::size_t> next_;
  std::vector<std::uint32_t> version_;
};

}  // namespace

BorderChains simplifyChains(const BorderChains& borders, int width, int height, double tolerance) {
  return Simplifier(borders, width, height, tolerance).run();
}

}  // namespace mrpt_polyloc
