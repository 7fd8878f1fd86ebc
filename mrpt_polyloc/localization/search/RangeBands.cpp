#include <mrpt_polyloc/base/cpu_dispatch.h>
#include <mrpt_polyloc/localization/search/RangeBands.h>
#include <mrpt_polyloc/localization/search/angular_slack.h>
#include <mrpt_polyloc/visibility/fast_atan2.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
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

/// Of each edge of a run, in columns: the lines that bound the Minkowski difference of it and the
/// leaf. With u the direction of a ray, the ray enters it at an inverse range of at most the least
/// `near` bound, and leaves it at one of at least the greatest `far` bound.
struct EdgeColumns {
  std::vector<float> nx, ny;                  ///< normal of the edge's line, away from the leaf
  std::vector<float> near_n, far_n;           ///< 1 / its least and greatest distance from the leaf
  std::vector<float> near_x, far_x;           ///< bounds are near_x * u.x ...
  std::vector<float> near_y, far_y;           ///< ... and near_y * u.y; 0 where they say nothing
  std::vector<float> skip_n, skip_x, skip_y;  ///< kUnbounded where the near bound says nothing
  std::vector<std::int32_t> faces;            ///< whether the edge faces some point of the leaf
  /// Bins, counted from the turn in which its first vertex is seen: those that the edge may be seen
  /// in from the leaf, whether its second vertex is a turn on or back, up to where that is past a
  /// bin from all of the leaf, and from where on it is before one.
  std::vector<std::int32_t> first, last, turn, past, before;

  void resize(std::size_t count) {
    for (auto* column :
         {&nx, &ny, &near_n, &far_n, &near_x, &far_x, &near_y, &far_y, &skip_n, &skip_x, &skip_y}) {
      column->resize(count);
    }
    for (auto* column : {&faces, &first, &last, &turn, &past, &before}) column->resize(count);
  }
};

/// The bounds in one coordinate, given the differences' extremes in it.
POLYLOC_INLINE void boundCoordinate(float low, float high, float& near, float& far, float& skip) {
  constexpr float kLeast = 1e-6F;
  const bool is_above = low > kLeast, is_below = high < -kLeast;
  const float of_low = 1.0F / low, of_high = 1.0F / high;
  near = is_above ? of_low : is_below ? of_high : 0.0F;
  far = is_above ? of_high : is_below ? of_low : 0.0F;
  skip = is_above || is_below ? 0.0F : kUnbounded;
}

constexpr std::size_t wholeBlocks(std::size_t count) {
  return (count + kVertexBlock - 1) / kVertexBlock * kVertexBlock;
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
    joined_near.fill(0.0F);
    joined_far.fill(0.0F);
  }

  Depths first_cosines, first_sines, last_cosines, last_sines;  ///< of the bins' ends
  Depths near, far;  ///< inverse: of the least, and of the greatest range
  /// Inverse ranges of the chain being followed, since it was before the bin from all of the leaf;
  /// negative where it has been past it since.
  Depths passing;
  /// A run: its vertices in the layout from `first` on are begin to end - 1 in the columns.
  struct Stretch {
    std::size_t first, begin, end;
  };
  std::vector<Stretch> stretches;
  std::vector<float> x, y;           ///< the runs' vertices, relative to the leaf's middle [m]
  std::vector<float> bearing;        ///< from the middle
  std::vector<float> before, after;  ///< of the middle's bearing, by how much others differ
  EdgeColumns edges;                 ///< of the run
  std::vector<TPoint2D> leaf;        ///< relative to the middle
  float low_x = 0, high_x = 0, low_y = 0, high_y = 0;  ///< of the leaf
  /// Between which inverse ranges edges followed may be hit, bin by bin: of edges one after another
  /// that meet in a bin, as of a wall's pieces, what they reach together.
  struct Hits {
    int bin;
    float near, far;
  };
  std::vector<Hits> hits;
  Depths joined_near, joined_far;                    ///< of those not yet in `hits`; near 0: none
  std::array<std::size_t, kBandBins + 1> first_hit;  ///< of a bin, in `sorted_hits`
  std::vector<Hits> sorted_hits;

  /// Where edges are looked through, not the leaf bounded: which may be met how near.
  struct Sighting {
    std::uint32_t edge;  ///< in the layout
    int bin;
    float near;
  };
  std::vector<Sighting> sightings;
  std::vector<std::uint32_t> kept;
  std::uint32_t to_layout = 0;  ///< from a number in the columns, modulo 2^32
  VisibleEdgeIndex::EdgeRuns listed;
  std::vector<BoundaryChains::Run> narrowed_walls, narrowed_open;
  BoundingBox narrowed = BoundingBox::empty();  ///< what these are seen from

  void takeLeaf(const TPoint2D* vertices, std::size_t count, const TPoint2D& middle);
  enum class Ends { as_listed, extended };
  std::size_t gather(const BoundaryChains& chains, const std::vector<BoundaryChains::Run>& runs,
                     const TPoint2D& middle, Ends ends);
  void takeBearings(std::size_t count);
  void boundEdges(std::size_t count);
  void takeBins(std::size_t count);
  bool isWithin(std::size_t i) const;
  void joinHits(int block, const std::array<float, kBlock>& enters,
                const std::array<float, kBlock>& leaves, int count);
  template <bool is_narrowing>
  void raise(std::size_t edge, int first, int last);
  template <bool is_narrowing>
  void followStretch(std::size_t& i, std::size_t count);
  void followLeafStretch(std::size_t& i, std::size_t count);
  void followBlockStretch(std::size_t& i, std::size_t count);
  template <bool is_narrowing>
  void followChain(std::size_t begin, std::size_t end);
  template <bool is_narrowing>
  void followRuns(const BoundaryChains& chains, const std::vector<BoundaryChains::Run>& runs,
                  const TPoint2D& middle, Ends ends);
  void keepRuns(const BoundaryChains& chains, const float* farthest,
                std::vector<BoundaryChains::Run>& runs);
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

