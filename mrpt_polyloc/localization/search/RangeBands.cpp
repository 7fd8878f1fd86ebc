#include <mrpt_polyloc/base/cpu_dispatch.h>
#include <mrpt_polyloc/localization/search/RangeBands.h>
#include <mrpt_polyloc/localization/search/angular_slack.h>
#include <mrpt_polyloc/visibility/fast_atan2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mrpt_polyloc {
namespace {

constexpr int kBins = static_cast<int>(kBandBins);
/// Directions are followed along a chain without wrapping: room for one turn back, two ahead.
constexpr int kUnwrapped = 4 * kBins;
constexpr int kFirstTurn = kBins;  ///< where bin 0 of a chain's first vertex is
/// Loops over bins go in whole blocks; what is beyond the end is masked.
constexpr int kBlock = 8;
constexpr std::size_t kVertexBlock = 16;
constexpr float kUnbounded = 1e9F;  ///< an inverse range that bounds nothing [1/m]
constexpr auto kSlackF = static_cast<float>(kAngularSlack);
constexpr float kGreatest = 1e4F;  ///< inverse of the least range that is told from 0 [1/m]

using Depths = std::array<float, kUnwrapped + kBlock>;

/// The lines that bound the Minkowski difference of an edge and the leaf: with u the direction of a
/// ray, the ray enters it at an inverse range of at most the least `near` bound, and leaves it at
/// one of at least the greatest `far` bound.
struct EdgeBounds {
  float nx, ny;                  ///< normal of the edge's line, away from the leaf
  float near_n, far_n;           ///< 1 / its least and greatest distance from the leaf
  float near_x, far_x;           ///< bounds are near_x * u.x ...
  float near_y, far_y;           ///< ... and near_y * u.y; unbounded or 0 where they say nothing
  float skip_n, skip_x, skip_y;  ///< kUnbounded where the near bound says nothing
};

/// The bounds in one coordinate, given the differences' extremes in it.
POLYLOC_INLINE void boundCoordinate(float low, float high, float& near, float& far, float& skip) {
  constexpr float kLeast = 1e-6F;
  near = far = 0.0F;
  skip = kUnbounded;
  if (low > kLeast) {
    near = 1.0F / low;
    far = 1.0F / high;
    skip = 0.0F;
  } else if (high < -kLeast) {
    near = 1.0F / high;
    far = 1.0F / low;
    skip = 0.0F;
  }
}

/// A run with some edges more at both ends. Where a nearer edge ends, a chain behind it blocks a
/// bin for all of a leaf only if it goes on a little behind the nearer one, where it is not seen.
BoundaryChains::Run extended(const BoundaryChains& chains, BoundaryChains::Run run) {
  constexpr int kMore = 8;  // measured: 16 and 30 change nothing more
  for (int i = 0; i < kMore && run.first > 0 && chains.isEdge(run.first - 1); ++i) {
    --run.first;
    ++run.edges;
  }
  for (int i = 0; i < kMore && chains.isEdge(run.first + run.edges); ++i) ++run.edges;
  return run;
}

}  // namespace

struct RangeBandFinder::Workspace {
  Workspace() {
    constexpr double kSlack = kAngularSlack;
    for (std::size_t b = 0; b < first_cosines.size(); ++b) {
      const double first = static_cast<double>(b) * kBandBinWidth - kSlack;
      const double last = static_cast<double>(b + 1) * kBandBinWidth + kSlack;
      first_cosines[b] = static_cast<float>(std::cos(first));
      first_sines[b] = static_cast<float>(std::sin(first));
      last_cosines[b] = static_cast<float>(std::cos(last));
      last_sines[b] = static_cast<float>(std::sin(last));
    }
    passing.fill(kUnbounded);
  }

