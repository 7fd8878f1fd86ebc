#include "list_results.h"

#include "../common/OutputFiles.h"
#include "EvaluationStore.h"
#include "report_page.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/stretches.h>
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/version.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iostream>
#include <numeric>
#include <optional>
#include <unistd.h>
#include <utility>
#include <vector>

namespace mrpt_polyloc::apps {
namespace {

using nlohmann::ordered_json;

/// Pictures of misses: so many of a data set and method, and in all, so that the page stays small.
constexpr std::size_t kMissesOfJob = 8;
constexpr std::size_t kMissesInAll = 400;

struct Dataset {
  std::string name;
  ordered_json description;
  std::vector<std::size_t> stretch;  ///< of each evaluated scan
};

struct Method {
  std::string name;
  ordered_json entry;
};

/// A run, read from its parts.
struct Run {
  std::vector<Dataset> datasets;
  std::vector<Method> methods;
  std::vector<std::vector<EvaluationJob>> jobs;  ///< by data set, then method
};

ordered_json readJson(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FormatError(path, "", "cannot be read");
  try {
    return ordered_json::parse(in);
  } catch (const std::exception& error) {
    throw FormatError(path, "", std::string("is damaged: ") + error.what());
  }
}

EvaluationJob readJob(const std::string& path) {
  auto job = JobFile(path).read();
  if (!job) throw FormatError(path, "", "is missing or empty: a share of the run is not there");
  const auto rows = job->identity.at("rows").get<std::size_t>();
  if (job->scans.size() != rows) {
    throw FormatError(path, "",
                      "holds " + std::to_string(job->scans.size()) + " of " + std::to_string(rows) +
                          " scans: a share of the run is not there or not done");
  }
  return *std::move(job);
}

Run readRun(const std::string& folder) {
  Run run;
  const ordered_json entry = readJson(runPath(folder));
  for (const auto& method : entry.at("methods")) run.methods.push_back({method.at("name"), method});
  for (const auto& name : entry.at("datasets")) {
    Dataset dataset{name, readJson(mapPath(folder, name)), {}};
    std::vector<EvaluationJob> jobs;
    for (const Method& method : run.methods) {
      jobs.push_back(readJob(jobPath(folder, dataset.name, method.name)));
    }
    std::vector<mrpt::math::TPose2D> drive;
    for (const auto& scan : jobs.front().scans) drive.push_back(scan.second.record.truth);
    dataset.stretch = stretchesOf(drive);
    if (dataset.description.at("simulated")) {  // no drive: each scan is by itself
      std::iota(dataset.stretch.begin(), dataset.stretch.end(), std::size_t{0});
    }
    run.datasets.push_back(std::move(dataset));
    run.jobs.push_back(std::move(jobs));
  }
  return run;
}

bool isRefused(LocalizationStatus status) {
  return status == LocalizationStatus::no_match || status == LocalizationStatus::too_few_beams;
}

/// Why a scan was missed, as far as can be told. In order: the first that holds.
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
std::optional<std::vector<std::size_t>> goodPlaces(const Dataset& dataset,
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

ordered_json resultOfJob(const Dataset& dataset, const Method& method, const EvaluationJob& job,
                         const EvaluationJob& first) {
  const std::vector<ScanScore> scores = scoresOf(job);
  const auto good_places = goodPlaces(dataset, job);
  std::optional<Summary> good;
  if (good_places) good = summarize(scores, &*good_places);
  ordered_json result;
  result["dataset"] = dataset.name;
  result["method"] = method.name;
  const ordered_json figures = summaryObject(summarize(scores), good ? &*good : nullptr, job.index,
                                             dataset.description.at("statistics"));
  for (const auto& item : figures.items()) {
    if (item.key() == "map") result["cold_start_s"] = job.cold_start_s;
    result[item.key()] = item.value();
  }
  addIntervals(result, job, first, dataset.stretch);
  return result;
}

/// A method over all data sets: scans counted alike, stretches of each data set by themselves.
ordered_json resultOverAll(const Run& run, std::size_t m) {
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
  ordered_json figures =
      summaryObject(summarize(scores), of_good ? &*of_good : nullptr, {}, ordered_json());
  for (const char* key : {"index_build_s", "index_mb", "map"}) figures.erase(key);
  result.update(figures);
  addIntervals(result, all, m == 0 ? all : first, stretch);
  return result;
}

std::string estimatesOf(const EvaluationJob& job, bool truth) {
  std::vector<StampedPose> poses;
  for (const auto& entry : job.scans) {
    const ScanRecord& record = entry.second.record;
    if (truth) {
      poses.push_back({record.stamp, record.truth});
    } else if (record.answer) {
      poses.push_back({record.stamp, record.answer->pose_map_robot});
    }
  }
  return toTum(poses);
}

std::string allScansCsv(const Run& run) {
  std::string csv;
  for (std::size_t d = 0; d < run.datasets.size(); ++d) {
    for (std::size_t m = 0; m < run.methods.size(); ++m) {
      std::vector<ScanRecord> records;
      std::vector<std::string> more;
      for (const auto& [row, scan] : run.jobs[d][m].scans) {
        records.push_back(scan.record);
        std::array<char, 200> text{};
        const ScanTraits& t = scan.traits;
        std::snprintf(text.data(), text.size(), ",%.6f,%.6f,%.1f,%zu,%.4f,%.4f,%.3f,%s",
                      scan.record.answer ? scan.record.answer->weight : 0.0, scan.match,
                      toDegrees(t.fov), t.hits, t.clutter, t.passed, t.outside, whyMissed(scan));
        more.push_back(text.data());
      }
      const std::string table = scansCsv(records);
      std::size_t begin = 0;
      for (std::size_t line = 0; begin < table.size(); ++line) {
        const std::size_t end = table.find('\n', begin);
        const std::string text = table.substr(begin, end - begin);
        begin = end + 1;
        if (line == 0) {
          if (csv.empty()) {
            csv = "dataset,method," + text +
                  ",weight,match,fov_deg,hits,clutter,passed,outside_m,why\n";
          }
          continue;
        }
        csv +=
            run.datasets[d].name + "," + run.methods[m].name + "," + text + more[line - 1] + "\n";
      }
    }
  }
  return csv;
}

ordered_json aboutRun(const std::string& command, std::uint64_t threads) {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  std::array<char, 32> date{};
  std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  std::string cpu = "unknown processor", line;
  std::ifstream info("/proc/cpuinfo");
  while (std::getline(info, line)) {
    if (line.rfind("model name", 0) != 0) continue;
    cpu = line.substr(line.find(':') + 2);
    break;
  }
  return {{"version", kVersion},
          {"command", command},
          {"date", date.data()},
          {"machine", cpu + ", " + std::to_string(::sysconf(_SC_NPROCESSORS_ONLN)) + " cores"},
          {"threads", threads}};
}

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

ordered_json datasetForPage(const Dataset& dataset, const EvaluationJob& job) {
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

ordered_json pageData(const Run& run, const ordered_json& summary) {
  ordered_json page;
  page["run"] = summary.at("run");
  page["results"] = summary.at("results");
  page["all"] = summary.at("all");
  for (const Method& method : run.methods) page["methods"].push_back(method.entry);
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

void printTable(const ordered_json& summary) {
  std::printf("%-28s %-20s %6s %8s %16s %8s %10s\n", "data set", "method", "scans", "top 1 %",
              "95 %", "top 20 %", "median ms");
  const auto row = [](const std::string& dataset, const ordered_json& r) {
    const auto percent = [](const ordered_json& value) { return 100.0 * value.get<double>(); };
    std::printf("%-28s %-20s %6zu %8.1f %8.1f-%-7.1f %8.1f %10.2f\n", dataset.c_str(),
                r.at("method").get<std::string>().c_str(), r.at("scans").get<std::size_t>(),
                percent(r.at("top1")), percent(r.at("interval").at("top1").at(0)),
                percent(r.at("interval").at("top1").at(1)), percent(r.at("top20")),
                r.at("ms_median").get<double>());
  };
  for (const auto& result : summary.at("results")) row(result.at("dataset"), result);
  for (const auto& result : summary.at("all")) row("all", result);
  std::fflush(stdout);
}

}  // namespace

void writeResults(const std::string& folder, const std::string& command, std::uint64_t threads) {
  const Run run = readRun(folder);
  ordered_json summary;
  summary["run"] = aboutRun(command, threads);
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
  makeFolder(folder + "/estimates");
  OutputFiles files;
  files.add(folder + "/summary.json", summary.dump(2) + "\n");
  files.add(folder + "/scans.csv", allScansCsv(run));
  files.add(folder + "/report.html", reportPage(pageData(run, summary)));
  for (std::size_t d = 0; d < run.datasets.size(); ++d) {
    const std::string name = folder + "/estimates/" + run.datasets[d].name;
    files.add(name + ".tum", estimatesOf(run.jobs[d].front(), true));
    for (std::size_t m = 0; m < run.methods.size(); ++m) {
      files.add(name + "@" + run.methods[m].name + ".tum", estimatesOf(run.jobs[d][m], false));
    }
  }
  files.commit();
  printTable(summary);
}

}  // namespace mrpt_polyloc::apps
