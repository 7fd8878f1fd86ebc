#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/summary_json.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace mrpt_polyloc {

namespace {

using nlohmann::ordered_json;

ordered_json orNull(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json summaryFigures(const Summary& summary) {
  const auto ifAny = [&](double value) {
    return summary.scans == 0 ? ordered_json(nullptr) : ordered_json(value);
  };
  ordered_json json;
  json["scans"] = summary.scans;
  json["top1"] = ifAny(summary.top1);
  json["top5"] = ifAny(summary.top5);
  json["top20"] = ifAny(summary.top20);
  json["in_list"] = ifAny(summary.in_list);
  json["in_ellipse"] = ifAny(summary.in_ellipse);
  json["unique_right"] = orNull(summary.unique_right);
  json["median_error_m"] = orNull(summary.median_error_m);
  json["median_error_deg"] = orNull(summary.median_error_deg);
  json["ms_median"] = ifAny(summary.ms_median);
  json["ms_p90"] = ifAny(summary.ms_p90);
  json["ms_max"] = ifAny(summary.ms_max);
  for (std::size_t i = 0; i < summary.status.size(); ++i)
    json["status"][toString(static_cast<LocalizationStatus>(i))] = summary.status[i];
  return json;
}

/// "%.*f", or nothing where there is no such number.
std::string toField(double value, int digits) {
  if (!std::isfinite(value)) return {};
  return formatted("%.*f", digits, value);
}

/// ",x,y,phi_deg"
std::string poseFields(const mrpt::math::TPose2D& pose) {
  double degrees = std::remainder(pose.phi / kDegree, 360.0);
  if (degrees <= -180.0) degrees = 180.0;
  return "," + toField(pose.x, 6) + "," + toField(pose.y, 6) + "," + toField(degrees, 6);
}

}  // namespace

ordered_json mapStatistics(const PolygonMap& map) {
  ordered_json json;
  json["vertices"] = map.vertexCount();
  json["reflex_vertices"] = map.reflexVertexCount();
  json["holes"] = map.holeCount();
  json["components"] = map.components().size();
  json["area_m2"] = map.area();
  json["perimeter_m"] = map.perimeter();
  json["open_perimeter_m"] = map.openPerimeter();
  json["walls_beyond_m"] = map.wallsBeyondLength();
  return json;
}

ordered_json summaryObject(const Summary& all, const Summary* good, const IndexFigures& index) {
  ordered_json json = summaryFigures(all);
  json["index_build_s"] = index.build_s;
  json["index_mb"] = index.mb;
  if (index.cold_start_s) json["cold_start_s"] = *index.cold_start_s;
  if (good != nullptr) json["good"] = summaryFigures(*good);
  return json;
}

std::string summaryJson(const Summary& all, const Summary* good, const IndexFigures& index,
                        const PolygonMap& map) {
  ordered_json json = summaryObject(all, nullptr, index);
  json["map"] = mapStatistics(map);
  if (good != nullptr) json["good"] = summaryFigures(*good);
  return json.dump(2) + "\n";
}

std::string scansCsv(const std::vector<ScanRecord>& records) {
  std::string csv =
      "row,stamp,status,right_rank,hypotheses,error_m,error_deg,cost,x,y,phi_deg,truth_x,truth_y,"
      "truth_phi_deg,ms\n";
  for (const ScanRecord& record : records) {
    const ScanScore& score = record.score;
    csv += std::to_string(record.row) + "," + toField(record.stamp, 6) + "," +
           toString(score.status) + "," + std::to_string(score.right_rank) + "," +
           std::to_string(record.hypotheses) + "," + toField(score.error_m, 4) + "," +
           toField(score.error_rad / kDegree, 4);
    if (record.answer)
      csv += "," + toField(record.answer->cost, 6) + poseFields(record.answer->pose_map_robot);
    else
      csv += ",,,,";
    csv += poseFields(record.truth) + "," + toField(score.ms, 3) + "\n";
  }
  return csv;
}

}  // namespace mrpt_polyloc
