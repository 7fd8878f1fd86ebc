#include "travel_report.h"

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/Summary.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mrpt_polyloc::apps {
namespace {

using nlohmann::ordered_json;

ordered_json percentiles(const std::vector<double>& values, bool with_max = true) {
  if (values.empty()) return nullptr;
  ordered_json json{{"median", percentile(values, 0.5)}, {"p90", percentile(values, 0.9)}};
  if (with_max) json["max"] = percentile(values, 1.0);
  return json;
}

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return {};
  return formatted("%.*f", decimals, value);
}

std::size_t countOf(const std::vector<TravelRecord>& records, TravelOutcome outcome) {
  return static_cast<std::size_t>(
      std::count_if(records.begin(), records.end(),
                    [&](const TravelRecord& record) { return record.outcome == outcome; }));
}

}  // namespace

TravelRecord recordOf(const TravelRunResult& run, const std::string& map) {
  TravelRecord record;
  record.map = map;
  record.start = run.start;
  record.outcome = run.outcome;
  record.is_ambiguous_at_start = run.is_ambiguous_at_start;
  record.hypotheses_at_start = run.steps.empty() ? 0 : run.steps.front().hypotheses.size();
  record.travelled = run.travelled;
  record.scans = run.scans;
  record.collisions = run.collisions;
  record.error_m = run.error_m;
  record.error_rad = run.error_rad;
  record.planning_ms = run.planning_ms;
  return record;
}

ordered_json travelSummary(const std::vector<TravelRecord>& records) {
  std::size_t rightly = 0, collisions = 0, ambiguous = 0;
  std::vector<double> travel, scans, planning, ratios, driven, looked;
  for (const TravelRecord& record : records) {
    rightly += record.is_rightly_indistinguishable ? 1 : 0;
    collisions += record.collisions;
    ambiguous += record.is_ambiguous_at_start ? 1 : 0;
    planning.insert(planning.end(), record.planning_ms.begin(), record.planning_ms.end());
    if (record.outcome != TravelOutcome::localized) continue;
    travel.push_back(record.travelled);
    scans.push_back(static_cast<double>(record.scans));
    if (!record.is_ambiguous_at_start) continue;
    driven.push_back(record.travelled);
    looked.push_back(static_cast<double>(record.scans));
    if (record.tour_m && *record.tour_m > 0.0) ratios.push_back(record.travelled / *record.tour_m);
  }
  return {{"runs", records.size()},
          {"localized", countOf(records, TravelOutcome::localized)},
          {"wrong", countOf(records, TravelOutcome::wrong)},
          {"indistinguishable", countOf(records, TravelOutcome::indistinguishable)},
          {"indistinguishable_right", rightly},
          {"gave_up", countOf(records, TravelOutcome::gave_up)},
          {"collisions", collisions},
          {"ambiguous_at_start", ambiguous},
          {"travel_m", percentiles(travel)},
          {"scans", percentiles(scans)},
          {"ambiguous", {{"travel_m", percentiles(driven)}, {"scans", percentiles(looked)}}},
          {"planning_ms", percentiles(planning)},
          {"tour_ratio", percentiles(ratios, false)}};
}

std::string runsCsv(const std::vector<TravelRecord>& records) {
  std::string csv =
      "run,map,x,y,phi_deg,outcome,ambiguous_at_start,hypotheses,travel_m,scans,collisions,"
      "indistinguishable_right,tour_m,error_m,error_deg,planning_ms_max\n";
  for (std::size_t i = 0; i < records.size(); ++i) {
    const TravelRecord& record = records[i];
    const double slowest =
        record.planning_ms.empty()
            ? 0.0
            : *std::max_element(record.planning_ms.begin(), record.planning_ms.end());
    csv += std::to_string(i) + "," + record.map + "," + number(record.start.x, 3) + "," +
           number(record.start.y, 3) + "," + number(toDegrees(record.start.phi), 2) + "," +
           toString(record.outcome) + "," + (record.is_ambiguous_at_start ? "1" : "0") + "," +
           std::to_string(record.hypotheses_at_start) + "," + number(record.travelled, 3) + "," +
           std::to_string(record.scans) + "," + std::to_string(record.collisions) + "," +
           (record.is_rightly_indistinguishable ? "1" : "0") + "," +
           (record.tour_m ? number(*record.tour_m, 3) : std::string()) + "," +
           number(record.error_m, 3) + "," + number(toDegrees(record.error_rad), 2) + "," +
           number(slowest, 1) + "\n";
  }
  return csv;
}

}  // namespace mrpt_polyloc::apps
