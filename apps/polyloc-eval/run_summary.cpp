#include "run_summary.h"

#include <mrpt_polyloc/evaluation/stretches.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace mrpt_polyloc::apps {
namespace {

using nlohmann::ordered_json;

constexpr std::array<const char*, 5> kReasons = {
    "refused", "outside_free_space", "rival_within_noise", "behind_others", "not_in_list"};

std::vector<bool> within(const EvaluationJob& job, std::size_t rank) {
  std::vector<bool> right;
  for (const auto& [row, scan] : job.scans) {
    const ScanScore& score = scan.record.score;
    right.push_back(!isRefused(score.status) && score.right_rank > 0 && score.right_rank <= rank);
  }
  return right;
}

ordered_json toJson(const ShareInterval& interval) {
  return {interval.low, interval.high};
}

std::vector<ScanScore> scoresOf(const EvaluationJob& job) {
  std::vector<ScanScore> scores;
  for (const auto& entry : job.scans) scores.push_back(entry.second.record.score);
  return scores;
}

/// Places, among the evaluated rows, of the good ones; none if none are told.
std::optional<std::vector<std::size_t>> goodPlaces(const EvaluatedDataset& dataset,
                                                   const EvaluationJob& job) {
  const ordered_json& good = dataset.description.at("good");
  if (good.is_null()) return std::nullopt;
  std::vector<bool> is_good;
  for (const auto& row : good) {
    const auto index = row.get<std::size_t>();
    if (index >= is_good.size()) is_good.resize(index + 1, false);
    is_good[index] = true;
  }
  std::vector<std::size_t> places;
  std::size_t place = 0;
  for (const auto& entry : job.scans) {
    if (entry.first < is_good.size() && is_good[entry.first]) places.push_back(place);
    ++place;
  }
  return places;
}

void addIntervals(ordered_json& result, const EvaluationJob& job, const EvaluationJob& first,
                  const std::vector<std::size_t>& stretch) {
  std::vector<std::size_t> stretches = stretch;
  stretches.erase(std::unique(stretches.begin(), stretches.end()), stretches.end());
  result["stretches"] = stretches.size();
  result["interval"]["top1"] = toJson(shareInterval(within(job, 1), stretch));
  result["interval"]["top20"] = toJson(shareInterval(within(job, 20), stretch));
  if (&job != &first) {
    result["top1_less_first_method"]["interval"] =
        toJson(differenceInterval(within(job, 1), within(first, 1), stretch));
  }
  for (const char* reason : kReasons) result["misses"][reason] = 0;
  for (const auto& entry : job.scans) {
    const std::string why = whyMissed(entry.second);
    if (!why.empty()) result["misses"][why] = result["misses"][why].get<int>() + 1;
  }
}

ordered_json resultOfJob(const EvaluatedDataset& dataset, const EvaluatedMethod& method,
                         const EvaluationJob& job, const EvaluationJob& first) {
  const std::vector<ScanScore> scores = scoresOf(job);
  const auto good_places = goodPlaces(dataset, job);
  std::optional<Summary> good;
  if (good_places) good = summarize(scores, &*good_places);
  ordered_json result;
  result["dataset"] = dataset.name;
  result["method"] = method.name;
  result.update(summaryObject(summarize(scores), good ? &*good : nullptr, job.index));
  result["cold_start_s"] = job.cold_start_s;
  result["map"] = dataset.description.at("statistics");
  addIntervals(result, job, first, dataset.stretch);
  return result;
}

/// A method over all data sets: scans counted alike, stretches of each data set by themselves.
ordered_json resultOverAll(const EvaluationRun& run, std::size_t m) {
  EvaluationJob all, first;
  std::vector<std::size_t> stretch, good;
  std::size_t next = 0, offset = 0;
  bool has_good = true;
  for (std::size_t d = 0; d < run.datasets.size(); ++d) {
    const auto places = goodPlaces(run.datasets[d], run.jobs[d][m]);
    has_good = has_good && places.has_value();
    if (places) {
      for (const std::size_t place : *places) good.push_back(next + place);
    }
    for (const std::size_t s : run.datasets[d].stretch) stretch.push_back(offset + s);
    offset = stretch.empty() ? 0 : stretch.back() + 1;
    std::size_t at = next;
    for (const auto& entry : run.jobs[d][m].scans) all.scans.emplace(at++, entry.second);
    for (const auto& entry : run.jobs[d][0].scans) first.scans.emplace(next++, entry.second);
  }
  const std::vector<ScanScore> scores = scoresOf(all);
  ordered_json result;
  result["method"] = run.methods[m].name;
  std::optional<Summary> of_good;
  if (has_good) of_good = summarize(scores, &good);
  ordered_json figures = summaryObject(summarize(scores), of_good ? &*of_good : nullptr, {});
  for (const char* key : {"index_build_s", "index_mb"}) figures.erase(key);
  result.update(figures);
  addIntervals(result, all, m == 0 ? all : first, stretch);
  return result;
}

}  // namespace

ordered_json summaryOf(const EvaluationRun& run, ordered_json about) {
  ordered_json summary;
  summary["run"] = std::move(about);
  for (std::size_t d = 0; d < run.datasets.size(); ++d) {
    for (std::size_t m = 0; m < run.methods.size(); ++m) {
      ordered_json result =
          resultOfJob(run.datasets[d], run.methods[m], run.jobs[d][m], run.jobs[d].front());
      if (m > 0) {
        result["top1_less_first_method"]["difference"] =
            result["top1"].get<double>() -
            summary["results"][d * run.methods.size()]["top1"].get<double>();
      }
      summary["results"].push_back(std::move(result));
    }
  }
  for (std::size_t m = 0; m < run.methods.size(); ++m) {
    ordered_json result = resultOverAll(run, m);
    if (m > 0) {
      result["top1_less_first_method"]["difference"] =
          result["top1"].get<double>() - summary["all"][0]["top1"].get<double>();
    }
    summary["all"].push_back(std::move(result));
  }
  return summary;
}

}  // namespace mrpt_polyloc::apps
