#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/exact/ObservedPolygon.h>
#include <mrpt_polyloc/localization/exact/SkeletonClasses.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// Coordinates are known to this share of the greatest one: rounding of motions over the map.
constexpr double kRounding = 1e-13;

double toleranceOfClasses(const VisibilityCells& cells, double tolerance) {
  const BoundingBox& box = cells.triangulation().box();
  const double greatest = std::max(
      {std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x), std::abs(box.max.y)});
  return std::max(1e-3 * tolerance, kRounding * greatest);
}

/// What skeletons of so many gaps may differ by in the length of their ring, if vertices may be
/// apart so far.
double ringSlack(std::size_t gaps, double tolerance) {
  return 2.0 * tolerance * static_cast<double>(gaps);
}

}  // namespace

VisibilitySkeleton SkeletonClasses::skeletonAt(std::uint32_t place, ViewExpander& expander) const {
  if (place < cells_->size()) return skeletonOf(*cells_, place, expander, 2.0 * tolerance_);
  const TPoint2D& point = tied_[place - cells_->size()];
  // In line with several vertices: told apart by geometry, as what is seen will be.
  std::vector<TPoint2D> polygon =
      visibilityPolygon(cells_->triangulation(), expander.expand(point));
  for (TPoint2D& vertex : polygon) vertex = vertex - point;
  std::vector<VisibilitySkeleton::Gap> gaps =
      ObservedPolygon(polygon, tolerance_).skeleton().gaps();
  for (VisibilitySkeleton::Gap& gap : gaps) {
    gap.vertex = gap.vertex + point;
    gap.a = gap.a + point;
    gap.b = gap.b + point;
  }
  return VisibilitySkeleton(std::move(gaps));
}

std::vector<SkeletonClasses::Class> SkeletonClasses::sortedPlaces() const {
  ViewExpander expander(cells_->triangulation(), true);
  std::vector<Class> places;
  for (std::uint32_t place = 0; place < cells_->size() + tied_.size(); ++place) {
    try {
      const VisibilitySkeleton skeleton = skeletonAt(place, expander);
      places.push_back({skeleton.key(), skeleton.ringLength(), place, 0});
    } catch (const InvalidParamsError&) {
      // Too close to a wall to see around: no robot answers from there.
    }
  }
  std::sort(places.begin(), places.end(), [](const Class& a, const Class& b) {
    return std::tie(a.key, a.ring_length, a.place) < std::tie(b.key, b.ring_length, b.place);
  });
  return places;
}

SkeletonClasses::SkeletonClasses(const VisibilityCells& cells, double tolerance)
    : cells_(&cells), tolerance_(tolerance), tied_(cells.tiedPoints(tolerance)) {
  ViewExpander expander(cells.triangulation(), true);
  const double class_tolerance = toleranceOfClasses(cells, tolerance);
  struct Member {
    std::size_t index;
    std::uint32_t place;
    mrpt::math::TPose2D motion;
  };
  std::vector<Member> members;
  struct Open {  // a class that places to come may belong to
    std::size_t index;
    VisibilitySkeleton skeleton;
  };
  std::vector<Open> open;
  for (const Class& place : sortedPlaces()) {
    const VisibilitySkeleton skeleton = skeletonAt(place.place, expander);
    const auto isPast = [&](const Open& o) {
      return o.skeleton.key() != place.key ||
             o.skeleton.ringLength() + ringSlack(skeleton.size(), class_tolerance) <
                 place.ring_length;
    };
    open.erase(std::remove_if(open.begin(), open.end(), isPast), open.end());
    Member member{classes_.size(), place.place, {0, 0, 0}};
    for (const Open& o : open) {
      const auto motions = alignments(o.skeleton, skeleton, class_tolerance);
      if (motions.empty()) continue;
      member = {o.index, place.place, motions.front()};
      break;
    }
    if (member.index == classes_.size()) {
      classes_.push_back(place);
      open.push_back({member.index, skeleton});
    }
    members.push_back(member);
  }
  std::sort(members.begin(), members.end(), [](const Member& a, const Member& b) {
    return std::tie(a.index, a.place) < std::tie(b.index, b.place);
  });
  for (const Member& member : members) {
    if (embeddings_.empty() || member.index != members[embeddings_.size() - 1].index) {
      classes_[member.index].first_embedding = static_cast<std::uint32_t>(embeddings_.size());
    }
    const bool is_cell = member.place < cells.size();
    embeddings_.push_back(
        {is_cell ? static_cast<std::int32_t>(member.place) : VisibilityCells::kNone,
         member.motion});
  }
}

VisibilitySkeleton SkeletonClasses::skeleton(std::size_t index, ViewExpander& expander) const {
  return skeletonAt(classes_[index].place, expander);
}

std::vector<SkeletonClasses::Match> SkeletonClasses::find(const VisibilitySkeleton& seen,
                                                          ViewExpander& expander) const {
  // The fit over all vertices may leave one off by twice the tolerance, and classes are not exact.
  const double apart = 4.0 * tolerance_;
  const double slack = ringSlack(seen.size(), apart);
  const auto isBefore = [](const Class& a, const std::pair<std::uint64_t, double>& b) {
    return std::make_pair(a.key, a.ring_length) < b;
  };
  auto it = std::lower_bound(classes_.begin(), classes_.end(),
                             std::make_pair(seen.key(), seen.ringLength() - slack), isBefore);
  std::vector<Match> matches;
  for (; it != classes_.end() && it->key == seen.key() &&
         it->ring_length <= seen.ringLength() + slack;
       ++it) {
    for (const auto& motion : alignments(seen, skeletonAt(it->place, expander), apart)) {
      matches.push_back({static_cast<std::size_t>(it - classes_.begin()), motion});
    }
  }
  return matches;
}

std::size_t SkeletonClasses::memory() const {
  return classes_.capacity() * sizeof(Class) + embeddings_.capacity() * sizeof(Embedding) +
         tied_.capacity() * sizeof(TPoint2D);
}

}  // namespace mrpt_polyloc
