#include <mrpt_polyloc/base/cpu_dispatch.h>
#include <mrpt_polyloc/visibility/depth_buffer.h>
#include <mrpt_polyloc/visibility/fast_atan2.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {
namespace {

using Run = BoundaryChains::Run;

constexpr float kPi = kPiF;

/// Loops over short runs go in whole blocks, of as many floats as the widest vectors hold: what is
/// beyond the end is computed too and then masked or overwritten.
constexpr std::size_t kBlock = FloatBlocks::kBlock;
static_assert(kBlock <= BoundaryChains::kPadding);

/// Copies the runs' vertices, relative to the viewpoint; returns their number.
POLYLOC_INLINE std::size_t gather(const BoundaryChains& chains, const Run* runs, std::size_t count,
                                  const ViewFrame& frame, DepthWorkspace& w) {
  std::size_t room = kBlock;
  for (std::size_t r = 0; r < count; ++r) room += runs[r].edges + 1;
  if (w.x.size() < room) {
    for (auto* column : {&w.x, &w.y, &w.bearing}) column->resize(room);
    for (auto* column : {&w.is_edge, &w.beam, &w.edges.vertex}) column->resize(room);
  }
  std::size_t end = 0;
  for (std::size_t r = 0; r < count; ++r) {
    const std::size_t edges = runs[r].edges;
    for (std::size_t i = 0; i <= edges; i += kBlock) {
      const std::int32_t* from_x = chains.x() + runs[r].first + i;
      const std::int32_t* from_y = chains.y() + runs[r].first + i;
      float* __restrict__ x = w.x.data() + end + i;
      float* __restrict__ y = w.y.data() + end + i;
      std::int32_t* __restrict__ is_edge = w.is_edge.data() + end + i;
      for (std::size_t k = 0; k < kBlock; ++k) {
        x[k] = static_cast<float>(from_x[k] - frame.x);
        y[k] = static_cast<float>(from_y[k] - frame.y);
        is_edge[k] = 1;
      }
    }
    end += edges + 1;
    w.is_edge[end - 1] = 0;
  }
  return end;
}

/// Bearings of the vertices, and which beam follows each.
POLYLOC_INLINE void takeBearings(std::size_t count, const ViewFrame& frame,
                                 const BeamPattern& beams, DepthWorkspace& w) {
  const float* __restrict__ x = w.x.data();
  const float* __restrict__ y = w.y.data();
  float* __restrict__ bearing = w.bearing.data();
  const float heading = frame.heading;
  for (std::size_t i = 0; i < count; ++i) {
    float b = atan2Polynomial(y[i], x[i]) - heading;
    b += b < -kPi ? 2.0F * kPi : 0.0F;
    b -= b >= kPi ? 2.0F * kPi : 0.0F;
    bearing[i] = b;
  }
  beams.firstFrom(bearing, count, w.beam.data());
}

/// Finds the edges that face the viewer and cover at least one beam; returns their number.
POLYLOC_INLINE std::size_t select(std::size_t count, DepthWorkspace& w) {
  const float* __restrict__ x = w.x.data();
  const float* __restrict__ y = w.y.data();
  const float* __restrict__ bearing = w.bearing.data();
  const std::int32_t* __restrict__ beam = w.beam.data();
  std::int32_t* __restrict__ is_edge = w.is_edge.data();
  for (std::size_t i = 0; i + 1 < count; ++i) {  // integers: vector code does not mix with bool
    const std::int32_t faces = x[i] * y[i + 1] - y[i] * x[i + 1] > 0.0F ? 1 : 0;
    // Then it spans less than pi, so a bearing that falls by far passes pi. (One that falls a
    // little is rounding.)
    const float span = bearing[i + 1] - bearing[i];
    const std::int32_t covers = beam[i] < beam[i + 1] ? 1 : 0;
    const std::int32_t rises = span > 0.0F ? 1 : 0;
    const std::int32_t wraps = span < -1.0F ? 1 : 0;
    is_edge[i] = is_edge[i] & faces & ((covers & rises) | wraps);
  }
  std::int32_t* __restrict__ vertex = w.edges.vertex.data();
  std::size_t selected = 0;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    vertex[selected] = static_cast<std::int32_t>(i);
    selected += static_cast<std::size_t>(is_edge[i]);
  }
  return selected;
}

