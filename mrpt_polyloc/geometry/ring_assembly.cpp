#include <mrpt_polyloc/geometry/ring_assembly.h>

#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// Walks along chains of one component and cuts off a ring whenever it comes back to a corner.
class RingWalk {
 public:
  using Chains = std::vector<std::size_t>;  ///< of a ring, in order

  explicit RingWalk(const BorderChains& borders) : borders_(borders) {
    for (std::size_t i = 0; i < borders.chains.size(); ++i) {
      const BorderChain& chain = borders.chains[i];
      if (chain.left >= 0) leaving_.push_back({chain.left, latticeKey(borders.first(chain)), i});
    }
    std::sort(leaving_.begin(), leaving_.end());
    used_.assign(borders.chains.size(), false);
  }

  /// Calls visit(component, chains) for every ring, component by component.
  template <class Visitor>
  void forEachRing(Visitor&& visit) {
    for (const Leaving& start : leaving_) {
      if (used_[start.chain]) continue;
      Chains path;
      std::unordered_map<std::uint64_t, std::size_t> position;  // of a corner on the path
      std::size_t chain = start.chain;
      do {
        used_[chain] = true;
        position[firstKey(chain)] = path.size();
        path.push_back(chain);
        const std::uint64_t corner = latticeKey(borders_.last(borders_.chains[chain]));
        if (const auto found = position.find(corner); found != position.end()) {
          const auto cut = path.begin() + static_cast<std::ptrdiff_t>(found->second);
          const Chains ring(cut, path.end());
          path.erase(cut, path.end());
          for (const std::size_t member : ring) position.erase(firstKey(member));
          visit(start.component, ring);
        }
        if (!path.empty()) chain = unusedChainFrom(start.component, corner);
      } while (!path.empty());
    }
  }

 private:
  struct Leaving {
    std::int32_t component;
    std::uint64_t corner;
    std::size_t chain;
    bool operator<(const Leaving& other) const {
      return std::tie(component, corner, chain) <
             std::tie(other.component, other.corner, other.chain);
    }
  };

  std::uint64_t firstKey(std::size_t chain) const {
    return latticeKey(borders_.first(borders_.chains[chain]));
  }

  /// At every corner as many chains of a component leave as arrive, so there is one.
  std::size_t unusedChainFrom(std::int32_t component, std::uint64_t corner) const {
    auto leaving =
        std::lower_bound(leaving_.begin(), leaving_.end(), Leaving{component, corner, 0});
    while (used_[leaving->chain]) ++leaving;
    return leaving->chain;
  }

  const BorderChains& borders_;
  std::vector<Leaving> leaving_;
  std::vector<bool> used_;
};

std::int64_t twiceSignedArea(const BorderChains& borders, const RingWalk::Chains& ring) {
  const LatticePoint origin = borders.first(borders.chains[ring.front()]);
  std::int64_t twice = 0;
  for (const std::size_t index : ring) {
    const BorderChain& chain = borders.chains[index];
    for (std::size_t i = chain.begin + 1; i < chain.end; ++i) {
      twice += cross(origin, borders.points[i - 1], borders.points[i]);
    }
  }
  return twice;
}

Ring placeRing(const BorderChains& borders, const RingWalk::Chains& ring,
               const LatticePlacement& place) {
  Ring placed;
  for (const std::size_t index : ring) {
    const BorderChain& chain = borders.chains[index];
    const EdgeKind kind = chain.right == RegionGrid::kOccupied ? EdgeKind::wall : EdgeKind::open;
    for (std::size_t i = chain.begin; i + 1 < chain.end; ++i) {
      placed.vertices.push_back(place(borders.points[i]));
      placed.kinds.push_back(kind);
    }
  }
  return placed;
}

}  // namespace

std::vector<FreePolygon> assemblePolygons(const BorderChains& borders, int component_count,
                                          const LatticePlacement& place) {
  std::vector<FreePolygon> polygons(static_cast<std::size_t>(component_count));
  RingWalk(borders).forEachRing([&](std::int32_t component, const RingWalk::Chains& ring) {
    FreePolygon& polygon = polygons[static_cast<std::size_t>(component)];
    Ring placed = placeRing(borders, ring, place);
    if (twiceSignedArea(borders, ring) > 0) {
      polygon.outer = std::move(placed);
    } else {
      polygon.holes.push_back(std::move(placed));
    }
  });
  return polygons;
}

std::vector<Polyline> collectWallsBeyond(const BorderChains& borders,
                                         const LatticePlacement& place) {
  std::vector<Polyline> walls;
  for (const BorderChain& chain : borders.chains) {
    if (chain.left >= 0) continue;
    Polyline wall;
    wall.reserve(chain.end - chain.begin);
    for (std::size_t i = chain.begin; i < chain.end; ++i) wall.push_back(place(borders.points[i]));
    walls.push_back(std::move(wall));
  }
  return walls;
}

}  // namespace mrpt_polyloc