  Depths first_cosines, first_sines, last_cosines, last_sines;  ///< of the bins' ends
  Depths near, far;  ///< inverse: of the least, and of the greatest range
  /// Inverse ranges of the chain being followed, since it was before the bin from all of the leaf;
  /// negative where it has been past it since.
  Depths passing;
  std::vector<float> x, y;           ///< a run's vertices, relative to the leaf's middle [m]
  std::vector<float> bearing;        ///< from the middle
  std::vector<float> before, after;  ///< of the middle's bearing, by how much others differ
  std::vector<TPoint2D> leaf;        ///< relative to the middle
  float low_x = 0, high_x = 0, low_y = 0, high_y = 0;  ///< of the leaf
  /// Between which inverse ranges each edge followed may be hit, bin by bin.
  struct EdgeHit {
    int bin;
    float near, far;
  };
  std::vector<EdgeHit> hits;
  std::array<std::size_t, kBandBins + 1> first_hit;  ///< of a bin, in `sorted_hits`
  std::vector<EdgeHit> sorted_hits;

  void takeLeaf(const TPoint2D* vertices, std::size_t count, const TPoint2D& middle);
  std::size_t gather(const BoundaryChains& chains, const BoundaryChains::Run& run,
                     const TPoint2D& middle);
  void takeBearings(std::size_t count);
  bool boundEdge(std::size_t i, EdgeBounds& bounds) const;
  void raise(const EdgeBounds& bounds, int first, int last);
  void followChain(std::size_t count);
  void followStretch(std::size_t& i, std::size_t count);
  void followRuns(const BoundaryChains& chains, const BoundaryChains::Run* runs, std::size_t count,
                  const TPoint2D& middle);
  void ranges(float* low, float* high) const;
  void findGaps(RangeBands& bands);
};

void RangeBandFinder::Workspace::takeLeaf(const TPoint2D* vertices, std::size_t count,
                                          const TPoint2D& middle) {
  leaf.clear();
  low_x = low_y = kUnbounded;
  high_x = high_y = -kUnbounded;
  for (std::size_t k = 0; k < count; ++k) {
    const TPoint2D p = vertices[k] - middle;
    leaf.push_back(p);
    low_x = std::min(low_x, static_cast<float>(p.x));
    high_x = std::max(high_x, static_cast<float>(p.x));
    low_y = std::min(low_y, static_cast<float>(p.y));
    high_y = std::max(high_y, static_cast<float>(p.y));
  }
}

std::size_t RangeBandFinder::Workspace::gather(const BoundaryChains& chains,
                                               const BoundaryChains::Run& run,
                                               const TPoint2D& middle) {
  const std::size_t count = run.edges + 1;
  const std::size_t room = count + kVertexBlock;
  if (x.size() < room) {
    for (auto* column : {&x, &y, &bearing, &before, &after}) column->resize(room);
  }
  const std::int32_t origin_x = chains.fixedX(middle.x), origin_y = chains.fixedY(middle.y);
  const auto unit = static_cast<float>(chains.unit());
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = static_cast<float>(chains.x()[run.first + i] - origin_x) * unit;
    y[i] = static_cast<float>(chains.y()[run.first + i] - origin_y) * unit;
  }
  return count;
}

/// Directions of the vertices from the middle, and how far to either side of that they are seen
/// from the leaf's vertices: it is convex and no vertex lies in it, so less than half a turn.
POLYLOC_HOT_LOOP
void RangeBandFinder::Workspace::takeBearings(std::size_t count) {
  const std::size_t end = (count + kVertexBlock - 1) / kVertexBlock * kVertexBlock;
  const float* __restrict__ xs = x.data();
  const float* __restrict__ ys = y.data();
  float* __restrict__ bearings = bearing.data();
  float* __restrict__ befores = before.data();
  float* __restrict__ afters = after.data();
  for (std::size_t i = 0; i < end; ++i) {
    bearings[i] = atan2Polynomial(ys[i], xs[i]);
    befores[i] = 0.0F;
    afters[i] = 0.0F;
  }
  for (const TPoint2D& corner : leaf) {
    const auto cx = static_cast<float>(corner.x), cy = static_cast<float>(corner.y);
    for (std::size_t i = 0; i < end; ++i) {
      const float dx = xs[i] - cx, dy = ys[i] - cy;
      const float turn = atan2Polynomial(xs[i] * dy - ys[i] * dx, xs[i] * dx + ys[i] * dy);
      befores[i] = std::min(befores[i], turn);
      afters[i] = std::max(afters[i], turn);
    }
  }
}

