#include <mrpt_polyloc/geometry/polygon_verdicts.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace mrpt_polyloc {
namespace {

using HoleUse = FreeSpaceLabels::HoleUse;
using Trouble = FreeSpaceLabels::Trouble;

/// Less free space than this [m2] is none.
constexpr double kNoArea = 1e-12;

/// What a defect is called, and its repair.
struct Wording {
  std::string defect;
  std::string repair;
};

const Wording kSelfCrossing{"self-crossing ring", "removed a tiny self-crossing"};
const Wording kHoleCrossing{"hole crossing the outer ring", "cut off a hole at the outer ring"};
const Wording kHolesOverlap{"overlapping holes", "united overlapping holes"};
const Wording kComponentsOverlap{"overlapping components", ""};

Wording wordingOf(const Contact& contact, const std::vector<CleanRing>& rings) {
  const CleanRing& a = rings[static_cast<std::size_t>(contact.ring_a)];
  const CleanRing& b = rings[static_cast<std::size_t>(contact.ring_b)];
  const bool crosses = contact.kind == Contact::Kind::crossing;
  if (a.polygon != b.polygon) {
    return crosses ? kComponentsOverlap : Wording{"components sharing an edge", ""};
  }
  if (contact.ring_a == contact.ring_b) {
    return crosses ? kSelfCrossing
                   : Wording{"ring overlapping itself", "removed an edge of zero width"};
  }
  if (a.is_outer || b.is_outer) {
    return crosses ? kHoleCrossing
                   : Wording{"hole sharing an edge with the outer ring",
                             "joined a hole to the outer ring"};
  }
  return crosses ? kHolesOverlap
                 : Wording{"holes sharing an edge", "united holes that share an edge"};
}

class Judge {
 public:
  Judge(const std::vector<CleanRing>& rings, const NodedRings& noded, const PlanarRegions& regions,
        const FreeSpaceLabels& labels, Findings& findings)
      : rings_(rings),
        noded_(noded),
        regions_(regions),
        labels_(labels),
        findings_(findings),
        is_rebuilt_(labels.free_area.size(), false) {}

  std::vector<bool> run() {
    judgeHoles();
    judgeContacts();
    judgeRegions();
    judgeFreeArea();
    return is_rebuilt_;
  }

 private:
  bool isNeeded(int ring) const {
    return labels_.hole_use[static_cast<std::size_t>(ring)] == HoleUse::needed;
  }

  /// Whether the polygon's crossings hardly matter.
  bool isUnambiguous(int polygon) const {
    const auto p = static_cast<std::size_t>(polygon);
    return labels_.ambiguous_area[p] <=
           std::min(kMaxAmbiguousArea, kMaxAmbiguousFraction * labels_.free_area[p]);
  }

  void judgeHoles() {
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      const TPoint2D& where = rings_[r].ring.vertices[0];
      if (labels_.hole_use[r] == HoleUse::outside) {
        findings_.repaired("hole outside its polygon", "dropped a hole outside its polygon", where);
      } else if (labels_.hole_use[r] == HoleUse::covered) {
        findings_.repaired("hole inside another hole", "dropped a hole inside another hole", where);
      }
    }
  }

  void judgeContacts() {
    for (const Contact& contact : noded_.contacts) {
      if (!isNeeded(contact.ring_a) || !isNeeded(contact.ring_b)) continue;
      const CleanRing& a = rings_[static_cast<std::size_t>(contact.ring_a)];
      const CleanRing& b = rings_[static_cast<std::size_t>(contact.ring_b)];
      const bool are_two_holes = contact.ring_a != contact.ring_b && !a.is_outer && !b.is_outer;
      report(wordingOf(contact, rings_), contact.where, a.polygon,
             a.polygon == b.polygon && (are_two_holes || isUnambiguous(a.polygon)));
    }
  }

  /// What is wrong without two edges crossing: chains that cross at a common vertex, loops run
  /// through twice, components inside one another.
  void judgeRegions() {
    if (labels_.crossed.empty() && labels_.hole_outside.empty() &&
        labels_.overlapping_holes.empty() && labels_.overlapping_polygons.empty()) {
      return;
    }
    indexTroubles();
    for (const Trouble& t : labels_.crossed)
      reportRegion(kSelfCrossing, t, isUnambiguous(t.polygon));
    for (const Trouble& t : labels_.hole_outside) {
      reportRegion(kHoleCrossing, t, isUnambiguous(t.polygon));
    }
    for (const Trouble& t : labels_.overlapping_holes) reportRegion(kHolesOverlap, t, true);
    for (const Trouble& t : labels_.overlapping_polygons) {
      reportRegion(kComponentsOverlap, t, false);
    }
  }

