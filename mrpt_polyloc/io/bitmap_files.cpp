#include <mrpt_polyloc/io/bitmap_files.h>
#include <mrpt_polyloc/io/file_extension.h>
#include <mrpt_polyloc/io/grid_maps.h>
#include <mrpt_polyloc/io/ros_map.h>

namespace mrpt_polyloc {

std::optional<OccupancyBitmap> loadBitmap(const std::string& path, Notes* notes) {
  const std::string extension = contentExtension(path);
  if (extension == ".yaml" || extension == ".yml") return loadRosMap(path, notes);
  if (extension == ".gridmap") return loadGridMap(path);
  if (extension == ".simplemap") return loadSimpleMap(path);
  return std::nullopt;
}

}  // namespace mrpt_polyloc
