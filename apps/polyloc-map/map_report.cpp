#include "map_report.h"

#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/summary_json.h>
#include <mrpt_polyloc/io/polygon_files.h>

namespace mrpt_polyloc::apps {
namespace {

using nlohmann::ordered_json;

template <class Finding>  // Defect or Repair
ordered_json toJson(const std::vector<Finding>& findings) {
  ordered_json list = ordered_json::array();
  for (const Finding& finding : findings) {
    list.push_back({{"what", finding.what}, {"x", finding.where.x}, {"y", finding.where.y}});
  }
  return list;
}

}  // namespace

ordered_json jsonReport(const RepairedMap& loaded) {
  ordered_json report;
  report["valid"] = loaded.defects.empty();
  report["defects"] = toJson(loaded.defects);
  report["repairs"] = toJson(loaded.repairs);
  report.update(mapStatistics(loaded.map));
  return report;
}

ordered_json jsonReport(const std::vector<Defect>& defects) {
  ordered_json report;
  report["valid"] = false;
  report["defects"] = toJson(defects);
  report["repairs"] = ordered_json::array();
  return report;
}

std::vector<Defect> defectsOfFile(const std::string& path) {
  try {
    return inspectMap(readRawMap(path)).defects;
  } catch (const FormatError&) {  // a grid: what is wrong with it has no place of its own
    return {};
  }
}

std::string defectList(const std::vector<Defect>& defects) {
  std::string list;
  for (const Defect& defect : defects) list += "defect: " + toString(defect) + "\n";
  return list;
}

std::string textReport(const PolygonMap& map) {
  return formatted(
      "vertices      %zu (%zu reflex)\n"
      "components    %zu, holes %zu\n"
      "area          %.2f m2\n"
      "perimeter     %.2f m, of which open %.2f m\n"
      "walls beyond  %.2f m\n",
      map.vertexCount(), map.reflexVertexCount(), map.components().size(), map.holeCount(),
      map.area(), map.perimeter(), map.openPerimeter(), map.wallsBeyondLength());
}

}  // namespace mrpt_polyloc::apps