/// The runs' vertices, one run after another; returns how many.
std::size_t RangeBandFinder::Workspace::gather(const BoundaryChains& chains,
                                               const std::vector<BoundaryChains::Run>& runs,
                                               const TPoint2D& middle, Ends ends) {
  stretches.clear();
  std::size_t vertices = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    BoundaryChains::Run run = runs[r];
    if (ends == Ends::extended) {
      run = extended(chains, run);
      while (r + 1 < runs.size()) {
        const BoundaryChains::Run next = extended(chains, runs[r + 1]);
        if (next.first > run.first + run.edges) break;
        run.edges = std::max(run.edges, next.first + next.edges - run.first);
        ++r;
      }
    }
    stretches.push_back({run.first, vertices, vertices + run.edges + 1});
    vertices += run.edges + 1;
  }
  const std::size_t room = vertices + 2 * kVertexBlock;
  if (x.size() < room) {
    for (auto* column : {&x, &y, &bearing, &before, &after}) column->resize(room);
    edges.resize(room);
  }
  const std::int32_t origin_x = chains.fixedX(middle.x), origin_y = chains.fixedY(middle.y);
  const auto unit = static_cast<float>(chains.unit());
  for (const Stretch& stretch : stretches) {
    for (std::size_t i = stretch.begin, from = stretch.first; i < stretch.end; ++i, ++from) {
      x[i] = static_cast<float>(chains.x()[from] - origin_x) * unit;
      y[i] = static_cast<float>(chains.y()[from] - origin_y) * unit;
    }
  }
  return vertices;
}

