// polyloc-eval: how often is the first pose right? See README.md beside this file.

#include "../common/Cli.h"
#include "../common/OutputFiles.h"
#include "../common/map_input.h"
#include "../common/parsing.h"
#include "../common/search.h"
#include "text_summary.h"
#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/evaluation/summary_json.h>
#include <mrpt_polyloc/evaluation/truth.h>

#include <filesystem>
#include <iostream>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace mrpt_polyloc;
using namespace mrpt_polyloc::apps;

struct Options {
  SearchOptions search;
  std::string truth, good, folder;
  Tolerance tolerance;
};

void addOptions(CLI::App& cli, Options& options) {
  options.search.max_hypotheses = 50;
  addSearchOptions(cli, options.search);
  addText(cli, "--truth", options.truth, "True poses of the robot, one a scan, matched by stamp")
      ->required()
      ->type_name("TRUTH.tum");
  addText(cli, "--good", options.good, "Rows to be summed up apart, one a line")->type_name("FILE");
  cli.add_option_function<std::string>(
         "--tolerance",
         [&options](const std::string& text) { options.tolerance = parseTolerance(text); },
         "What still counts as right, m and deg [default: 0.3,5]")
      ->type_name("M,DEG");
  addText(cli, "-o", options.folder, "Folder for summary.json and scans.csv")
      ->required()
      ->type_name("DIR");
}

/// What is read before anything is searched.
struct Inputs {
  std::vector<RangeScan> scans;
  std::vector<mrpt::math::TPose2D> truth;
  std::optional<std::vector<std::size_t>> good;
};

Inputs loadInputs(const Program& program, const Options& options) {
  Inputs inputs;
  inputs.scans = loadSearchedScans(program, options.search);
  inputs.truth = matchTruth(inputs.scans, loadTum(options.truth), options.truth);
  if (!options.good.empty()) inputs.good = loadRows(options.good, inputs.scans.size());
  return inputs;
}

/// Localized scans against their truth.
std::vector<ScanRecord> score(const std::vector<LocalizedScan>& localized, const Inputs& inputs,
                              const Tolerance& tolerance) {
  std::vector<ScanRecord> records;
  for (const LocalizedScan& scan : localized) {
    const std::vector<Hypothesis>& hypotheses = scan.result.hypotheses;
    const mrpt::math::TPose2D& truth = inputs.truth[scan.row];
    ScanRecord record{scan.row, scan.stamp,       truth, scoreScan(scan.result, truth, tolerance),
                      {},       hypotheses.size()};
    record.score.ms = scan.ms;
    if (!hypotheses.empty()) record.answer = hypotheses.front();
    records.push_back(record);
  }
  return records;
}

int evaluate(const Program& program, const Options& options) {
  const Inputs inputs = loadInputs(program, options);

  const Stopwatch watch;
  const ScanLocalizer localizer =
      makeLocalizer(loadMapWithWarnings(program, options.search.map, options.search.scale).map,
                    options.search, inputs.scans.size());
  const double build_s = watch.seconds();

  const std::filesystem::path folder = options.folder;
  makeFolder(options.folder);
  requireWritable(folder / "summary.json");

  std::vector<std::size_t> rows(inputs.scans.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const std::vector<ScanRecord> records = score(
      localizeScans(localizer, inputs.scans, rows, {}, options.search), inputs, options.tolerance);

  std::vector<ScanScore> scores;
  for (const ScanRecord& record : records) scores.push_back(record.score);
  const Summary all = summarize(scores);
  std::optional<Summary> good;
  if (inputs.good) good = summarize(scores, &*inputs.good);
  const IndexFigures index{build_s, static_cast<double>(localizer.index_bytes) / 1e6};

  OutputFiles files;
  files.add(folder / "summary.json",
            summaryJson(all, good ? &*good : nullptr, index, localizer.map));
  files.add(folder / "scans.csv", scansCsv(records));
  files.commit();
  std::cout << textSummary(all, good, index);
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("polyloc-eval", "Localizes scans whose true poses are known and sums up.");
  Options options;
  addOptions(program.options(), options);
  return program.run(argc, argv, [&] { return evaluate(program, options); });
}