/// False if the edge from vertex i faces no point of the leaf.
POLYLOC_INLINE bool RangeBandFinder::Workspace::boundEdge(std::size_t i, EdgeBounds& e) const {
  constexpr float kLeast = 1e-6F;
  const float ax = x[i], ay = y[i], bx = x[i + 1], by = y[i + 1];
  const float length = std::sqrt((bx - ax) * (bx - ax) + (by - ay) * (by - ay));
  if (!(length > 0.0F)) return false;
  e.nx = (by - ay) / length;
  e.ny = (ax - bx) / length;
  const float distance = e.nx * ax + e.ny * ay;
  float least = kUnbounded, greatest = -kUnbounded;
  for (const TPoint2D& corner : leaf) {
    const float d =
        distance - e.nx * static_cast<float>(corner.x) - e.ny * static_cast<float>(corner.y);
    least = std::min(least, d);
    greatest = std::max(greatest, d);
  }
  if (greatest <= kLeast) return false;
  e.near_n = least > kLeast ? 1.0F / least : 0.0F;
  e.skip_n = least > kLeast ? 0.0F : kUnbounded;
  e.far_n = 1.0F / greatest;
  boundCoordinate(std::min(ax, bx) - high_x, std::max(ax, bx) - low_x, e.near_x, e.far_x, e.skip_x);
  boundCoordinate(std::min(ay, by) - high_y, std::max(ay, by) - low_y, e.near_y, e.far_y, e.skip_y);
  return true;
}

/// Over the bins [first, last]: near depths to at least, those of the passing chain to at most what
/// the edge's bounds say, which are kept as well.
POLYLOC_INLINE void RangeBandFinder::Workspace::raise(const EdgeBounds& e, int first, int last) {
  // Within a bin a cosine exceeds those at its ends by this at most.
  const float kBulge = 1.0F / static_cast<float>(std::cos(0.5 * kBandBinWidth + kAngularSlack));
  for (int block = first; block <= last; block += kBlock) {
    const float* __restrict__ first_c = first_cosines.data() + block;
    const float* __restrict__ first_s = first_sines.data() + block;
    const float* __restrict__ last_c = last_cosines.data() + block;
    const float* __restrict__ last_s = last_sines.data() + block;
    float* __restrict__ nears = near.data() + block;
    float* __restrict__ chain = passing.data() + block;
    const int count = last - block;
    std::array<float, kBlock> enters, leaves;
    for (int k = 0; k < kBlock; ++k) {
      const float c0 = first_c[k], c1 = last_c[k], s0 = first_s[k], s1 = last_s[k];
      const float t0 = e.nx * c0 + e.ny * s0, t1 = e.nx * c1 + e.ny * s1;
      const float high = std::min(std::min(std::max(t0, t1) * e.near_n + e.skip_n,
                                           std::max(c0 * e.near_x, c1 * e.near_x) + e.skip_x),
                                  std::max(s0 * e.near_y, s1 * e.near_y) + e.skip_y);
      const float low =
          std::max(std::max(std::min(t0, t1) * e.far_n, std::min(c0 * e.far_x, c1 * e.far_x)),
                   std::max(std::min(s0 * e.far_y, s1 * e.far_y), 0.0F));
      enters[static_cast<std::size_t>(k)] = high * kBulge;
      leaves[static_cast<std::size_t>(k)] = low;
      const float entered = std::max(nears[k], high * kBulge);
      const float left = std::min(chain[k], low);
      nears[k] = k <= count ? entered : nears[k];
      chain[k] = k <= count ? left : chain[k];
    }
    for (int k = 0; k < kBlock && k <= count; ++k) {
      hits.push_back({(block + k) % kBins, enters[static_cast<std::size_t>(k)],
                      leaves[static_cast<std::size_t>(k)]});
    }
  }
}

