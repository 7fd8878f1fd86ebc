#include <mrpt_polyloc/geometry/planar_regions.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <utility>

namespace mrpt_polyloc {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

constexpr int kNoRegion = -1;

/// The pieces grouped by the two nodes they join.
std::vector<PlanarRegions::Border> bordersOf(std::vector<EdgePiece> pieces) {
  const auto ends = [](const EdgePiece& piece) {
    return std::make_pair(std::min(piece.from, piece.to), std::max(piece.from, piece.to));
  };
  std::stable_sort(pieces.begin(), pieces.end(),
                   [&](const EdgePiece& a, const EdgePiece& b) { return ends(a) < ends(b); });
  std::vector<PlanarRegions::Border> borders;
  for (const EdgePiece& piece : pieces) {
    const auto [low, high] = ends(piece);
    if (borders.empty() || borders.back().low_node != low || borders.back().high_node != high) {
      borders.push_back({low, high, {}});
    }
    borders.back().pieces.push_back(piece);
  }
  return borders;
}

int borderBetween(const std::vector<PlanarRegions::Border>& borders, int a, int b) {
  const auto wanted = std::make_pair(std::min(a, b), std::max(a, b));
  const auto found =
      std::lower_bound(borders.begin(), borders.end(), wanted,
                       [](const PlanarRegions::Border& border, const auto& ends) {
                         return std::make_pair(border.low_node, border.high_node) < ends;
                       });
  if (found == borders.end() || found->low_node != wanted.first ||
      found->high_node != wanted.second) {
    return PlanarRegions::kNone;
  }
  return static_cast<int>(found - borders.begin());
}

Cdt triangulate(const PlanarRegions& regions) {
  std::vector<std::pair<Kernel::Point_2, int>> points;
  for (const TPoint2D& p : regions.nodes) {
    points.emplace_back(Kernel::Point_2(p.x, p.y), static_cast<int>(points.size()));
  }
  Cdt cdt;
  cdt.insert(points.begin(), points.end());
  std::vector<Cdt::Vertex_handle> handles(points.size());
  for (const Cdt::Vertex_handle vertex : cdt.finite_vertex_handles()) {
    handles[static_cast<std::size_t>(vertex->info())] = vertex;
  }
  for (const PlanarRegions::Border& border : regions.borders) {
    cdt.insert_constraint(handles[static_cast<std::size_t>(border.low_node)],
                          handles[static_cast<std::size_t>(border.high_node)]);
  }
  return cdt;
}

void copyFaces(Cdt& cdt, PlanarRegions& regions) {
  int count = 0;
  for (const Cdt::Face_handle face : cdt.all_face_handles()) {
    face->info() = cdt.is_infinite(face) ? PlanarRegions::kNone : count++;
  }
  regions.faces.reserve(static_cast<std::size_t>(count));
  for (const Cdt::Face_handle face : cdt.all_face_handles()) {
    if (cdt.is_infinite(face)) continue;
    PlanarRegions::Face copy{};
    copy.region = kNoRegion;
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      copy.node[at] = face->vertex(i)->info();
      copy.neighbor[at] = face->neighbor(i)->info();
      copy.border[at] = PlanarRegions::kNone;
      if (face->is_constrained(i)) {
        copy.border[at] = borderBetween(regions.borders, face->vertex(Cdt::ccw(i))->info(),
                                        face->vertex(Cdt::cw(i))->info());
      }
    }
    regions.faces.push_back(copy);
  }
}

/// Gives the faces in `front`, and all that can be reached from them without crossing a border,
/// one region.
void flood(PlanarRegions& regions, std::vector<int> front, int region) {
  double area = 0.0;
  while (!front.empty()) {
    PlanarRegions::Face& face = regions.faces[static_cast<std::size_t>(front.back())];
    front.pop_back();
    if (face.region != kNoRegion) continue;
    face.region = region;
    const auto corner = [&](std::size_t i) {
      return regions.nodes[static_cast<std::size_t>(face.node[i])];
    };
    area += signedArea({corner(0), corner(1), corner(2)});
    for (std::size_t i = 0; i < 3; ++i) {
      if (face.border[i] == PlanarRegions::kNone && face.neighbor[i] != PlanarRegions::kNone) {
        front.push_back(face.neighbor[i]);
      }
    }
  }
  regions.region_area.push_back(region == 0 ? 0.0 : area);
}

}  // namespace

PlanarRegions cutIntoRegions(const NodedRings& noded) {
  PlanarRegions regions;
  regions.nodes = noded.nodes;
  regions.borders = bordersOf(noded.pieces);
  Cdt cdt = triangulate(regions);
  copyFaces(cdt, regions);

  std::vector<int> outside;
  for (std::size_t f = 0; f < regions.faces.size(); ++f) {
    const PlanarRegions::Face& face = regions.faces[f];
    for (std::size_t i = 0; i < 3; ++i) {
      if (face.neighbor[i] == PlanarRegions::kNone && face.border[i] == PlanarRegions::kNone) {
        outside.push_back(static_cast<int>(f));
      }
    }
  }
  flood(regions, outside, 0);
  for (std::size_t f = 0; f < regions.faces.size(); ++f) {
    if (regions.faces[f].region == kNoRegion) {
      flood(regions, {static_cast<int>(f)}, static_cast<int>(regions.region_area.size()));
    }
  }
  return regions;
}

}  // namespace mrpt_polyloc
