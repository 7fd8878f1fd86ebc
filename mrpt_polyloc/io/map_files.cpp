#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/bitmap_files.h>
#include <mrpt_polyloc/io/file_extension.h>
#include <mrpt_polyloc/io/map_files.h>
#include <mrpt_polyloc/io/map_units.h>
#include <mrpt_polyloc/io/polygon_files.h>
#include <mrpt_polyloc/io/ros_map.h>

namespace mrpt_polyloc {
namespace {

/// Cleans and traces a bitmap, whose file a complaint shall name.
PolygonMap trace(const OccupancyBitmap& bitmap, const std::string& path,
                 const GridMapParams& params) {
  try {
    return traceBitmap(cleanBitmap(bitmap, params.cleaning), params.tracing);
  } catch (const InvalidMapError& error) {
    const std::string extension = contentExtension(path);
    const bool is_ros = extension == ".yaml" || extension == ".yml";
    throw InvalidMapError(path + ": " + error.what() + (is_ros ? ": " + rosMapShares(path) : ""));
  }
}

}  // namespace

RepairedMap loadMap(const std::string& path, const GridMapParams& params, Notes* notes,
                    double scale) {
  if (auto bitmap = loadBitmap(path, notes)) {
    scaleMap(scale, *bitmap);
    requireMetres(path, *bitmap);
    return {trace(*bitmap, path, params), {}, {}};
  }
  const std::string extension = contentExtension(path);
  if (extension == ".geojson" || extension == ".wkt" || extension == ".json" ||
      extension == ".dxf") {
    return loadPolygonMap(path, notes, scale);
  }
  throw FormatError(path, "",
                    "unknown extension '" + extension +
                        "', known for maps are .geojson, .wkt, .json, .yaml, .yml, .gridmap and "
                        ".simplemap");
}

}  // namespace mrpt_polyloc