/// Follows a chain from vertex i on, until its end or until it has turned too far around the leaf;
/// i is then where it is to be taken up again.
POLYLOC_HOT_LOOP
void RangeBandFinder::Workspace::followStretch(std::size_t& i, std::size_t count) {
  constexpr auto kPerRadian = static_cast<float>(1.0 / kBandBinWidth);
  const auto binOf = [](float angle) { return static_cast<int>(std::floor(angle * kPerRadian)); };
  constexpr auto kTurn = static_cast<float>(kTwoPi);
  const auto kStart = static_cast<float>(kFirstTurn * kBandBinWidth);
  // Whole turns are added to the bearings, so that rounding does not add up along a chain.
  float turns = (bearing[i] < 0.0F ? kTurn : 0.0F) + kStart;
  float angle = bearing[i] + turns;
  int reset_from = binOf(angle + after[i] + kSlackF) + 1;
  int past_to = reset_from;  // bins below are behind the chain, or never were before it
  int touched_first = kUnwrapped, touched_last = -1;
  for (; i + 1 < count; ++i) {
    const float turn = bearing[i + 1] - bearing[i];
    const float wrap = turn < -kPiF ? kTurn : turn >= kPiF ? -kTurn : 0.0F;
    const float next = bearing[i + 1] + (turns + wrap);
    const float low = std::min(angle + before[i], next + before[i + 1]) - kSlackF;
    const float high = std::max(angle + after[i], next + after[i + 1]) + kSlackF;
    const int first = binOf(low), last = binOf(high);
    if (first < 0 || last + kBlock >= kUnwrapped) break;
    EdgeBounds bounds;
    if (boundEdge(i, bounds)) {
      // Bins the chain was not before count as passed: they are not raised by it.
      raise(bounds, first, last);
      touched_first = std::min(touched_first, first);
      touched_last = std::max(touched_last, last);
    }
    angle = next;
    turns += wrap;
    // The chain is past a bin if it is from all of the leaf: then the stretch blocked it.
    const int past_end = binOf(angle + before[i + 1] - kSlackF);
    for (int b = past_to; b < past_end; ++b) {
      const auto k = static_cast<std::size_t>(b);
      far[k] = std::max(far[k], passing[k] < kUnbounded ? passing[k] : 0.0F);
    }
    past_to = std::max(past_to, past_end);
    // And before a bin again, or still: a new stretch begins here.
    reset_from = binOf(angle + after[i + 1] + kSlackF) + 1;
    for (int b = std::max(reset_from, 0); b <= touched_last; ++b) {
      passing[static_cast<std::size_t>(b)] = kUnbounded;
    }
    touched_last = std::min(touched_last, reset_from - 1);
    past_to = std::min(past_to, reset_from);
  }
  for (int b = touched_first; b <= touched_last; ++b) {
    passing[static_cast<std::size_t>(b)] = kUnbounded;
  }
}

void RangeBandFinder::Workspace::followChain(std::size_t count) {
  for (std::size_t i = 0; i + 1 < count;) {
    const std::size_t begin = i;
    followStretch(i, count);
    if (i == begin) ++i;  // an edge that spans too much by itself cannot be, but must not hang
  }
}

void RangeBandFinder::Workspace::followRuns(const BoundaryChains& chains,
                                            const BoundaryChains::Run* runs, std::size_t count,
                                            const TPoint2D& middle) {
  near.fill(0.0F);
  far.fill(0.0F);
  for (std::size_t r = 0; r < count; ++r) {
    BoundaryChains::Run run = extended(chains, runs[r]);
    while (r + 1 < count) {
      const BoundaryChains::Run next = extended(chains, runs[r + 1]);
      if (next.first > run.first + run.edges) break;
      run.edges = std::max(run.edges, next.first + next.edges - run.first);
      ++r;
    }
    const std::size_t vertices = gather(chains, run, middle);
    takeBearings(vertices);
    followChain(vertices);
  }
}