/// Directions of the vertices from the middle, and how far to either side of that they are seen
/// from the leaf's vertices: it is convex and no vertex lies in it, so less than half a turn.
POLYLOC_HOT_LOOP
void RangeBandFinder::Workspace::takeBearings(std::size_t count) {
  const std::size_t end = wholeBlocks(count);
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

/// Fills the columns of the first edges, but for their bins.
POLYLOC_HOT_LOOP
void RangeBandFinder::Workspace::boundEdges(std::size_t count) {
  count = wholeBlocks(count);
  constexpr float kLeast = 1e-6F;
  const float* __restrict__ xs = x.data();
  const float* __restrict__ ys = y.data();
  float* __restrict__ nx = edges.nx.data();
  float* __restrict__ ny = edges.ny.data();
  float* __restrict__ least = edges.near_n.data();
  float* __restrict__ greatest = edges.far_n.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = xs[i + 1] - xs[i], dy = ys[i + 1] - ys[i];
    const float length = std::sqrt(dx * dx + dy * dy);
    const float inverse = length > 0.0F ? 1.0F / length : 0.0F;
    nx[i] = dy * inverse;
    ny[i] = -dx * inverse;
    least[i] = kUnbounded;
    greatest[i] = -kUnbounded;
  }
  for (const TPoint2D& corner : leaf) {
    const auto cx = static_cast<float>(corner.x), cy = static_cast<float>(corner.y);
    for (std::size_t i = 0; i < count; ++i) {
      const float d = nx[i] * (xs[i] - cx) + ny[i] * (ys[i] - cy);
      least[i] = std::min(least[i], d);
      greatest[i] = std::max(greatest[i], d);
    }
  }
  float* __restrict__ skip_n = edges.skip_n.data();
  std::int32_t* __restrict__ faces = edges.faces.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float inverse = 1.0F / least[i];
    faces[i] = greatest[i] > kLeast ? 1 : 0;
    skip_n[i] = least[i] > kLeast ? 0.0F : kUnbounded;
    least[i] = least[i] > kLeast ? inverse : 0.0F;
    greatest[i] = 1.0F / greatest[i];
  }
  float* __restrict__ near_x = edges.near_x.data();
  float* __restrict__ far_x = edges.far_x.data();
  float* __restrict__ skip_x = edges.skip_x.data();
  for (std::size_t i = 0; i < count; ++i) {
    boundCoordinate(std::min(xs[i], xs[i + 1]) - high_x, std::max(xs[i], xs[i + 1]) - low_x,
                    near_x[i], far_x[i], skip_x[i]);
  }
  float* __restrict__ near_y = edges.near_y.data();
  float* __restrict__ far_y = edges.far_y.data();
  float* __restrict__ skip_y = edges.skip_y.data();
  for (std::size_t i = 0; i < count; ++i) {
    boundCoordinate(std::min(ys[i], ys[i + 1]) - high_y, std::max(ys[i], ys[i + 1]) - low_y,
                    near_y[i], far_y[i], skip_y[i]);
  }
}

/// Fills the columns of bins of the first edges.
POLYLOC_HOT_LOOP
void RangeBandFinder::Workspace::takeBins(std::size_t count) {
  count = wholeBlocks(count);
  constexpr auto kPerRadian = static_cast<float>(1.0 / kBandBinWidth);
  constexpr auto kTurn = static_cast<float>(kTwoPi);
  const float* __restrict__ bearings = bearing.data();
  const float* __restrict__ befores = before.data();
  const float* __restrict__ afters = after.data();
  std::int32_t* __restrict__ first = edges.first.data();
  std::int32_t* __restrict__ last = edges.last.data();
  std::int32_t* __restrict__ turn = edges.turn.data();
  std::int32_t* __restrict__ past = edges.past.data();
  std::int32_t* __restrict__ before_from = edges.before.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float step = bearings[i + 1] - bearings[i];
    const std::int32_t wrap = step < -kPiF ? 1 : step >= kPiF ? -1 : 0;
    const float next = bearings[i + 1] + static_cast<float>(wrap) * kTurn;
    const float low = std::min(bearings[i] + befores[i], next + befores[i + 1]) - kSlackF;
    const float high = std::max(bearings[i] + afters[i], next + afters[i + 1]) + kSlackF;
    first[i] = static_cast<std::int32_t>(std::floor(low * kPerRadian));
    last[i] = static_cast<std::int32_t>(std::floor(high * kPerRadian));
    turn[i] = wrap;
    past[i] = static_cast<std::int32_t>(std::floor((next + befores[i + 1] - kSlackF) * kPerRadian));
    before_from[i] =
        static_cast<std::int32_t>(std::floor((next + afters[i + 1] + kSlackF) * kPerRadian)) + 1;
  }
}

/// Whether the edge from vertex i may meet the leaf itself, here a block, or touches its box.
POLYLOC_INLINE bool RangeBandFinder::Workspace::isWithin(std::size_t i) const {
  constexpr float kMargin = 1e-3F;
  return std::min(x[i], x[i + 1]) < high_x + kMargin &&
         std::max(x[i], x[i + 1]) > low_x - kMargin &&
         std::min(y[i], y[i + 1]) < high_y + kMargin && std::max(y[i], y[i + 1]) > low_y - kMargin;
}

