#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/visibility/cgal_compat.h>
#include <mrpt_polyloc/visibility/segment_arrangement.h>

#include <CGAL/Arr_curve_data_traits_2.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_2;
using Line = Kernel::Line_2;
using Segment = Kernel::Segment_2;

/// What lies along an edge: numbers of critical segments, kBoundary or kDivider. Nearly always one,
/// which must not cost an allocation; a sorted list where segments overlap.
class CurveIds {
 public:
  CurveIds(int id = 0) : first_(id) {}  // NOLINT(google-explicit-constructor): CGAL makes copies
  CurveIds(const CurveIds& a, const CurveIds& b) {
    std::vector<int> all;
    const auto add = [&all](int id) { all.push_back(id); };
    a.forEach(add);
    b.forEach(add);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    first_ = all.front();
    all.erase(all.begin());
    if (!all.empty()) others_ = std::make_shared<const std::vector<int>>(std::move(all));
  }

  template <class Visitor>
  void forEach(Visitor&& visit) const {
    visit(first_);
    if (!others_) return;
    for (const int id : *others_) visit(id);
  }

  bool operator==(const CurveIds& other) const {
    if (first_ != other.first_ || !others_ != !other.others_) return false;
    return !others_ || *others_ == *other.others_;
  }

 private:
  int first_;
  std::shared_ptr<const std::vector<int>> others_;
};

struct MergeIds {
  CurveIds operator()(const CurveIds& a, const CurveIds& b) const { return {a, b}; }
};

using Traits =
    CGAL::Arr_curve_data_traits_2<CGAL::Arr_segment_traits_2<Kernel>, CurveIds, MergeIds>;
using Dcel = CGAL::Arr_extended_dcel<Traits, std::int32_t, char, std::int32_t>;
using Arrangement = CGAL::Arrangement_2<Traits, Dcel>;

// Boundary edges toggle between free and not: where two coincide, they must count twice, so each
// has a number of its own, kBoundary and below.
constexpr int kDivider = -1;
constexpr int kBoundary = -2;

constexpr std::int32_t kUnseen = -2;
constexpr std::int32_t kOutside = -1;

Point toPoint(const TPoint2D& p) {
  return {p.x, p.y};
}

Segment exactSegment(const CriticalSegment& s, const std::vector<TPoint2D>& vertices) {
  const auto at = [&](std::int32_t v) { return toPoint(vertices[static_cast<std::size_t>(v)]); };
  if (s.right == s.left) return {at(s.blocker), at(s.right)};
  const auto meeting =
      CGAL::intersection(Line(at(s.behind), at(s.blocker)), Line(at(s.right), at(s.left)));
  const Point* end = meeting ? valueIf<Point>(*meeting) : nullptr;
  if (end == nullptr) throw InvalidMapError("a critical segment does not meet the edge it ends on");
  return {at(s.blocker), *end};
}

bool togglesFreedom(Arrangement::Halfedge_const_handle h) {
  bool toggles = false;
  h->curve().data().forEach([&](int id) { toggles ^= id <= kBoundary; });
  return toggles;
}

/// Calls visit(halfedge) for every halfedge on the border of a face.
template <class Visitor>
void forEachBorder(Arrangement::Face_handle face, Visitor&& visit) {
  const auto around = [&](Arrangement::Ccb_halfedge_circulator first) {
    auto h = first;
    do visit(Arrangement::Halfedge_handle(h));
    while (++h != first);
  };
  for (auto c = face->outer_ccbs_begin(); c != face->outer_ccbs_end(); ++c) around(*c);
  for (auto c = face->inner_ccbs_begin(); c != face->inner_ccbs_end(); ++c) around(*c);
}