/// Brings the turns together.
void RangeBandFinder::Workspace::ranges(float* low, float* high) const {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (std::size_t b = 0; b < kBandBins; ++b) {
    float nearest = 0.0F, farthest = 0.0F;
    for (std::size_t turn = b; turn < static_cast<std::size_t>(kUnwrapped); turn += kBandBins) {
      nearest = std::max(nearest, near[turn]);
      farthest = std::max(farthest, far[turn]);
    }
    low[b] = nearest >= kGreatest ? 0.0F : nearest > 0.0F ? 1.0F / nearest : kInfinity;
    high[b] = farthest > 0.0F ? 1.0F / farthest : kInfinity;
  }
}

/// Given the ranges, and the hits of walls and open edges.
void RangeBandFinder::Workspace::findGaps(RangeBands& bands) {
  first_hit.fill(0);
  for (const EdgeHit& hit : hits) ++first_hit[static_cast<std::size_t>(hit.bin) + 1];
  for (std::size_t b = 0; b < kBandBins; ++b) first_hit[b + 1] += first_hit[b];
  sorted_hits.resize(hits.size());
  auto next = first_hit;
  for (const EdgeHit& hit : hits) sorted_hits[next[static_cast<std::size_t>(hit.bin)]++] = hit;
  for (std::size_t b = 0; b < kBandBins; ++b) {
    const auto begin = sorted_hits.begin() + static_cast<std::ptrdiff_t>(first_hit[b]);
    const auto end = sorted_hits.begin() + static_cast<std::ptrdiff_t>(first_hit[b + 1]);
    std::sort(begin, end, [](const EdgeHit& a, const EdgeHit& c) { return a.near > c.near; });
    const float farthest = bands.wall_high[b];
    float reached = std::min(bands.wall_low[b], bands.open_low[b]);
    float low = 0.0F, high = 0.0F;
    for (auto hit = begin; hit != end; ++hit) {
      if (!(hit->near > 0.0F)) break;  // never met in this bin
      const float from = hit->near >= kGreatest ? 0.0F : 1.0F / hit->near;
      if (from > farthest) break;
      if (from - reached > high - low) {
        low = reached;
        high = from;
      }
      reached = std::max(reached, 1.0F / std::max(hit->far, 1.0F / kUnbounded));
    }
    bands.gap_low[b] = low;
    bands.gap_high[b] = high;
  }
}

RangeBandFinder::RangeBandFinder(const VisibleEdgeIndex& index)
    : index_(&index), workspace_(std::make_unique<Workspace>()) {}
RangeBandFinder::~RangeBandFinder() = default;

void RangeBandFinder::find(const TPoint2D* leaf, std::size_t count, RangeBands& bands) {
  TPoint2D middle{0, 0};
  for (std::size_t k = 0; k < count; ++k) middle += leaf[k] * (1.0 / static_cast<double>(count));
  const BoundaryChains& chains = index_->chains();
  Workspace& w = *workspace_;
  w.takeLeaf(leaf, count, middle);
  VisibleEdgeIndex::EdgeRuns seen{chains.walls().data(), chains.walls().size(),
                                  chains.open().data(), chains.open().size()};
  const std::int64_t number = index_->squareNumber(middle);
  if (number >= 0) seen = index_->edgeRuns(number);
  w.hits.clear();
  w.followRuns(chains, seen.walls, seen.wall_runs, middle);
  w.ranges(bands.wall_low.data(), bands.wall_high.data());
  bands.has_open = seen.open_runs > 0;
  if (bands.has_open) {
    w.followRuns(chains, seen.open, seen.open_runs, middle);
    w.ranges(bands.open_low.data(), bands.open_high.data());
  } else {
    bands.open_low.fill(std::numeric_limits<float>::infinity());
    bands.open_high.fill(std::numeric_limits<float>::infinity());
  }
  w.findGaps(bands);
}

}  // namespace mrpt_polyloc
