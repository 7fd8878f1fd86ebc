#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/geometry/FreeSpaceSampler.h>

#include <algorithm>
#include <utility>

namespace mrpt_polyloc {

FreeSpaceSampler::FreeSpaceSampler(const PolygonMap& map)
    : FreeSpaceSampler(std::make_shared<const Triangulation>(map)) {}

FreeSpaceSampler::FreeSpaceSampler(std::shared_ptr<const Triangulation> triangulation)
    : triangulation_(std::move(triangulation)) {
  double area = 0.0;
  for (std::size_t i = 0; i < triangulation_->faces().size(); ++i) {
    if (!triangulation_->faces()[i].is_free) continue;
    const auto [a, b, c] = corners(i);
    area += 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    faces_.push_back(i);
    area_until_.push_back(area);
  }
  if (faces_.empty()) throw InvalidMapError("the map has no free space");
}

TPoint2D FreeSpaceSampler::draw(Random& random) const {
  const double at = random.uniform(0.0, area_until_.back());
  const auto found = std::upper_bound(area_until_.begin(), area_until_.end(), at);
  const std::size_t index =
      std::min(static_cast<std::size_t>(found - area_until_.begin()), faces_.size() - 1);
  const auto [a, b, c] = corners(faces_[index]);
  double u = random.unit(), v = random.unit();
  if (u + v > 1.0) {  // the other half of the parallelogram, folded back
    u = 1.0 - u;
    v = 1.0 - v;
  }
  return a + (b - a) * u + (c - a) * v;
}

FreeSpaceSampler::Corners FreeSpaceSampler::corners(std::size_t face) const {
  const auto& vertex = triangulation_->faces()[face].vertex;
  const auto at = [&](std::size_t i) {
    return triangulation_->vertices()[static_cast<std::size_t>(vertex[i])];
  };
  return {at(0), at(1), at(2)};
}

}  // namespace mrpt_polyloc
