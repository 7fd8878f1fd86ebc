#include <mrpt_polyloc/geometry/free_space_labels.h>

#include <cmath>
#include <set>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// What the rings of one polygon are to the region being visited.
struct PolygonState {
  int outer_winding = 0;
  int rings_around = 0;                    // rings with a winding number other than 0
  int odd_rings = 0;                       // rings with a winding number other than 0 and 1
  std::set<std::pair<double, int>> holes;  // those wound around positively, by size
  std::set<int> reversed_holes;            // those wound around negatively
};

/// A step over borders from one region into a neighbouring one.
struct Step {
  int region;
  int border;
  int sign;  // of the change of the winding number per piece from low to high node
};

/// Walks over all regions along a spanning tree and keeps the winding numbers of all rings up to
/// date on the way, so that no region needs its own list.
class RegionWalk {
 public:
  RegionWalk(const PlanarRegions& regions, const std::vector<CleanRing>& rings,
             std::size_t polygon_count)
      : regions_(regions),
        rings_(rings),
        ignored_(rings.size(), false),
        size_(rings.size()),
        winding_(rings.size(), 0),
        polygons_(polygon_count),
        steps_(regions.region_area.size()) {
    for (std::size_t r = 0; r < rings.size(); ++r) {
      size_[r] = std::abs(signedArea(rings[r].ring.vertices));
    }
    for (const PlanarRegions::Face& face : regions.faces) addSteps(face);
  }

  void ignore(std::size_t ring) { ignored_[ring] = true; }

  /// Calls visit(region) for every region but the outside.
  template <class Visitor>
  void run(const Visitor& visit) {
    std::vector<bool> is_seen(steps_.size(), false);
    std::vector<std::pair<Step, std::size_t>> path{{{0, PlanarRegions::kNone, 0}, 0}};
    is_seen[0] = true;
    while (!path.empty()) {
      auto& [here, next] = path.back();
      const std::vector<Step>& steps = steps_[static_cast<std::size_t>(here.region)];
      if (next == steps.size()) {
        if (here.border != PlanarRegions::kNone) cross(here.border, -here.sign);
        path.pop_back();
        continue;
      }
      const Step& step = steps[next++];
      if (is_seen[static_cast<std::size_t>(step.region)]) continue;
      is_seen[static_cast<std::size_t>(step.region)] = true;
      cross(step.border, step.sign);
      visit(static_cast<std::size_t>(step.region));
      path.push_back({step, 0});
    }
  }

  /// Polygons with a ring around the region being visited, in order.
  const std::set<int>& around() const { return around_; }
  const PolygonState& state(int polygon) const {
    return polygons_[static_cast<std::size_t>(polygon)];
  }

 private:
  void addSteps(const PlanarRegions::Face& face) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int across = regions_.regionAcross(face, i);
      if (face.border[i] == PlanarRegions::kNone || across == face.region) continue;
      const PlanarRegions::Border& border =
          regions_.borders[static_cast<std::size_t>(face.border[i])];
      // The face lies to the left of its edges; a ring winds once more to its left than right.
      const int sign = face.node[(i + 1) % 3] == border.low_node ? -1 : 1;
      steps_[static_cast<std::size_t>(face.region)].push_back({across, face.border[i], sign});
      if (face.neighbor[i] == PlanarRegions::kNone) {
        steps_[0].push_back({face.region, face.border[i], -sign});
      }
    }
  }

  void cross(int border_index, int sign) {
    const PlanarRegions::Border& border = regions_.borders[static_cast<std::size_t>(border_index)];
    for (const EdgePiece& piece : border.pieces) {
      if (ignored_[static_cast<std::size_t>(piece.ring)]) continue;
      changeWinding(piece.ring, piece.from == border.low_node ? sign : -sign);
    }
  }

  void changeWinding(int ring, int change) {
    const CleanRing& owner = rings_[static_cast<std::size_t>(ring)];
    PolygonState& polygon = polygons_[static_cast<std::size_t>(owner.polygon)];
    int& winding = winding_[static_cast<std::size_t>(ring)];
    const auto count = [&](int weight) {
      polygon.rings_around += weight * (winding != 0);
      polygon.odd_rings += weight * (winding != 0 && winding != 1);
    };
    const std::pair<double, int> hole{size_[static_cast<std::size_t>(ring)], ring};
    count(-1);
    if (!owner.is_outer && winding > 0) polygon.holes.erase(hole);
    if (!owner.is_outer && winding < 0) polygon.reversed_holes.erase(ring);
    winding += change;
    count(+1);
    if (owner.is_outer) polygon.outer_winding = winding;
    if (!owner.is_outer && winding > 0) polygon.holes.insert(hole);
    if (!owner.is_outer && winding < 0) polygon.reversed_holes.insert(ring);
    if (polygon.rings_around > 0) {
      around_.insert(owner.polygon);
    } else {
      around_.erase(owner.polygon);
    }
  }

  const PlanarRegions& regions_;
  const std::vector<CleanRing>& rings_;
  std::vector<bool> ignored_;
  std::vector<double> size_;
  std::vector<int> winding_;
  std::vector<PolygonState> polygons_;
  std::set<int> around_;
  std::vector<std::vector<Step>> steps_;
};

