#include <mrpt_polyloc/geometry/cpu_dispatch.h>
#include <mrpt_polyloc/visibility/depth_buffer.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {
namespace {

constexpr float kPi = 3.14159265F;

/// Widens each edge so that no beam slips between two edges that share a vertex: more than the
/// error of the single-precision bearings (4e-7 rad), far less than any beam's width [rad].
constexpr float kSlack = 2e-6F;

/// atan2 without branches, for vector code. Error below 4e-7: the polynomial interpolates
/// atan(a) / a in a^2 at the nine Chebyshev nodes of [0, 1] (error 1e-8), the rest is rounding.
inline __attribute__((always_inline)) float atan2Polynomial(float y, float x) {
  const float abs_x = std::fabs(x), abs_y = std::fabs(y);
  const float greater = std::max(abs_x, abs_y), smaller = std::min(abs_x, abs_y);
  const float a = smaller / std::max(greater, 1e-30F);
  const float s = a * a;
  float p = 0.00276628350F;
  p = p * s - 0.0157312491F;
  p = p * s + 0.0421376236F;
  p = p * s - 0.0745685483F;
  p = p * s + 0.106183706F;
  p = p * s - 0.141977978F;
  p = p * s + 0.199918719F;
  p = p * s - 0.333330367F;
  p = p * s + 0.999999982F;
  p *= a;
  p = abs_y > abs_x ? 0.5F * kPi - p : p;
  p = x < 0.0F ? kPi - p : p;
  return y < 0.0F ? -p : p;
}

}  // namespace

POLYLOC_HOT_LOOP
void projectEdges(const std::vector<VisibleEdgeIndex::Edge>& edges, const std::uint32_t* numbers,
                  std::size_t count, const ViewFrame& frame, SeenEdges& out) {
  if (out.right.size() < count) {
    for (auto* column : {&out.right, &out.left, &out.along, &out.across}) column->resize(count);
  }
  float* right = out.right.data();
  float* left = out.left.data();
  float* along = out.along.data();
  float* across = out.across.data();
  // Front-facing edges are packed first, endpoints in place of the results: the costly part below
  // then runs without branches.
  std::size_t seen = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const VisibleEdgeIndex::Edge& e = edges[numbers[i]];
    const float ax = e.ax - frame.x, ay = e.ay - frame.y;
    const float bx = e.bx - frame.x, by = e.by - frame.y;
    right[seen] = ax;
    left[seen] = ay;
    along[seen] = bx;
    across[seen] = by;
    seen += ax * by - ay * bx > 0.0F;
  }
  out.count = seen;
  for (std::size_t i = 0; i < seen; ++i) {
    const float ax = right[i], ay = left[i], bx = along[i], by = across[i];
    const float scale = 1.0F / (ax * by - ay * bx);
    const float nx = (by - ay) * scale, ny = (ax - bx) * scale;
    right[i] = atan2Polynomial(ay, ax) - frame.heading;
    left[i] = atan2Polynomial(by, bx) - frame.heading;
    along[i] = nx * frame.cosine + ny * frame.sine;
    across[i] = ny * frame.cosine - nx * frame.sine;
  }
}

/// The run of sorted beams that an edge covers is [first, last), or where last < first two runs:
/// [first, all) and [0, last), across the bearing pi.
struct Run {
  std::size_t first, last;
  bool is_split;
};

inline __attribute__((always_inline)) Run runOf(const SeenEdges& edges, std::size_t e,
                                                const BeamPattern& beams) {
  float from = edges.right[e] - kSlack, to = edges.left[e] + kSlack;
  if (from < -kPi) from += 2.0F * kPi;
  if (from >= kPi) from -= 2.0F * kPi;
  if (to < -kPi) to += 2.0F * kPi;
  if (to >= kPi) to -= 2.0F * kPi;
  return {beams.firstFrom(from), beams.firstFrom(to), from > to};
}

/// The arrays of a pattern, told to be apart from each other: else g++ leaves the loops scalar.
struct Columns {
  const float* __restrict__ cosines;
  const float* __restrict__ sines;
  float* __restrict__ inverse;
  std::int32_t* __restrict__ nearest;
};

inline __attribute__((always_inline)) void raise(const Columns& columns, float along, float across,
                                                 std::size_t first, std::size_t last) {
  const float* __restrict__ cosines = columns.cosines;
  const float* __restrict__ sines = columns.sines;
  float* __restrict__ inverse = columns.inverse;
  for (std::size_t i = first; i < last; ++i) {
    const float value = along * cosines[i] + across * sines[i];
    inverse[i] = std::max(inverse[i], value);
  }
}

