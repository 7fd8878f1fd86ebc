#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/io/map_units.h>

#include <algorithm>
#include <cmath>

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
  throw FormatError(path, "",
                    formatted("the free space is %.3g square kilometres: is the map in "
                              "millimetres? Then use --scale 0.001, or --scale F for F metres a "
                              "unit",
                              area / 1e6));
}

}  // namespace

void scaleMap(double scale, RawMap& map) {
  requirePositive("scale", scale);
  forEachVertex(map, [scale](TPoint2D& p) { p = {p.x * scale, p.y * scale}; });
  map.cell_size *= scale;
}

void scaleMap(double scale, OccupancyBitmap& bitmap) {
  requirePositive("scale", scale);
  bitmap.resolution *= scale;
  bitmap.pose_map_bitmap.x *= scale;
  bitmap.pose_map_bitmap.y *= scale;
}

void requireMetres(const std::string& path, const RawMap& map) {
  requireModestArea(path, freeAreaOf(map));
  BoundingBox box = BoundingBox::empty();
  for (const RawPolygon& polygon : map.polygons) {
    box.include(BoundingBox::of(polygon.outer.vertices));
  }
  if (box.isEmpty()) return;
  const BoundingBox globe{{-kGreatestDegree, -kGreatestDegree}, {kGreatestDegree, kGreatestDegree}};
  const double extent = std::max(box.width(), box.height());
  const bool within = globe.contains(box.min) && globe.contains(box.max);
  if (!within || !(extent < kLeastExtent) || extent == 0.0) return;
  throw FormatError(
      path, "",
      formatted("it measures %.3g by %.3g at (%.3g, %.3g): are its coordinates degrees of "
                "longitude and latitude? A map is in metres: project it, as by: ogr2ogr -t_srs "
                "EPSG:32632 OUT.geojson IN.geojson (with the UTM zone of the place); if it is in "
                "another unit, use --scale F for F metres a unit",
                box.width(), box.height(), box.min.x, box.min.y));
}

void requireMetres(const std::string& path, const OccupancyBitmap& bitmap) {
  const auto free = std::count(bitmap.cells.begin(), bitmap.cells.end(), CellState::free);
  requireModestArea(path, static_cast<double>(free) * bitmap.resolution * bitmap.resolution);
}

}  // namespace mrpt_polyloc