/// The lines of the selected edges, in the beam frame.
POLYLOC_INLINE void takeLines(std::size_t count, const ViewFrame& frame, DepthWorkspace& w) {
  DepthWorkspace::Edges& e = w.edges;
  if (e.from.size() < count) {
    for (auto* column : {&e.from, &e.to}) column->resize(count);
    for (auto* column : {&e.ax, &e.ay, &e.bx, &e.by, &e.nearest}) column->resize(count);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto v = static_cast<std::size_t>(e.vertex[i]);
    e.ax[i] = w.x[v];
    e.ay[i] = w.y[v];
    e.bx[i] = w.x[v + 1];
    e.by[i] = w.y[v + 1];
    e.from[i] = w.beam[v];
    e.to[i] = w.beam[v + 1];
  }
  float* __restrict__ along = e.ax.data();  // takes the place of ax, across that of ay
  float* __restrict__ across = e.ay.data();
  float* __restrict__ nearest = e.nearest.data();
  const float* __restrict__ bxs = e.bx.data();
  const float* __restrict__ bys = e.by.data();
  const float inverse_unit = 1.0F / frame.unit, cosine = frame.cosine, sine = frame.sine;
  for (std::size_t i = 0; i < count; ++i) {
    const float ax = along[i], ay = across[i], bx = bxs[i], by = bys[i];
    const float scale = inverse_unit / std::max(ax * by - ay * bx, 1e-20F);
    const float nx = (by - ay) * scale, ny = (ax - bx) * scale;
    along[i] = nx * cosine + ny * sine;
    across[i] = ny * cosine - nx * sine;
    // Seen nearly end on, the line's slope says little: without a foot on it, the edge is no nearer
    // than its ends.
    const float ex = bx - ax, ey = by - ay;
    const float off_edge = std::max(ax * ex + ay * ey, -(bx * ex + by * ey));  // < 0: foot on it
    const float nearer_end = std::min(ax * ax + ay * ay, bx * bx + by * by);
    const float least = off_edge < 0.0F ? 0.0F : nearer_end;  // squared
    nearest[i] = inverse_unit / std::sqrt(std::max(least, 1e-20F));
  }
}

/// An edge over the sorted beams [first, last): where it is hit, and how.
struct Stretch {
  float along, across, nearest;
  std::int32_t first, last;
};

/// Calls raise(i, value) for the beams of a stretch and others beside it, with the inverse range
/// min(along cos + across sin, nearest), and 0 for the others. In aligned blocks, so that a block
/// that the last edge stored is loaded again as it was stored.
template <class Raise>
POLYLOC_INLINE void forEachBeam(const BeamPattern& beams, const Stretch& stretch, Raise raise) {
  constexpr auto kStep = static_cast<std::int32_t>(kBlock);
  const float* __restrict__ cosines = beams.cosines();
  const float* __restrict__ sines = beams.sines();
  const auto [along, across, nearest, first, last] = stretch;
  const auto count = static_cast<std::uint32_t>(last - first);
  for (std::int32_t i = first / kStep * kStep; i < last; i += kStep) {
    for (std::int32_t k = 0; k < kStep; ++k) {
      const float value = std::min(along * cosines[i + k] + across * sines[i + k], nearest);
      raise(i + k, static_cast<std::uint32_t>(i + k - first) < count ? value : 0.0F);
    }
  }
}

/// Calls raise_stretch(stretch) for each run of sorted beams that one of the edges covers.
template <class RaiseStretch>
POLYLOC_INLINE void forEachStretch(const BoundaryChains& chains, const Run* runs, std::size_t count,
                                   const ViewFrame& frame, const BeamPattern& beams,
                                   DepthWorkspace& w, RaiseStretch raise_stretch) {
  const std::size_t vertices = gather(chains, runs, count, frame, w);
  takeBearings(vertices, frame, beams, w);
  const std::size_t edges = select(vertices, w);
  takeLines(edges, frame, w);
  const DepthWorkspace::Edges& e = w.edges;
  for (std::size_t i = 0; i < edges; ++i) {
    const auto vertex = static_cast<std::size_t>(e.vertex[i]);
    Stretch stretch{e.ax[i], e.ay[i], e.nearest[i], e.from[i], e.to[i]};
    if (w.bearing[vertex] > w.bearing[vertex + 1]) {  // across the bearing pi
      stretch.last = static_cast<std::int32_t>(beams.size());
      raise_stretch(stretch);
      stretch.first = 0;
      stretch.last = e.to[i];
    }
    raise_stretch(stretch);
  }
}

}  // namespace

POLYLOC_HOT_LOOP
void raiseDepths(const BoundaryChains& chains, const Run* runs, std::size_t count,
                 const ViewFrame& frame, const BeamPattern& beams, DepthWorkspace& w,
                 FloatBlocks& inverse) {
  float* __restrict__ depths = inverse.data();
  const auto raise_stretch = [&](const Stretch& stretch) __attribute__((always_inline)) {
    forEachBeam(
        beams, stretch, [&](std::int32_t i, float value) __attribute__((always_inline)) {
          depths[i] = std::max(depths[i], value);
        });
  };
  forEachStretch(chains, runs, count, frame, beams, w, raise_stretch);
}

POLYLOC_HOT_LOOP
void raiseDepths(const BoundaryChains& chains, const Run* runs, std::size_t count,
                 const ViewFrame& frame, const BeamPattern& beams, DepthWorkspace& w,
                 HitColumns& hits) {
  float* __restrict__ depths = hits.inverse.data();
  float* __restrict__ along = hits.along.data();
  float* __restrict__ across = hits.across.data();
  const auto raise_stretch = [&](const Stretch& stretch) __attribute__((always_inline)) {
    forEachBeam(
        beams, stretch, [&](std::int32_t i, float value) __attribute__((always_inline)) {
          const bool is_nearer = value > depths[i];
          depths[i] = is_nearer ? value : depths[i];
          along[i] = is_nearer ? stretch.along : along[i];
          across[i] = is_nearer ? stretch.across : across[i];
        });
  };
  forEachStretch(chains, runs, count, frame, beams, w, raise_stretch);
}

}  // namespace mrpt_polyloc