inline __attribute__((always_inline)) void raise(const Columns& columns, float along, float across,
                                                 std::int32_t number, std::size_t first,
                                                 std::size_t last) {
  const float* __restrict__ cosines = columns.cosines;
  const float* __restrict__ sines = columns.sines;
  float* __restrict__ inverse = columns.inverse;
  std::int32_t* __restrict__ nearest = columns.nearest;
  for (std::size_t i = first; i < last; ++i) {
    const float value = along * cosines[i] + across * sines[i];
    nearest[i] = inverse[i] < value ? number : nearest[i];
    inverse[i] = std::max(inverse[i], value);
  }
}

}  // namespace

POLYLOC_HOT_LOOP
void projectEdges(const std::vector<VisibleEdgeIndex::Edge>& edges, const std::uint32_t* numbers,
                  std::size_t count, const ViewFrame& frame, SeenEdges& out) {
  if (out.right.size() < count) {
    for (auto* column : {&out.right, &out.left, &out.along, &out.across}) column->resize(count);
  }
  float* right = out.right.data();
  float* left = out.left.data();
  float* along = out.along.data();
  float* across = out.across.data();
  // Front-facing edges are packed first, endpoints in place of the results: the costly part below
  // then runs without branches.
  std::size_t seen = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const VisibleEdgeIndex::Edge& e = edges[numbers[i]];
    const float ax = e.ax - frame.x, ay = e.ay - frame.y;
    const float bx = e.bx - frame.x, by = e.by - frame.y;
    right[seen] = ax;
    left[seen] = ay;
    along[seen] = bx;
    across[seen] = by;
    seen += ax * by - ay * bx > 0.0F;
  }
  out.count = seen;
  for (std::size_t i = 0; i < seen; ++i) {
    const float ax = right[i], ay = left[i], bx = along[i], by = across[i];
    const float scale = 1.0F / (ax * by - ay * bx);
    const float nx = (by - ay) * scale, ny = (ax - bx) * scale;
    right[i] = atan2Polynomial(ay, ax) - frame.heading;
    left[i] = atan2Polynomial(by, bx) - frame.heading;
    along[i] = nx * frame.cosine + ny * frame.sine;
    across[i] = ny * frame.cosine - nx * frame.sine;
  }
}

/// Calls run(edge, first, last) for each run of sorted beams that an edge covers.
template <class Run>
inline __attribute__((always_inline)) void forEachRun(const SeenEdges& edges,
                                                      const BeamPattern& beams, Run&& run) {
  for (std::size_t e = 0; e < edges.count; ++e) {
    float from = edges.right[e] - kSlack, to = edges.left[e] + kSlack;
    if (from < -kPi) from += 2.0F * kPi;
    if (from >= kPi) from -= 2.0F * kPi;
    if (to < -kPi) to += 2.0F * kPi;
    if (to >= kPi) to -= 2.0F * kPi;
    const std::size_t first = beams.firstFrom(from), last = beams.firstFrom(to);
    if (from <= to) {
      run(e, first, last);
    } else {  // across the bearing pi
      run(e, first, beams.size());
      run(e, 0, last);
    }
  }
}

POLYLOC_HOT_LOOP
void fillDepths(const SeenEdges& edges, const BeamPattern& beams, float* inverse) {
  const Columns columns{beams.cosines(), beams.sines(), inverse, nullptr};
  for (std::size_t e = 0; e < edges.count; ++e) {
    const Run run = runOf(edges, e, beams);
    const float along = edges.along[e], across = edges.across[e];
    raise(columns, along, across, run.first, run.is_split ? beams.size() : run.last);
    if (run.is_split) raise(columns, along, across, 0, run.last);
  }
}

POLYLOC_HOT_LOOP
void fillDepths(const SeenEdges& edges, const BeamPattern& beams, float* inverse,
                std::int32_t* nearest) {
  const Columns columns{beams.cosines(), beams.sines(), inverse, nearest};
  for (std::size_t e = 0; e < edges.count; ++e) {
    const Run run = runOf(edges, e, beams);
    const float along = edges.along[e], across = edges.across[e];
    const auto number = static_cast<std::int32_t>(e);
    raise(columns, along, across, number, run.first, run.is_split ? beams.size() : run.last);
    if (run.is_split) raise(columns, along, across, number, 0, run.last);
  }
}

}  // namespace mrpt_polyloc
