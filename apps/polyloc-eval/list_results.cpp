#include "list_results.h"

#include "../common/OutputFiles.h"
#include "EvaluationRun.h"
#include "report_data.h"
#include "report_page.h"
#include "run_summary.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/version.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <unistd.h>
#include <vector>

namespace mrpt_polyloc::apps {
namespace {

using nlohmann::ordered_json;

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

std::string allScansCsv(const EvaluationRun& run) {
  std::string csv;
  for (std::size_t d = 0; d < run.datasets.size(); ++d) {
    for (std::size_t m = 0; m < run.methods.size(); ++m) {
      std::vector<ScanRecord> records;
      std::vector<std::string> more;
      for (const auto& [row, scan] : run.jobs[d][m].scans) {
        records.push_back(scan.record);
        const ScanTraits& t = scan.traits;
        more.push_back(formatted(",%.6f,%.6f,%.1f,%zu,%.4f,%.4f,%.3f,%s",
                                 scan.record.answer ? scan.record.answer->weight : 0.0, scan.match,
                                 toDegrees(t.fov), t.hits, t.clutter, t.passed, t.outside,
                                 whyMissed(scan)));
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
  const EvaluationRun run = readRun(folder);
  const ordered_json summary = summaryOf(run, aboutRun(command, threads));
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
