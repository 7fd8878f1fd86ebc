#include "cgal_visibility.h"

#include <mrpt_polyloc/visibility/cgal_compat.h>

#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arr_trapezoid_ric_point_location.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangular_expansion_visibility_2.h>

namespace mrpt_polyloc::test {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Arrangement = CGAL::Arrangement_2<CGAL::Arr_segment_traits_2<Kernel>>;
using Visibility = CGAL::Triangular_expansion_visibility_2<Arrangement, CGAL::Tag_true>;
using Location = CGAL::Arr_trapezoid_ric_point_location<Arrangement>;

}  // namespace

struct CgalVisibility::Impl {
  Arrangement arrangement;
  Location location;
  std::unique_ptr<Visibility> visibility;

  std::optional<Arrangement::Face_handle> see(const TPoint2D& from, Arrangement& seen) const {
    const Kernel::Point_2 query(from.x, from.y);
    const auto found = location.locate(query);
    const auto* face = valueIf<Arrangement::Face_const_handle>(found);
    if (face == nullptr || (*face)->is_unbounded()) return std::nullopt;
    return visibility->compute_visibility(query, *face, seen);
  }
};

CgalVisibility::CgalVisibility(const std::vector<Segment>& segments)
    : impl_(std::make_unique<Impl>()) {
  std::vector<Kernel::Segment_2> curves;
  for (const auto& [a, b] : segments) {
    if (a.x != b.x || a.y != b.y) {
      curves.emplace_back(Kernel::Point_2(a.x, a.y), Kernel::Point_2(b.x, b.y));
    }
  }
  CGAL::insert(impl_->arrangement, curves.begin(), curves.end());
  impl_->location.attach(impl_->arrangement);
  impl_->visibility = std::make_unique<Visibility>(impl_->arrangement);
}

CgalVisibility::~CgalVisibility() = default;

std::size_t CgalVisibility::see(const TPoint2D& from) const {
  Arrangement seen;
  return impl_->see(from, seen) ? seen.number_of_vertices() : 0;
}

std::optional<std::vector<TPoint2D>> CgalVisibility::polygon(const TPoint2D& from) const {
  Arrangement seen;
  const auto face = impl_->see(from, seen);
  if (!face) return std::nullopt;
  std::vector<TPoint2D> polygon;
  auto edge = (*face)->outer_ccb();
  do {
    const Kernel::Point_2& p = edge->target()->point();
    polygon.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()));
  } while (++edge != (*face)->outer_ccb());
  return polygon;
}

std::vector<Segment> borders(const PolygonMap& map) {
  std::vector<Segment> segments;
  for (const Ring* ring : map.rings()) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      segments.emplace_back(ring->vertices[i], ring->vertices[(i + 1) % ring->size()]);
    }
  }
  return segments;
}

std::vector<Segment> wallsAndBox(const PolygonMap& map, const BoundingBox& box) {
  const TPoint2D a = box.min, c = box.max, b{c.x, a.y}, d{a.x, c.y};
  std::vector<Segment> segments{{a, b}, {b, c}, {c, d}, {d, a}};
  for (const Ring* ring : map.rings()) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      if (ring->kinds[i] == EdgeKind::open) continue;
      segments.emplace_back(ring->vertices[i], ring->vertices[(i + 1) % ring->size()]);
    }
  }
  for (const Polyline& wall : map.wallsBeyond()) {
    for (std::size_t i = 1; i < wall.size(); ++i) segments.emplace_back(wall[i - 1], wall[i]);
  }
  return segments;
}

}  // namespace mrpt_polyloc::test