/// Joins what an edge may be hit between, over a block of bins, to what the edges before it were,
/// as long as both overlap.
POLYLOC_INLINE void RangeBandFinder::Workspace::joinHits(int block,
                                                         const std::array<float, kBlock>& enters,
                                                         const std::array<float, kBlock>& leaves,
                                                         int count) {
  float* __restrict__ nears = joined_near.data() + block;
  float* __restrict__ fars = joined_far.data() + block;
  int apart = 0;
  for (int k = 0; k < kBlock; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const bool is_hit = k <= count && enters[i] > 0.0F;
    const bool overlaps = enters[i] >= fars[k] && leaves[i] <= nears[k];
    apart |= is_hit && nears[k] > 0.0F && !overlaps ? 1 << k : 0;
  }
  for (int k = 0; apart != 0; ++k, apart >>= 1) {
    if ((apart & 1) == 0) continue;
    hits.push_back({(block + k) % kBins, nears[k], fars[k]});
    nears[k] = 0.0F;
  }
  for (int k = 0; k < kBlock; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const bool is_hit = k <= count && enters[i] > 0.0F;
    const float farthest = nears[k] > 0.0F ? std::min(fars[k], leaves[i]) : leaves[i];
    fars[k] = is_hit ? farthest : fars[k];
    nears[k] = is_hit ? std::max(nears[k], enters[i]) : nears[k];
  }
}

/// Over the bins [first, last]: near depths to at least, those of the passing chain to at most what
/// the edge's bounds say, which are kept as well.
template <bool is_narrowing>
POLYLOC_INLINE void RangeBandFinder::Workspace::raise(std::size_t edge, int first, int last) {
  const float nx = edges.nx[edge], ny = edges.ny[edge];
  const float near_n = edges.near_n[edge], far_n = edges.far_n[edge];
  const float near_x = edges.near_x[edge], far_x = edges.far_x[edge];
  const float near_y = edges.near_y[edge], far_y = edges.far_y[edge];
  const float skip_n = edges.skip_n[edge], skip_x = edges.skip_x[edge];
  const float skip_y = edges.skip_y[edge];
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
      const float t0 = nx * c0 + ny * s0, t1 = nx * c1 + ny * s1;
      const float high = std::min(
          std::min(std::max(t0, t1) * near_n + skip_n, std::max(c0 * near_x, c1 * near_x) + skip_x),
          std::max(s0 * near_y, s1 * near_y) + skip_y);
      const float low =
          std::max(std::max(std::min(t0, t1) * far_n, std::min(c0 * far_x, c1 * far_x)),
                   std::max(std::min(s0 * far_y, s1 * far_y), 0.0F));
      enters[static_cast<std::size_t>(k)] = high * kBulge;
      leaves[static_cast<std::size_t>(k)] = low;
    }
    for (int k = 0; k < kBlock; ++k) {  // masked by values, so that all is written as vectors
      const float entered = k <= count ? enters[static_cast<std::size_t>(k)] : 0.0F;
      const float left = k <= count ? leaves[static_cast<std::size_t>(k)] : kUnbounded;
      nears[k] = std::max(nears[k], entered);
      chain[k] = std::min(chain[k], left);
    }
    if (is_narrowing) {
      for (int k = 0; k < kBlock && k <= count; ++k) {
        sightings.push_back({to_layout + static_cast<std::uint32_t>(edge), (block + k) % kBins,
                             enters[static_cast<std::size_t>(k)]});
      }
    } else {
      joinHits(block, enters, leaves, count);
    }
  }
}

/// Follows a chain from vertex i on, until its end or until it has turned too far around the leaf;
/// i is then where it is to be taken up again. Seen from a block, a stretch ends before an edge
/// that may lie within it.
template <bool is_narrowing>
POLYLOC_INLINE void RangeBandFinder::Workspace::followStretch(std::size_t& i, std::size_t count) {
  constexpr auto kPerRadian = static_cast<float>(1.0 / kBandBinWidth);
  // Whole turns are added as bins, so that rounding does not add up along a chain.
  int turns = kFirstTurn + (bearing[i] < 0.0F ? kBins : 0);
  const auto starts_before =
      static_cast<int>(std::floor((bearing[i] + after[i] + kSlackF) * kPerRadian));
  int reset_from = turns + starts_before + 1;
  int past_to = reset_from;  // bins below are behind the chain, or never were before it
  int touched_first = kUnwrapped, touched_last = -1;
  for (; i + 1 < count; ++i) {
    if (is_narrowing && isWithin(i)) break;
    const int first = turns + edges.first[i], last = turns + edges.last[i];
    if (first < 0 || last + kBlock >= kUnwrapped) break;
    if (edges.faces[i] != 0) {
      // Bins the chain was not before count as passed: they are not raised by it.
      raise<is_narrowing>(i, first, last);
      touched_first = std::min(touched_first, first);
      touched_last = std::max(touched_last, last);
    }
    // The chain is past a bin if it is from all of the leaf: then the stretch blocked it.
    const int past_end = turns + edges.past[i];
    for (int b = past_to; b < past_end; ++b) {
      const auto k = static_cast<std::size_t>(b);
      far[k] = std::max(far[k], passing[k] < kUnbounded ? passing[k] : 0.0F);
    }
    past_to = std::max(past_to, past_end);
    // And before a bin again, or still: a new stretch begins here.
    reset_from = turns + edges.before[i];
    for (int b = std::max(reset_from, 0); b <= touched_last; ++b) {
      passing[static_cast<std::size_t>(b)] = kUnbounded;
    }
    touched_last = std::min(touched_last, reset_from - 1);
    past_to = std::min(past_to, reset_from);
    turns += edges.turn[i] * kBins;
  }
  for (int b = touched_first; b <= touched_last; ++b) {
    passing[static_cast<std::size_t>(b)] = kUnbounded;
  }
}

