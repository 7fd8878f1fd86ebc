#include "EvaluationRun.h"

#include <mrpt_polyloc/base/errors.h>

#include <utility>

namespace mrpt_polyloc::apps {
namespace {

using nlohmann::ordered_json;

EvaluationJob readJob(const std::string& path) {
  auto job = JobFile(path).read();
  requireWhole(job ? &*job : nullptr, path);
  return *std::move(job);
}

}  // namespace

void requireWhole(const EvaluationJob* job, const std::string& place) {
  if (job == nullptr) {
    throw FormatError(place, "", "is missing or empty: a share of the run is not there");
  }
  const auto rows = job->identity.at("rows").get<std::size_t>();
  if (job->scans.size() == rows) return;
  throw FormatError(place, "",
                    "holds " + std::to_string(job->scans.size()) + " of " + std::to_string(rows) +
                        " scans: a share of the run is not there or not done");
}

EvaluationRun readRun(const std::string& folder) {
  EvaluationRun run;
  const ordered_json entry = readRunEntry(folder);
  for (const auto& method : entry.at("methods")) run.methods.push_back({method.at("name"), method});
  for (const auto& name : entry.at("datasets")) {
    EvaluatedDataset dataset{name, readMapEntry(folder, name), {}};
    std::vector<EvaluationJob> jobs;
    for (const EvaluatedMethod& method : run.methods) {
      jobs.push_back(readJob(jobPath(folder, dataset.name, method.name)));
    }
    dataset.stretch = dataset.description.at("stretches").get<std::vector<std::size_t>>();
    if (dataset.stretch.size() != jobs.front().scans.size()) {
      throw FormatError(mapPath(folder, dataset.name), "",
                        "holds " + std::to_string(dataset.stretch.size()) + " stretches for " +
                            std::to_string(jobs.front().scans.size()) + " scans");
    }
    run.datasets.push_back(std::move(dataset));
    run.jobs.push_back(std::move(jobs));
  }
  return run;
}

bool isRefused(LocalizationStatus status) {
  return status == LocalizationStatus::no_match || status == LocalizationStatus::too_few_beams;
}

const char* whyMissed(const EvaluatedScan& scan) {
  constexpr double kWithinNoise = 2.0;  // standard errors
  if (scan.isRight()) return "";
  if (isRefused(scan.record.score.status)) return "refused";
  if (scan.traits.outside > 0.0) return "outside_free_space";
  if (scan.right) {
    return scan.right->z_score < kWithinNoise ? "rival_within_noise" : "behind_others";
  }
  return "not_in_list";
}

}  // namespace mrpt_polyloc::apps