  void judgeFreeArea() {
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      const auto polygon = static_cast<std::size_t>(rings_[r].polygon);
      if (rings_[r].is_outer && labels_.free_area[polygon] <= kNoArea &&
          isUnambiguous(rings_[r].polygon)) {
        findings_.refused("polygon whose holes leave no free space", rings_[r].ring.vertices[0]);
      }
    }
  }

  void report(const Wording& wording, const TPoint2D& where, int polygon, bool is_repaired) {
    if (is_repaired) {
      findings_.repaired(wording.defect, wording.repair, where);
      is_rebuilt_[static_cast<std::size_t>(polygon)] = true;
    } else {
      findings_.refused(wording.defect, where);
    }
  }

  /// Reports a region unless a crossing that is reported already stands at its border.
  void reportRegion(const Wording& wording, const Trouble& trouble, bool is_repaired) {
    is_rebuilt_[static_cast<std::size_t>(trouble.polygon)] = true;
    const std::vector<int>& nodes = nodes_of_[trouble.region];
    const bool is_explained = std::any_of(nodes.begin(), nodes.end(), [&](int node) {
      const TPoint2D& p = regions_.nodes[static_cast<std::size_t>(node)];
      return std::binary_search(crossings_.begin(), crossings_.end(), std::make_pair(p.x, p.y));
    });
    if (!is_explained) report(wording, placeOf(nodes, trouble), trouble.polygon, is_repaired);
  }

  /// Where rings of the polygons meet at the region's border, or else its first node.
  TPoint2D placeOf(const std::vector<int>& nodes, const Trouble& trouble) const {
    const auto is_met = [&](int node) {
      int passes = 0;
      for (const int polygon : {trouble.polygon, trouble.other_polygon}) {
        const auto found = passes_.find({node, polygon});
        if (found != passes_.end()) passes += found->second;
      }
      return passes > 1;
    };
    const auto met = std::find_if(nodes.begin(), nodes.end(), is_met);
    return regions_.nodes[static_cast<std::size_t>(met != nodes.end() ? *met : nodes.front())];
  }

  void indexTroubles() {
    for (const auto* troubles : {&labels_.crossed, &labels_.hole_outside,
                                 &labels_.overlapping_holes, &labels_.overlapping_polygons}) {
      for (const Trouble& trouble : *troubles) nodes_of_[trouble.region];
    }
    for (const PlanarRegions::Face& face : regions_.faces) {
      const auto found = nodes_of_.find(face.region);
      if (found == nodes_of_.end()) continue;
      found->second.insert(found->second.end(), face.node.begin(), face.node.end());
    }
    for (auto& [region, nodes] : nodes_of_) {
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
    for (const EdgePiece& piece : noded_.pieces) {
      if (isNeeded(piece.ring)) {
        ++passes_[{piece.from, rings_[static_cast<std::size_t>(piece.ring)].polygon}];
      }
    }
    for (const Contact& contact : noded_.contacts) {
      if (contact.kind == Contact::Kind::crossing && isNeeded(contact.ring_a) &&
          isNeeded(contact.ring_b)) {
        crossings_.emplace_back(contact.where.x, contact.where.y);
      }
    }
    std::sort(crossings_.begin(), crossings_.end());
  }

  const std::vector<CleanRing>& rings_;
  const NodedRings& noded_;
  const PlanarRegions& regions_;
  const FreeSpaceLabels& labels_;
  Findings& findings_;
  std::vector<bool> is_rebuilt_;
  std::map<int, std::vector<int>> nodes_of_;          // by region with trouble
  std::map<std::pair<int, int>, int> passes_;         // of a polygon's rings through a node
  std::vector<std::pair<double, double>> crossings_;  // places, in order
};

}  // namespace

std::vector<bool> judgePolygons(const std::vector<CleanRing>& rings, const NodedRings& noded,
                                const PlanarRegions& regions, const FreeSpaceLabels& labels,
                                Findings& findings) {
  return Judge(rings, noded, regions, labels, findings).run();
}

void refuseContacts(const std::vector<CleanRing>& rings, const std::vector<Contact>& contacts,
                    Findings& findings) {
  for (const Contact& contact : contacts) {
    findings.refused(wordingOf(contact, rings).defect, contact.where);
  }
}

}  // namespace mrpt_polyloc