POLYLOC_HOT_LOOP
void RangeBandFinder::Workspace::followLeafStretch(std::size_t& i, std::size_t count) {
  followStretch<false>(i, count);
}

POLYLOC_HOT_LOOP
void RangeBandFinder::Workspace::followBlockStretch(std::size_t& i, std::size_t count) {
  followStretch<true>(i, count);
}

template <bool is_narrowing>
void RangeBandFinder::Workspace::followChain(std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i + 1 < end;) {
    if (is_narrowing && isWithin(i)) {
      kept.push_back(to_layout + static_cast<std::uint32_t>(i));
      ++i;
      continue;
    }
    const std::size_t from = i;
    if (is_narrowing) {
      followBlockStretch(i, end);
    } else {
      followLeafStretch(i, end);
    }
    if (i != from) continue;
    // An edge that spans too much by itself cannot be, but must not hang, nor be lost.
    if (is_narrowing) kept.push_back(to_layout + static_cast<std::uint32_t>(i));
    ++i;
  }
}

template <bool is_narrowing>
void RangeBandFinder::Workspace::followRuns(const BoundaryChains& chains,
                                            const std::vector<BoundaryChains::Run>& runs,
                                            const TPoint2D& middle, Ends ends) {
  near.fill(0.0F);
  far.fill(0.0F);
  const std::size_t vertices = gather(chains, runs, middle, ends);
  takeBearings(vertices);
  // Edges from a run's end to the next one's beginning are computed, too, but never followed.
  takeBins(vertices);
  boundEdges(vertices);
  for (const Stretch& stretch : stretches) {
    to_layout =
        static_cast<std::uint32_t>(stretch.first) - static_cast<std::uint32_t>(stretch.begin);
    followChain<is_narrowing>(stretch.begin, stretch.end);
  }
}

