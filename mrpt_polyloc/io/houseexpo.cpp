#include <mrpt_polyloc/io/houseexpo.h>
#include <mrpt_polyloc/io/json_input.h>

namespace mrpt_polyloc {

RawMap parseHouseExpo(const std::string& text, const std::string& file) {
  const nlohmann::json document = parseJson(text, file);
  RawMap map;
  map.polygons.push_back({wallRing(JsonAt(document, "", file).member("verts").points()), {}});
  return map;
}

}  // namespace mrpt_polyloc
