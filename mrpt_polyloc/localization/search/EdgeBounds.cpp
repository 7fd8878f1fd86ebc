#include <mrpt_polyloc/base/cpu_dispatch.h>
#include <mrpt_polyloc/localization/search/EdgeBounds.h>
#include <mrpt_polyloc/localization/search/angular_slack.h>

#include <cmath>

namespace mrpt_polyloc {
namespace {

/// Columns are computed in whole blocks.
constexpr std::size_t kVertexBlock = 16;
constexpr float kUnbounded = EdgeBounds::kUnbounded;
constexpr auto kSlackF = static_cast<float>(kAngularSlack);

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

void EdgeBounds::takeLeaf(const TPoint2D* vertices, std::size_t count, const TPoint2D& middle) {
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
std::size_t EdgeBounds::gather(const BoundaryChains& chains,
                               const std::vector<BoundaryChains::Run>& runs, const TPoint2D& middle,
                               Ends ends) {
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
void EdgeBounds::takeBearings(std::size_t count) {
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
void EdgeBounds::boundEdges(std::size_t count) {
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
void EdgeBounds::takeBins(std::size_t count) {
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

void EdgeBounds::take(const BoundaryChains& chains, const std::vector<BoundaryChains::Run>& runs,
                      const TPoint2D& middle, Ends ends) {
  const std::size_t vertices = gather(chains, runs, middle, ends);
  takeBearings(vertices);
  // Edges from a run's end to the next one's beginning are computed, too, but never followed.
  takeBins(vertices);
  boundEdges(vertices);
}

}  // namespace mrpt_polyloc
