#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/geometry/constrained_delaunay.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <array>
#include <cstdint>
#include <exception>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

namespace mrpt_polyloc {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;

/// What a CGAL face gathers before it becomes a Triangulation::Face.
struct FaceInfo {
  std::int32_t index = Triangulation::kNone;
  std::array<Passage, 3> passage{Passage::clear, Passage::clear, Passage::clear};
  std::array<std::int32_t, 3> turns{0, 0, 0};  ///< rings with edge i, their left here minus there
  std::int32_t winding = 0;                    ///< of all rings around the face
  bool is_reached = false;
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;
using Cdt = CGAL::Constrained_triangulation_plus_2<Delaunay>;

/// An inserted constraint and what it came from. Walls beyond have no free side.
struct Constraint {
  Cdt::Constraint_id id;
  Passage passage;
  bool is_ring_edge;
};

/// Sorts the numbers of points: sort(begin, end, traits) with CGAL's traits for points by number.
template <class Sort>
std::vector<std::size_t> sorted(const std::vector<Point>& points, Sort&& sort) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (points.empty()) return order;  // a map without walls: CGAL would take its first point
  using Map = CGAL::Pointer_property_map<Point>::const_type;
  sort(order.begin(), order.end(),
       CGAL::Spatial_sort_traits_adapter_2<Kernel, Map>(CGAL::make_property_map(points)));
  return order;
}

/// Inserts many points, each near the last (CGAL's insertion walks), and returns their vertices in
/// the given order.
std::vector<Cdt::Vertex_handle> insertPoints(Cdt& cdt, const std::vector<Point>& points) {
  std::vector<Cdt::Vertex_handle> vertices(points.size());
  Cdt::Face_handle hint;
  const auto order = sorted(points, [](auto begin, auto end, const auto& traits) {
    CGAL::spatial_sort(begin, end, traits);
  });
  for (const std::size_t i : order) {
    vertices[i] = cdt.insert(points[i], hint);
    hint = vertices[i]->face();
  }
  return vertices;
}

/// Gathers the chains of a map as points and edges, then inserts them.
class Chains {
 public:
  void addRing(const Ring& ring) {
    const std::size_t first = points_.size();
    for (const TPoint2D& p : ring.vertices) points_.emplace_back(p.x, p.y);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Passage passage = ring.kinds[i] == EdgeKind::wall ? Passage::wall : Passage::open;
      edges_.push_back({first + i, first + (i + 1) % ring.size(), passage, true});
    }
  }
  void addWall(const Polyline& wall) {
    const std::size_t first = points_.size();
    for (const TPoint2D& p : wall) points_.emplace_back(p.x, p.y);
    for (std::size_t i = 1; i < wall.size(); ++i) {
      edges_.push_back({first + i - 1, first + i, Passage::wall, false});
    }
  }
  std::vector<Constraint> insertInto(Cdt& cdt) const {
    const std::vector<Cdt::Vertex_handle> vertices = insertPoints(cdt, points_);
    std::vector<Constraint> constraints;
    constraints.reserve(edges_.size());
    for (const Edge& edge : edges_) {
      if (vertices[edge.from] == vertices[edge.to]) continue;  // no length, no constraint
      constraints.push_back({cdt.insert_constraint(vertices[edge.from], vertices[edge.to]),
                             edge.passage, edge.is_ring_edge});
    }
    return constraints;
  }

 private:
  struct Edge {
    std::size_t from, to;
    Passage passage;
    bool is_ring_edge;
  };
  std::vector<Point> points_;
  std::vector<Edge> edges_;
};

/// Marks the triangulation edges along each constraint.
void markConstraints(Cdt& cdt, const std::vector<Constraint>& constraints) {
  for (const Constraint& constraint : constraints) {
    auto from = cdt.vertices_in_constraint_begin(constraint.id);
    const auto end = cdt.vertices_in_constraint_end(constraint.id);
    for (auto to = std::next(from); to != end; from = to++) {
      Cdt::Face_handle face;
      int i = 0;
      if (!cdt.is_edge(*from, *to, face, i)) throw InvalidMapError("an edge was lost");
      const auto mark = [&](FaceInfo& info, int edge, bool left) {
        const auto e = static_cast<std::size_t>(edge);
        info.passage[e] = std::max(info.passage[e], constraint.passage);
        if (constraint.is_ring_edge) info.turns[e] += left ? 1 : -1;
      };
      // is_edge() may give either side; the left one has the edge run from i + 1 to i + 2.
      const bool left = face->vertex(Cdt::ccw(i)) == *from;
      mark(face->info(), i, left);
      mark(face->neighbor(i)->info(), cdt.mirror_index(face, i), !left);
    }
  }
}

