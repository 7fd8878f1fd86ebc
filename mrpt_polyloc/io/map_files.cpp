#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/bitmap_files.h>
#include <mrpt_polyloc/io/file_extension.h>
#include <mrpt_polyloc/io/map_files.h>
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

RepairedMap loadMap(const std::string& path, const GridMapParams& params, Notes* notes) {
  if (const auto bitmap = loadBitmap(path, notes)) return {trace(*bitmap, path, params), {}, {}};
  const std::string extension = contentExtension(path);
  if (extension == ".geojson" || extension == ".wkt" || extension == ".json") {
    return loadPolygonMap(path);
  }
  throw FormatError(path, "",
                    "unknown extension '" + extension +
                        "', known for maps are .geojson, .wkt, .json, .yaml, .yml, .gridmap and "
                        ".simplemap");
}

}  // namespace mrpt_polyloc
