#include <mrpt_polyloc/base/cpu_dispatch.h>
#include <mrpt_polyloc/localization/search/EdgeBounds.h>
#include <mrpt_polyloc/localization/search/RangeBands.h>
#include <mrpt_polyloc/localization/search/angular_slack.h>

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
constexpr float kUnbounded = EdgeBounds::kUnbounded;
constexpr auto kSlackF = static_cast<float>(kAngularSlack);
constexpr float kGreatest = 1e4F;  ///< inverse of the least range that is told from 0 [1/m]

/// In bins that no wall blocks for all of a block, edges are listed up to this range, and so far
/// behind the nearest wall [m]: beyond that there may be anything. On ragged maps two thirds of the
/// bins are such, and held most of the edges; bounds get no wider (doc/performance.md).
constexpr float kLeastReach = 8.0F, kReachBehind = 4.0F;

using Depths = std::array<float, kUnwrapped + kBlock>;

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
  EdgeBounds bounds;  ///< of the runs that are followed
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
  std::array<float, kBandBins> reach;           ///< up to which range, bin by bin

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
                  const TPoint2D& middle, EdgeBounds::Ends ends);
  void keepRuns(const BoundaryChains& chains, const float* farthest,
                std::vector<BoundaryChains::Run>& runs);
  void ranges(float* low, float* high) const;
  void findGaps(RangeBands& bands);
};

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
  const float nx = bounds.edges.nx[edge], ny = bounds.edges.ny[edge];
  const float near_n = bounds.edges.near_n[edge], far_n = bounds.edges.far_n[edge];
  const float near_x = bounds.edges.near_x[edge], far_x = bounds.edges.far_x[edge];
  const float near_y = bounds.edges.near_y[edge], far_y = bounds.edges.far_y[edge];
  const float skip_n = bounds.edges.skip_n[edge], skip_x = bounds.edges.skip_x[edge];
  const float skip_y = bounds.edges.skip_y[edge];
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
  int turns = kFirstTurn + (bounds.bearing[i] < 0.0F ? kBins : 0);
  const auto starts_before =
      static_cast<int>(std::floor((bounds.bearing[i] + bounds.after[i] + kSlackF) * kPerRadian));
  int reset_from = turns + starts_before + 1;
  int past_to = reset_from;  // bins below are behind the chain, or never were before it
  int touched_first = kUnwrapped, touched_last = -1;
  for (; i + 1 < count; ++i) {
    if (is_narrowing && bounds.isWithin(i)) break;
    const int first = turns + bounds.edges.first[i], last = turns + bounds.edges.last[i];
    if (first < 0 || last + kBlock >= kUnwrapped) break;
    if (bounds.edges.faces[i] != 0) {
      // Bins the chain was not before count as passed: they are not raised by it.
      raise<is_narrowing>(i, first, last);
      touched_first = std::min(touched_first, first);
      touched_last = std::max(touched_last, last);
    }
    // The chain is past a bin if it is from all of the leaf: then the stretch blocked it.
    const int past_end = turns + bounds.edges.past[i];
    for (int b = past_to; b < past_end; ++b) {
      const auto k = static_cast<std::size_t>(b);
      far[k] = std::max(far[k], passing[k] < kUnbounded ? passing[k] : 0.0F);
    }
    past_to = std::max(past_to, past_end);
    // And before a bin again, or still: a new stretch begins here.
    reset_from = turns + bounds.edges.before[i];
    for (int b = std::max(reset_from, 0); b <= touched_last; ++b) {
      passing[static_cast<std::size_t>(b)] = kUnbounded;
    }
    touched_last = std::min(touched_last, reset_from - 1);
    past_to = std::min(past_to, reset_from);
    turns += bounds.edges.turn[i] * kBins;
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
    if (is_narrowing && bounds.isWithin(i)) {
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
                                            const TPoint2D& middle, EdgeBounds::Ends ends) {
  near.fill(0.0F);
  far.fill(0.0F);
  bounds.take(chains, runs, middle, ends);
  for (const EdgeBounds::Stretch& stretch : bounds.stretches) {
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
    const auto consider = [&](float from) {
      if (from - reached <= high - low) return;
      low = reached;
      high = from;
    };
    for (auto hit = begin; hit != end && reached < reach[b]; ++hit) {
      const float from = hit->near >= kGreatest ? 0.0F : 1.0F / hit->near;
      if (from > farthest || from > reach[b]) break;
      consider(from);
      reached = std::max(reached, 1.0F / std::max(hit->far, 1.0F / kUnbounded));
    }
    // Beyond what was looked through there may be anything.
    if (reach[b] < farthest) consider(reach[b]);
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
  w.bounds.takeLeaf(corners.data(), corners.size(), middle);
  w.sightings.clear();
  w.kept.clear();
  w.followRuns<true>(chains, w.listed.walls, middle, EdgeBounds::Ends::extended);
  std::array<float, kBandBins> low, high;
  w.ranges(low.data(), high.data());
  w.reach.fill(std::numeric_limits<float>::infinity());
  for (std::size_t b = 0; b < kBandBins; ++b) {
    if (std::isfinite(high[b])) continue;
    w.reach[b] = std::max(kLeastReach, low[b] + kReachBehind);
    high[b] = w.reach[b];
  }
  w.keepRuns(chains, high.data(), w.narrowed_walls);
  w.sightings.clear();
  w.kept.clear();
  w.followRuns<true>(chains, w.listed.open, middle, EdgeBounds::Ends::extended);
  w.keepRuns(chains, high.data(), w.narrowed_open);
  w.narrowed = block;
}

void RangeBandFinder::find(const TPoint2D* leaf, std::size_t count, RangeBands& bands) {
  TPoint2D middle{0, 0};
  for (std::size_t k = 0; k < count; ++k) middle += leaf[k] * (1.0 / static_cast<double>(count));
  const BoundaryChains& chains = index_->chains();
  Workspace& w = *workspace_;
  w.bounds.takeLeaf(leaf, count, middle);
  const bool is_narrowed =
      std::all_of(leaf, leaf + count, [&w](const TPoint2D& p) { return w.narrowed.contains(p); });
  if (!is_narrowed) index_->take(index_->squareNumber(middle), w.listed);
  const auto& walls = is_narrowed ? w.narrowed_walls : w.listed.walls;
  const auto& open = is_narrowed ? w.narrowed_open : w.listed.open;
  const EdgeBounds::Ends ends =
      is_narrowed ? EdgeBounds::Ends::as_listed : EdgeBounds::Ends::extended;
  w.hits.clear();
  w.followRuns<false>(chains, walls, middle, ends);
  w.ranges(bands.wall_low.data(), bands.wall_high.data());
  bands.has_open = !w.listed.open.empty();
  if (open.empty()) {
    bands.open_low.fill(std::numeric_limits<float>::infinity());
    bands.open_high.fill(std::numeric_limits<float>::infinity());
  } else {
    w.followRuns<false>(chains, open, middle, ends);
    w.ranges(bands.open_low.data(), bands.open_high.data());
  }
  if (!is_narrowed) w.reach.fill(std::numeric_limits<float>::infinity());
  for (std::size_t b = 0; b < kBandBins; ++b) {
    if (bands.wall_high[b] <= w.reach[b]) continue;
    bands.wall_low[b] = std::min(bands.wall_low[b], w.reach[b]);
    if (bands.has_open) bands.open_low[b] = std::min(bands.open_low[b], w.reach[b]);
  }
  w.findGaps(bands);
}

}  // namespace mrpt_polyloc