/// Finds how often the rings wind around each face, from the outside inwards. Rings that share
/// edges (two holes side by side, two components) need no care.
void findWindings(const Cdt& cdt) {
  std::vector<Cdt::Face_handle> stack{cdt.infinite_face()};
  cdt.infinite_face()->info().is_reached = true;
  while (!stack.empty()) {
    const Cdt::Face_handle face = stack.back();
    stack.pop_back();
    for (int i = 0; i < 3; ++i) {
      FaceInfo& next = face->neighbor(i)->info();
      if (next.is_reached) continue;
      next.is_reached = true;
      next.winding = face->info().winding - face->info().turns[static_cast<std::size_t>(i)];
      stack.push_back(face->neighbor(i));
    }
  }
}

/// The finite faces along a space-filling curve: neighbours in space mostly are in memory too,
/// which walks and expansions live on.
std::vector<Cdt::Face_handle> facesInOrder(const Cdt& cdt) {
  std::vector<Cdt::Face_handle> faces;
  std::vector<Point> centers;
  for (const Cdt::Face_handle f : cdt.finite_face_handles()) {
    faces.push_back(f);
    centers.push_back(CGAL::centroid(cdt.triangle(f)));
  }
  std::vector<Cdt::Face_handle> ordered;
  ordered.reserve(faces.size());
  const auto order = sorted(centers, [](auto begin, auto end, const auto& traits) {
    CGAL::hilbert_sort(begin, end, traits);
  });
  for (const std::size_t i : order) ordered.push_back(faces[i]);
  return ordered;
}

std::pair<std::vector<TPoint2D>, std::vector<Triangulation::Face>> flatten(const Cdt& cdt) {
  const std::vector<Cdt::Face_handle> ordered = facesInOrder(cdt);
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    ordered[i]->info().index = static_cast<std::int32_t>(i);
  }
  std::vector<TPoint2D> vertices;
  vertices.reserve(cdt.number_of_vertices());
  for (const Cdt::Vertex_handle v : cdt.finite_vertex_handles()) v->info() = Triangulation::kNone;
  std::vector<Triangulation::Face> faces;
  faces.reserve(ordered.size());
  for (const Cdt::Face_handle f : ordered) {
    Triangulation::Face face{};
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Cdt::Vertex_handle v = f->vertex(i);
      if (v->info() == Triangulation::kNone) {
        v->info() = static_cast<std::int32_t>(vertices.size());
        vertices.emplace_back(v->point().x(), v->point().y());
      }
      face.vertex[k] = v->info();
      const Cdt::Face_handle neighbor = f->neighbor(i);
      face.neighbor[k] = cdt.is_infinite(neighbor) ? Triangulation::kNone : neighbor->info().index;
      face.passage[k] = f->info().passage[k];
    }
    face.is_free = f->info().winding > 0;
    faces.push_back(face);
  }
  return {std::move(vertices), std::move(faces)};
}

std::pair<std::vector<TPoint2D>, std::vector<Triangulation::Face>> triangulate(
    const Chains& chains, const BoundingBox& box) {
  try {
    Cdt cdt;
    cdt.insert(Point(box.min.x, box.min.y));
    cdt.insert(Point(box.max.x, box.min.y));
    cdt.insert(Point(box.max.x, box.max.y));
    cdt.insert(Point(box.min.x, box.max.y));
    markConstraints(cdt, chains.insertInto(cdt));
    findWindings(cdt);
    return flatten(cdt);
  } catch (const std::exception& e) {
    throw InvalidMapError(std::string("the map cannot be triangulated: ") + e.what());
  }
}

}  // namespace

std::pair<std::vector<TPoint2D>, std::vector<Triangulation::Face>> constrainedDelaunay(
    const PolygonMap& map, const BoundingBox& box) {
  Chains chains;
  for (const Ring* ring : map.rings()) chains.addRing(*ring);
  for (const Polyline& wall : map.wallsBeyond()) chains.addWall(wall);
  return triangulate(chains, box);
}

}  // namespace mrpt_polyloc
