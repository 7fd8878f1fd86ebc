#pragma once

#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/Triangulation.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace mrpt_polyloc {

/// Random points of the free space of a map, uniform by area. O(log n) a point; thread-safe.
class POLYLOC_EXPORT FreeSpaceSampler {
 public:
  /// \throws InvalidMapError if the map has no free space
  explicit FreeSpaceSampler(const PolygonMap& map);
  /// The same with a triangulation made before.
  explicit FreeSpaceSampler(std::shared_ptr<const Triangulation> triangulation);

  /// [m] Takes three numbers of the stream.
  TPoint2D draw(Random& random) const;

 private:
  struct Corners {
    TPoint2D a, b, c;
  };
  Corners corners(std::size_t face) const;

  std::shared_ptr<const Triangulation> triangulation_;
  std::vector<std::size_t> faces_;
  std::vector<double> area_until_;  ///< of the free faces up to and with this one [m2]
};

}  // namespace mrpt_polyloc