/// Numbers the free faces, from the outside inwards, so that neighbours get near numbers.
std::vector<Arrangement::Face_handle> freeFaces(Arrangement& arrangement) {
  std::vector<Arrangement::Face_handle> free, stack;
  for (auto f = arrangement.faces_begin(); f != arrangement.faces_end(); ++f) f->set_data(kUnseen);
  arrangement.unbounded_face()->set_data(kOutside);
  stack.push_back(arrangement.unbounded_face());
  while (!stack.empty()) {
    const Arrangement::Face_handle face = stack.back();
    stack.pop_back();
    const bool is_free = face->data() != kOutside;
    forEachBorder(face, [&](Arrangement::Halfedge_handle h) {
      const Arrangement::Face_handle next = h->twin()->face();
      if (next->data() != kUnseen) return;
      if (is_free != togglesFreedom(h)) {
        next->set_data(static_cast<std::int32_t>(free.size()));
        free.push_back(next);
      } else {
        next->set_data(kOutside);
      }
      stack.push_back(next);
    });
  }
  return free;
}

/// \param segment_rises whether a critical segment runs upwards in the order of x, then y
ArrangedFaces flatten(Arrangement& arrangement, const std::vector<bool>& segment_rises) {
  ArrangedFaces flat;
  for (auto v = arrangement.vertices_begin(); v != arrangement.vertices_end(); ++v) {
    v->set_data(kUnseen);
  }
  const std::vector<Arrangement::Face_handle> faces = freeFaces(arrangement);
  flat.first.reserve(faces.size() + 1);
  for (const Arrangement::Face_handle face : faces) {
    flat.first.push_back(static_cast<std::uint32_t>(flat.edges.size()));
    forEachBorder(face, [&](Arrangement::Halfedge_handle h) {
      const Arrangement::Vertex_handle from = h->source();
      if (from->data() == kUnseen) {
        from->set_data(static_cast<std::int32_t>(flat.vertices.size()));
        flat.vertices.emplace_back(CGAL::to_double(from->point().x()),
                                   CGAL::to_double(from->point().y()));
      }
      const bool is_border = togglesFreedom(h);
      flat.edges.push_back({from->data(), is_border ? kOutside : h->twin()->face()->data(),
                            static_cast<std::uint32_t>(flat.windows.size())});
      const bool rises = h->direction() == CGAL::ARR_LEFT_TO_RIGHT;
      h->curve().data().forEach([&](int id) {
        if (id < 0) return;
        flat.windows.push_back(rises == segment_rises[static_cast<std::size_t>(id)] ? id + 1
                                                                                    : -(id + 1));
      });
    });
  }
  flat.first.push_back(static_cast<std::uint32_t>(flat.edges.size()));
  flat.edges.push_back({kOutside, kOutside, static_cast<std::uint32_t>(flat.windows.size())});
  flat.vertices.shrink_to_fit();
  flat.edges.shrink_to_fit();
  flat.windows.shrink_to_fit();
  return flat;
}

}  // namespace

ArrangedFaces arrangeSegments(const std::vector<TPoint2D>& vertices,
                              const std::vector<std::pair<std::int32_t, std::int32_t>>& boundary,
                              const std::vector<std::pair<std::int32_t, std::int32_t>>& dividers,
                              const std::vector<CriticalSegment>& segments) {
  try {
    const auto between = [&](const std::pair<std::int32_t, std::int32_t>& edge) {
      return Segment(toPoint(vertices[static_cast<std::size_t>(edge.first)]),
                     toPoint(vertices[static_cast<std::size_t>(edge.second)]));
    };
    std::vector<bool> rises;
    rises.reserve(segments.size());
    std::vector<Traits::Curve_2> curves;
    curves.reserve(boundary.size() + dividers.size() + segments.size());
    for (std::size_t i = 0; i < boundary.size(); ++i) {
      curves.emplace_back(between(boundary[i]), kBoundary - static_cast<int>(i));
    }
    for (const auto& edge : dividers) curves.emplace_back(between(edge), kDivider);
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const Segment exact = exactSegment(segments[i], vertices);
      rises.push_back(CGAL::compare_xy(exact.source(), exact.target()) == CGAL::SMALLER);
      curves.emplace_back(exact, static_cast<int>(i));
    }
    Arrangement arrangement;
    CGAL::insert(arrangement, curves.begin(), curves.end());
    curves = {};
    return flatten(arrangement, rises);
  } catch (const std::exception& e) {
    throw InvalidMapError(std::string("the map cannot be divided into cells: ") + e.what());
  }
}

}  // namespace mrpt_polyloc
