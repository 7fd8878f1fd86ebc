#include <mrpt_polyloc/io/result_json.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <vector>

namespace mrpt_polyloc {

using nlohmann::ordered_json;

namespace {

ordered_json regionsJson(const std::vector<PoseRegion>& all, std::size_t most) {
  std::vector<const PoseRegion*> regions;
  for (const PoseRegion& region : all) regions.push_back(&region);
  std::stable_sort(regions.begin(), regions.end(),
                   [](const PoseRegion* a, const PoseRegion* b) { return a->bound < b->bound; });
  regions.resize(std::min(regions.size(), most));
  ordered_json list = ordered_json::array();
  for (const PoseRegion* region : regions) {
    ordered_json polygon = ordered_json::array();
    for (const mrpt::math::TPoint2D& p : region->polygon) polygon.push_back({p.x, p.y});
    list.push_back({{"polygon", std::move(polygon)},
                    {"first_heading", region->first_heading},
                    {"last_heading", region->last_heading},
                    {"bound", region->bound}});
  }
  return list;
}

}  // namespace

ordered_json toJson(const Hypothesis& hypothesis) {
  ordered_json covariance = ordered_json::array();
  for (int row = 0; row < 3; ++row) {
    covariance.push_back({hypothesis.covariance(row, 0), hypothesis.covariance(row, 1),
                          hypothesis.covariance(row, 2)});
  }
  const mrpt::math::TPose2D& pose = hypothesis.pose_map_robot;
  return {{"x", pose.x},
          {"y", pose.y},
          {"phi", pose.phi},
          {"weight", hypothesis.weight},
          {"cost", hypothesis.cost},
          {"covariance", std::move(covariance)}};
}

ordered_json toJson(const LocalizationResult& result, std::size_t most_regions) {
  ordered_json json = {{"status", toString(result.status)},
                       {"match", result.match_probability},
                       {"listed", result.listed},
                       {"hypotheses", ordered_json::array()},
                       {"certificate", nullptr}};
  for (const Hypothesis& hypothesis : result.hypotheses) {
    json["hypotheses"].push_back(toJson(hypothesis));
  }
  if (result.certificate) {
    const SettledRegions& settled = result.certificate->settled;
    json["certificate"] = {{"cost", result.certificate->cost},
                           {"complete", result.certificate->is_complete},
                           {"regions", result.certificate->regions},
                           {"least", result.certificate->least},
                           {"at_least", result.certificate->at_least},
                           {"bounded", settled.bounded},
                           {"distant", settled.distant},
                           {"lowered", settled.lowered},
                           {"drained", settled.drained},
                           {"undecided", settled.undecided}};
  }
  json["statistics"] = {{"evaluated", result.statistics.evaluated},
                        {"refined", result.statistics.refined},
                        {"search_ms", result.statistics.search_ms},
                        {"refinement_ms", result.statistics.refinement_ms}};
  if (!result.regions.empty()) json["regions"] = regionsJson(result.regions, most_regions);
  return json;
}

std::string hashText(std::uint64_t hash) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

}  // namespace mrpt_polyloc
