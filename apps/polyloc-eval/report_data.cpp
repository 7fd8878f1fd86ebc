#include "report_data.h"

#include <mrpt_polyloc/base/angles.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace mrpt_polyloc::apps {
namespace {

using nlohmann::ordered_json;

/// Pictures of misses: so many of a data set and method, and in all, so that the page stays small.
constexpr std::size_t kMissesOfJob = 8;
constexpr std::size_t kMissesInAll = 400;

double rounded(double value, double unit) {
  return std::isfinite(value) ? std::round(value / unit) * unit : -1.0;
}

long inUnits(double value, double unit) {
  return std::isfinite(value) ? std::lround(value / unit) : -1;
}

ordered_json posePicture(const mrpt::math::TPose2D& pose, const ordered_json& outline) {
  return {std::lround(100.0 * (pose.x - outline.at("x").get<double>())),
          std::lround(100.0 * (pose.y - outline.at("y").get<double>())),
          std::lround(toDegrees(pose.phi))};
}

/// Scans of a job as columns, in whole numbers: what the page's curves and maps are drawn from.
ordered_json columnsOf(const EvaluationJob& job) {
  ordered_json columns;
  for (const auto& [row, scan] : job.scans) {
    const ScanScore& score = scan.record.score;
    columns["rank"].push_back(isRefused(score.status) ? 0 : score.right_rank);
    columns["status"].push_back(static_cast<int>(score.status));
    columns["mm"].push_back(inUnits(score.error_m, 0.001));
    columns["cdeg"].push_back(inUnits(toDegrees(score.error_rad), 0.01));
    columns["us"].push_back(inUnits(score.ms, 0.001));
    columns["weight"].push_back(
        scan.record.answer ? inUnits(scan.record.answer->weight * scan.match, 0.0001) : 0);
  }
  return columns;
}

ordered_json datasetForPage(const EvaluatedDataset& dataset, const EvaluationJob& job) {
  ordered_json json = {
      {"name", dataset.name},
      {"simulated", dataset.description.at("simulated")},
      {"map", dataset.description.at("statistics")},
      {"outline", dataset.description.at("outline")},
      {"tolerance",
       {dataset.description.at("tolerance_m"), dataset.description.at("tolerance_deg")}},
      {"stretch", dataset.stretch}};
  for (const auto& [row, scan] : job.scans) {
    json["rows"].push_back(row);
    for (const auto& value : posePicture(scan.record.truth, json["outline"])) {
      json["truth"].push_back(value);
    }
    json["fov"].push_back(inUnits(toDegrees(scan.traits.fov), 1.0));
    json["clutter"].push_back(inUnits(scan.traits.clutter + scan.traits.passed, 0.001));
    json["outside"].push_back(inUnits(scan.traits.outside, 0.001));
  }
  return json;
}

/// The misses to be shown: spread over all of them.
ordered_json missesOf(const EvaluationJob& job, const ordered_json& outline, std::size_t most) {
  std::vector<const EvaluatedScan*> misses;
  for (const auto& entry : job.scans) {
    if (!entry.second.isRight()) misses.push_back(&entry.second);
  }
  ordered_json shown = ordered_json::array();
  const std::size_t count = std::min(most, misses.size());
  for (std::size_t i = 0; i < count; ++i) {
    const EvaluatedScan& scan = *misses[i * misses.size() / count];
    ordered_json miss = {{"row", scan.record.row},
                         {"why", whyMissed(scan)},
                         {"status", toString(scan.record.score.status)},
                         {"rank", scan.record.score.right_rank},
                         {"truth", posePicture(scan.record.truth, outline)},
                         {"outside", rounded(scan.traits.outside, 0.01)},
                         {"clutter", rounded(scan.traits.clutter, 0.01)},
                         {"passed", rounded(scan.traits.passed, 0.01)}};
    if (scan.record.answer) {
      miss["answer"] = posePicture(scan.record.answer->pose_map_robot, outline);
      miss["error_m"] = rounded(scan.record.score.error_m, 0.01);
      miss["error_deg"] = rounded(toDegrees(scan.record.score.error_rad), 0.1);
    }
    if (scan.right) miss["z"] = rounded(scan.right->z_score, 0.1);
    for (const auto& hit : scan.hits) {
      miss["hits"].push_back(std::lround(100.0 * hit.x));
      miss["hits"].push_back(std::lround(100.0 * hit.y));
    }
    shown.push_back(std::move(miss));
  }
  return shown;
}

}  // namespace

ordered_json pageData(const EvaluationRun& run, const ordered_json& summary) {
  ordered_json page;
  page["run"] = summary.at("run");
  page["results"] = summary.at("results");
  page["all"] = summary.at("all");
  for (const EvaluatedMethod& method : run.methods) page["methods"].push_back(method.entry);
  const std::size_t jobs = run.datasets.size() * run.methods.size();
  const std::size_t most = std::clamp<std::size_t>(kMissesInAll / jobs, 1, kMissesOfJob);
  for (std::size_t d = 0; d < run.datasets.size(); ++d) {
    page["datasets"].push_back(datasetForPage(run.datasets[d], run.jobs[d].front()));
    ordered_json columns, misses;
    for (const EvaluationJob& job : run.jobs[d]) {
      columns.push_back(columnsOf(job));
      misses.push_back(missesOf(job, page["datasets"].back()["outline"], most));
    }
    page["columns"].push_back(std::move(columns));
    page["misses"].push_back(std::move(misses));
  }
  return page;
}

}  // namespace mrpt_polyloc::apps