/// The runs of what may be met before the farthest that is seen of walls, bin by bin. Edges between
/// that are not belong to them where they are few: chains block as long as they hold together.
void RangeBandFinder::Workspace::keepRuns(const BoundaryChains& chains, const float* farthest,
                                          std::vector<BoundaryChains::Run>& runs) {
  constexpr std::uint32_t kMore = 2;  // at both ends: see extended()
  constexpr std::uint32_t kMostBetween = 6;
  constexpr float kRounding = 1.0F + 1e-4F;
  std::array<float, kBandBins> least;  // inverse
  for (std::size_t b = 0; b < kBandBins; ++b) least[b] = 1.0F / (farthest[b] * kRounding + 1e-3F);
  std::uint32_t last = BoundaryChains::kNone;
  for (const Sighting& sighting : sightings) {
    if (sighting.edge == last || !(sighting.near > 0.0F) ||
        sighting.near < least[static_cast<std::size_t>(sighting.bin)]) {
      continue;
    }
    last = sighting.edge;
    kept.push_back(last);
  }
  std::sort(kept.begin(), kept.end());
  runs.clear();
  for (const std::uint32_t edge : kept) {
    std::uint32_t first = edge, end = edge + 1;
    for (std::uint32_t k = 0; k < kMore && first > 0 && chains.isEdge(first - 1); ++k) --first;
    for (std::uint32_t k = 0; k < kMore && chains.isEdge(end); ++k) ++end;
    if (!runs.empty()) {
      BoundaryChains::Run& run = runs.back();
      std::uint32_t joined = run.first + run.edges;
      if (first <= joined + kMostBetween) {
        while (joined < first && chains.isEdge(joined)) ++joined;
        if (joined >= first) {
          run.edges = std::max(joined, end) - run.first;
          continue;
        }
      }
    }
    runs.push_back({first, end - first});
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
  for (std::size_t turn = 0; turn < joined_near.size(); ++turn) {
    if (!(joined_near[turn] > 0.0F)) continue;
    hits.push_back({static_cast<int>(turn % kBandBins), joined_near[turn], joined_far[turn]});
    joined_near[turn] = 0.0F;
  }
  // What is met only past the farthest that is seen does not matter.
  std::array<float, kBandBins> least;
  for (std::size_t b = 0; b < kBandBins; ++b) least[b] = 1.0F / bands.wall_high[b] * (1.0F - 1e-6F);
  first_hit.fill(0);
  std::size_t count = 0;
  for (const Hits& hit : hits) {
    if (hit.near < least[static_cast<std::size_t>(hit.bin)]) continue;
    hits[count++] = hit;
    ++first_hit[static_cast<std::size_t>(hit.bin) + 1];
  }
  hits.resize(count);
  for (std::size_t b = 0; b < kBandBins; ++b) first_hit[b + 1] += first_hit[b];
  sorted_hits.resize(hits.size());
  auto next = first_hit;
  for (const Hits& hit : hits) sorted_hits[next[static_cast<std::size_t>(hit.bin)]++] = hit;
  for (std::size_t b = 0; b < kBandBins; ++b) {
    const auto begin = sorted_hits.begin() + static_cast<std::ptrdiff_t>(first_hit[b]);
    const auto end = sorted_hits.begin() + static_cast<std::ptrdiff_t>(first_hit[b + 1]);
    std::sort(begin, end, [](const Hits& a, const Hits& c) { return a.near > c.near; });
    const float farthest = bands.wall_high[b];
    float reached = std::min(bands.wall_low[b], bands.open_low[b]);
    float low = 0.0F, high = 0.0F;
    for (auto hit = begin; hit != end; ++hit) {
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

void RangeBandFinder::narrow(const BoundingBox& block) {
  const TPoint2D middle = (block.min + block.max) * 0.5;
  const std::array<TPoint2D, 4> corners{
      {block.min, {block.max.x, block.min.y}, block.max, {block.min.x, block.max.y}}};
  const BoundaryChains& chains = index_->chains();
  Workspace& w = *workspace_;
  index_->take(index_->squareNumber(middle), w.listed);
  w.takeLeaf(corners.data(), corners.size(), middle);
  w.sightings.clear();
  w.kept.clear();
  w.followRuns<true>(chains, w.listed.walls, middle, Workspace::Ends::extended);
  std::array<float, kBandBins> low, high;
  w.ranges(low.data(), high.data());
  w.keepRuns(chains, high.data(), w.narrowed_walls);
  w.sightings.clear();
  w.kept.clear();
  w.followRuns<true>(chains, w.listed.open, middle, Workspace::Ends::extended);
  w.keepRuns(chains, high.data(), w.narrowed_open);
  w.narrowed = block;
}

void RangeBandFinder::find(const TPoint2D* leaf, std::size_t count, RangeBands& bands) {
  TPoint2D middle{0, 0};
  for (std::size_t k = 0; k < count; ++k) middle += leaf[k] * (1.0 / static_cast<double>(count));
  const BoundaryChains& chains = index_->chains();
  Workspace& w = *workspace_;
  w.takeLeaf(leaf, count, middle);
  const bool is_narrowed =
      std::all_of(leaf, leaf + count, [&w](const TPoint2D& p) { return w.narrowed.contains(p); });
  if (!is_narrowed) index_->take(index_->squareNumber(middle), w.listed);
  const auto& walls = is_narrowed ? w.narrowed_walls : w.listed.walls;
  const auto& open = is_narrowed ? w.narrowed_open : w.listed.open;
  const Workspace::Ends ends = is_narrowed ? Workspace::Ends::as_listed : Workspace::Ends::extended;
  w.hits.clear();
  w.followRuns<false>(chains, walls, middle, ends);
  w.ranges(bands.wall_low.data(), bands.wall_high.data());
  bands.has_open = !open.empty();
  if (bands.has_open) {
    w.followRuns<false>(chains, open, middle, ends);
    w.ranges(bands.open_low.data(), bands.open_high.data());
  } else {
    bands.open_low.fill(std::numeric_limits<float>::infinity());
    bands.open_high.fill(std::numeric_limits<float>::infinity());
  }
  w.findGaps(bands);
}

}  // namespace mrpt_polyloc
