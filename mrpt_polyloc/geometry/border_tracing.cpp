#include <mrpt_polyloc/geometry/border_tracing.h>

#include <utility>

namespace mrpt_polyloc {
namespace {

/// Parts and holes up to this area [m2] are crumbs of rounding.
constexpr double kCrumbArea = 1e-12;

class BorderTracer {
 public:
  BorderTracer(const PlanarRegions& regions, const FreeSpaceLabels& labels,
               const std::vector<CleanRing>& rings, const std::vector<bool>& is_wanted)
      : regions_(regions),
        labels_(labels),
        rings_(rings),
        is_wanted_(is_wanted),
        part_(regions.faces.size(), PlanarRegions::kNone),
        is_traced_(3 * regions.faces.size(), false) {}

  std::vector<std::vector<FreePolygon>> run() {
    for (int face = 0; face < static_cast<int>(regions_.faces.size()); ++face) floodPart(face);
    for (std::size_t face = 0; face < regions_.faces.size(); ++face) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (part_[face] != PlanarRegions::kNone && isBorder(face, i) && !is_traced_[3 * face + i]) {
          addRing(traceRing(face, i), static_cast<std::size_t>(part_[face]));
        }
      }
    }
    std::vector<std::vector<FreePolygon>> found(is_wanted_.size());
    for (Part& part : parts_) {
      if (part.free.outer.size() == 0) continue;
      found[static_cast<std::size_t>(part.polygon)].push_back(std::move(part.free));
    }
    return found;
  }

 private:
  struct Part {
    int polygon;
    FreePolygon free;
  };

  const PlanarRegions::Face& faceAt(std::size_t face) const { return regions_.faces[face]; }

  int polygonAt(int region) const { return labels_.free_of[static_cast<std::size_t>(region)]; }

  /// Whether free space ends at edge i of a free face.
  bool isBorder(std::size_t face, std::size_t i) const {
    return polygonAt(regions_.regionAcross(faceAt(face), i)) != polygonAt(faceAt(face).region);
  }

  /// Gives a wanted free face that has none a part, and all faces connected with it the same one.
  void floodPart(int start) {
    const int polygon = polygonAt(faceAt(static_cast<std::size_t>(start)).region);
    if (polygon == FreeSpaceLabels::kNotFree || !is_wanted_[static_cast<std::size_t>(polygon)] ||
        part_[static_cast<std::size_t>(start)] != PlanarRegions::kNone) {
      return;
    }
    parts_.push_back({polygon, {}});
    std::vector<int> front{start};
    while (!front.empty()) {
      const auto face = static_cast<std::size_t>(front.back());
      front.pop_back();
      if (part_[face] != PlanarRegions::kNone) continue;
      part_[face] = static_cast<int>(parts_.size()) - 1;
      for (std::size_t i = 0; i < 3; ++i) {
        if (!isBorder(face, i)) front.push_back(faceAt(face).neighbor[i]);
      }
    }
  }

  /// Walks along the border with free space to the left, at every node staying with the same
  /// sector of free space, until it is back at the edge it started from.
  Ring traceRing(std::size_t face, std::size_t i) {
    Ring ring;
    while (!is_traced_[3 * face + i]) {
      is_traced_[3 * face + i] = true;
      const int node = faceAt(face).node[(i + 1) % 3];
      ring.vertices.push_back(regions_.nodes[static_cast<std::size_t>(node)]);
      ring.kinds.push_back(kindOf(faceAt(face).border[i], polygonAt(faceAt(face).region)));
      const int pivot = faceAt(face).node[(i + 2) % 3];
      i = (i + 1) % 3;  // the edge that leaves the pivot
      while (!isBorder(face, i)) {
        face = static_cast<std::size_t>(faceAt(face).neighbor[i]);
        i = edgeFrom(faceAt(face), pivot);
      }
    }
    return ring;
  }

  static std::size_t edgeFrom(const PlanarRegions::Face& face, int node) {
    std::size_t i = 0;
    while (face.node[(i + 1) % 3] != node) ++i;
    return i;
  }

  EdgeKind kindOf(int border, int polygon) const {
    for (const EdgePiece& piece : regions_.borders[static_cast<std::size_t>(border)].pieces) {
      const auto ring = static_cast<std::size_t>(piece.ring);
      if (rings_[ring].polygon == polygon && piece.kind == EdgeKind::wall &&
          labels_.hole_use[ring] == FreeSpaceLabels::HoleUse::needed) {
        return EdgeKind::wall;
      }
    }
    return EdgeKind::open;
  }

  void addRing(Ring ring, std::size_t part) {
    const double area = signedArea(ring.vertices);
    if (area > kCrumbArea) parts_[part].free.outer = std::move(ring);
    if (area < -kCrumbArea) parts_[part].free.holes.push_back(std::move(ring));
  }

  const PlanarRegions& regions_;
  const FreeSpaceLabels& labels_;
  const std::vector<CleanRing>& rings_;
  const std::vector<bool>& is_wanted_;
  std::vector<int> part_;  // by face: the connected part it belongs to
  std::vector<bool> is_traced_;
  std::vector<Part> parts_;
};

}  // namespace

std::vector<std::vector<FreePolygon>> traceFreeSpace(const PlanarRegions& regions,
                                                     const FreeSpaceLabels& labels,
                                                     const std::vector<CleanRing>& rings,
                                                     const std::vector<bool>& is_wanted) {
  return BorderTracer(regions, labels, rings, is_wanted).run();
}

}  // namespace mrpt_polyloc