/// A hole is outside if no region of it is in its polygon, and covered if larger holes cover all
/// that are.
std::vector<FreeSpaceLabels::HoleUse> holeUses(RegionWalk& walk,
                                               const std::vector<CleanRing>& rings) {
  using Use = FreeSpaceLabels::HoleUse;
  std::vector<Use> uses(rings.size(), Use::outside);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (rings[r].is_outer) uses[r] = Use::needed;
  }
  walk.run([&](std::size_t) {
    for (const int polygon : walk.around()) {
      const PolygonState& state = walk.state(polygon);
      if (state.outer_winding <= 0) continue;
      for (const int hole : state.reversed_holes) {
        uses[static_cast<std::size_t>(hole)] = Use::needed;  // for its crossing to be judged
      }
      if (state.holes.empty()) continue;
      for (const auto& [size, hole] : state.holes) {
        Use& use = uses[static_cast<std::size_t>(hole)];
        if (use == Use::outside) use = Use::covered;
      }
      uses[static_cast<std::size_t>(state.holes.rbegin()->second)] = Use::needed;
    }
  });
  return uses;
}

}  // namespace

FreeSpaceLabels labelFreeSpace(const PlanarRegions& regions, const std::vector<CleanRing>& rings,
                               std::size_t polygon_count) {
  FreeSpaceLabels labels;
  RegionWalk walk(regions, rings, polygon_count);
  labels.hole_use = holeUses(walk, rings);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (labels.hole_use[r] != FreeSpaceLabels::HoleUse::needed) walk.ignore(r);
  }
  labels.free_of.assign(regions.region_area.size(), FreeSpaceLabels::kNotFree);
  labels.free_area.assign(polygon_count, 0.0);
  labels.ambiguous_area.assign(polygon_count, 0.0);
  walk.run([&](std::size_t at) {
    const int region = static_cast<int>(at);
    for (const int polygon : walk.around()) {
      const PolygonState& state = walk.state(polygon);
      const bool is_hole_outside = state.outer_winding <= 0 && !state.holes.empty();
      if (state.odd_rings > 0) labels.crossed.push_back({region, polygon});
      if (is_hole_outside) labels.hole_outside.push_back({region, polygon});
      if (state.odd_rings > 0 || is_hole_outside) {
        labels.ambiguous_area[static_cast<std::size_t>(polygon)] += regions.region_area[at];
      }
      if (state.outer_winding <= 0) continue;
      if (state.holes.size() > 1) labels.overlapping_holes.push_back({region, polygon});
      if (!state.holes.empty()) continue;
      labels.free_area[static_cast<std::size_t>(polygon)] += regions.region_area[at];
      if (labels.free_of[at] == FreeSpaceLabels::kNotFree) {
        labels.free_of[at] = polygon;
      } else if (labels.overlapping_polygons.empty() ||
                 labels.overlapping_polygons.back().region != region) {
        labels.overlapping_polygons.push_back({region, labels.free_of[at], polygon});
      }
    }
  });
  return labels;
}

}  // namespace mrpt_polyloc
