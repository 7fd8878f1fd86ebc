#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/io/map_units.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace mrpt_polyloc {
namespace {

constexpr double kGreatestDegree = 180.0;
constexpr double kLeastExtent = 0.1;  // 11 km on a meridian, and no map in metres

template <class Take>
void forEachVertex(RawMap& map, const Take& take) {
  for (RawPolygon& polygon : map.polygons) {
    for (TPoint2D& p : polygon.outer.vertices) take(p);
    for (Ring& hole : polygon.holes) {
      for (TPoint2D& p : hole.vertices) take(p);
    }
  }
  for (Polyline& line : map.walls_beyond) {
    for (TPoint2D& p : line) take(p);
  }
}

double areaOf(const Ring& ring) {
  double twice = 0.0;
  const std::size_t n = ring.size();
  if (n == 0) return 0.0;
  const TPoint2D& origin = ring.vertices.front();  // for coordinates far from 0
  for (std::size_t i = 0; i < n; ++i) {
    const TPoint2D a = ring.vertices[i] - origin, b = ring.vertices[(i + 1) % n] - origin;
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * std::abs(twice);
}

double freeAreaOf(const RawMap& map) {
  double area = 0.0;
  for (const RawPolygon& polygon : map.polygons) {
    area += areaOf(polygon.outer);
    for (const Ring& hole : polygon.holes) area -= areaOf(hole);
  }
  return area;
}

void requireModestArea(const std::string& path, double area) {
  if (!(area > kGreatestFreeArea) || !std::isfinite(area)) return;
  std::ostringstream reason;
  reason.precision(3);
  reason << "the free space is " << area / 1e6
         << " square kilometres: is the map in millimetres? Then use --scale 0.001, or --scale F "
            "for F metres a unit";
  throw FormatError(path, "", reason.str());
}

}  // namespace

void scaleMap(double scale, RawMap& map) {
  requirePositive("scale", scale);
  forEachVertex(map, [scale](TPoint2D& p) { p = {p.x * scale, p.y * scale}; });
}

void scaleMap(double scale, OccupancyBitmap& bitmap) {
  requirePositive("scale", scale);
  bitmap.resolution *= scale;
  bitmap.pose_map_bitmap.x *= scale;
  bitmap.pose_map_bitmap.y *= scale;
}

void requireMetres(const std::string& path, const RawMap& map) {
  requireModestArea(path, freeAreaOf(map));
  double low_x = std::numeric_limits<double>::max(), low_y = low_x, high_x = -low_x,
         high_y = -low_x;
  for (const RawPolygon& polygon : map.polygons) {
    for (const TPoint2D& p : polygon.outer.vertices) {
      low_x = std::min(low_x, p.x), high_x = std::max(high_x, p.x);
      low_y = std::min(low_y, p.y), high_y = std::max(high_y, p.y);
    }
  }
  if (low_x > high_x) return;  // nothing there
  const double extent = std::max(high_x - low_x, high_y - low_y);
  const bool within = low_x >= -kGreatestDegree && high_x <= kGreatestDegree &&
                      low_y >= -kGreatestDegree && high_y <= kGreatestDegree;
  if (!within || !(extent < kLeastExtent) || extent == 0.0) return;
  std::ostringstream reason;
  reason.precision(3);
  reason
      << "it measures " << high_x - low_x << " by " << high_y - low_y << " at (" << low_x << ", "
      << low_y << "): are its coordinates degrees of longitude and latitude? A map is in metres: "
      << "project it, as by: ogr2ogr -t_srs EPSG:32632 OUT.geojson IN.geojson (with the UTM zone "
      << "of the place); if it is in another unit, use --scale F for F metres a unit";
  throw FormatError(path, "", reason.str());
}

void requireMetres(const std::string& path, const OccupancyBitmap& bitmap) {
  const auto free = std::count(bitmap.cells.begin(), bitmap.cells.end(), CellState::free);
  requireModestArea(path, static_cast<double>(free) * bitmap.resolution * bitmap.resolution);
}

}  // namespace mrpt_polyloc
