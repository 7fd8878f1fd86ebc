#include "map_input.h"

#include <mrpt_polyloc/io/map_files.h>

#include <algorithm>

namespace mrpt_polyloc::apps {

const char* const kMapFormats =
    "The map: .geojson, .wkt, HouseExpo .json, ROS .yaml, MRPT .gridmap or "
    ".simplemap, each plain, gzip or zstd";

void warnOfRepairs(const Program& program, const std::string& path,
                   const std::vector<Repair>& repairs) {
  constexpr std::size_t kMostWarnings = 10;
  const std::size_t shown = std::min(kMostWarnings, repairs.size());
  for (std::size_t i = 0; i < shown; ++i) {
    program.warn(path + ": " + toString(Defect{repairs[i].what, repairs[i].where}));
  }
  if (shown < repairs.size()) {
    program.warn(path + ": and " + std::to_string(repairs.size() - shown) + " more repairs");
  }
}

void addScaleOption(CLI::App& cli, double& scale) {
  addNumber(cli, "--scale", scale, {0.0, 1e6, true},
            "Metres per unit of the map's file, as 0.001 for millimetres [default: 1]")
      ->type_name("F");
}

RepairedMap loadMapWithWarnings(const Program& program, const std::string& path, double scale) {
  Notes notes;
  RepairedMap loaded = loadMap(path, {}, &notes, scale);
  program.note(path, notes);
  warnOfRepairs(program, path, loaded.repairs);
  return loaded;
}

}  // namespace mrpt_polyloc::apps
