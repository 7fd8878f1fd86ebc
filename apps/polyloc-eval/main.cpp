// polyloc-eval: how often is the first pose right? See README.md beside this file.

#include "../common/Cli.h"
#include "../common/OutputFiles.h"
#include "../common/map_input.h"
#include "../common/parsing.h"
#include "../common/search.h"
#include "EvaluationOptions.h"
#include "list_run.h"
#include "text_summary.h"
#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/evaluation/summary_json.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace mrpt_polyloc;
using namespace mrpt_polyloc::apps;

const Stopwatch since_start;  // of the program, nearly

constexpr const char* kOtherForms =
    "Many sets and methods:  polyloc-eval LIST.yaml [--shard I/N] [--threads N] [--resume] -o DIR\n"
    "Shares put together:    polyloc-eval merge DIR... -o DIR";

int evaluate(const Program& program, const EvaluationOptions& options, const std::string& to) {
  const EvaluationInputs inputs = loadInputs(program, options);

  const Stopwatch watch;
  const ScanLocalizer localizer =
      makeLocalizer(loadMapWithWarnings(program, options.search.map, options.search.scale).map,
                    options.search, inputs.scans.size());
  const double build_s = watch.seconds(), ready_s = since_start.seconds();

  const std::filesystem::path folder = to;
  makeFolder(to);
  requireWritable(folder / "summary.json");

  std::vector<std::size_t> rows(inputs.scans.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::vector<ScanRecord> records;
  std::optional<double> cold_start_s;
  for (const LocalizedScan& scan :
       inputs.drive ? localizeDrive(localizer, *inputs.drive, inputs.sets, rows, {}, options.search)
                    : localizeScans(localizer, inputs.scans, rows, {}, options.search)) {
    if (!cold_start_s) cold_start_s = ready_s + 1e-3 * scan.ms;
    records.push_back(scoreLocalized(scan, inputs.truth[scan.row], options.tolerance));
  }

  std::vector<ScanScore> scores;
  for (const ScanRecord& record : records) scores.push_back(record.score);
  const Summary all = summarize(scores);
  std::optional<Summary> good;
  if (inputs.good) good = summarize(scores, &*inputs.good);
  const IndexFigures index{build_s, static_cast<double>(localizer.index_bytes) / 1e6, cold_start_s};

  OutputFiles files;
  files.add(folder / "summary.json",
            summaryJson(all, good ? &*good : nullptr, index, localizer.map));
  files.add(folder / "scans.csv", scansCsv(records));
  files.commit();
  std::cout << textSummary(all, good, index);
  return kDone;
}

int mainOfSet(int argc, char** argv) {
  Program program("polyloc-eval", "Localizes scans whose true poses are known and sums up.");
  EvaluationOptions options;
  std::string folder;
  addEvaluationOptions(program.options(), options);
  addText(program.options(), "-o", folder, "Folder for summary.json and scans.csv")
      ->required()
      ->type_name("DIR");
  program.options().footer(kOtherForms);
  return program.run(argc, argv, [&] { return evaluate(program, options, folder); });
}

/// `I/N`, both from 1 on.
void parseShard(const std::string& text, ListRunOptions& options) {
  const std::size_t slash = text.find('/');
  const auto shard = parseCount(text.substr(0, slash));
  const auto shards =
      slash == std::string::npos ? std::nullopt : parseCount(text.substr(slash + 1));
  if (!shard || !shards || *shard == 0 || *shard > *shards) {
    throw UsageError("--shard: '" + text + "' is not I/N with I from 1 to N");
  }
  options.shard = *shard;
  options.shards = *shards;
}

int mainOfList(int argc, char** argv, const std::string& command) {
  Program program("polyloc-eval", "Runs the methods of a list on its data sets and reports.");
  ListRunOptions options;
  options.command = command;
  CLI::App& cli = program.options();
  addText(cli, "LIST", options.list, "Data sets and methods, see README.md")->required();
  addText(cli, "-o", options.folder, "Folder for summary.json, scans.csv, report.html, estimates/")
      ->required()
      ->type_name("DIR");
  cli.add_option_function<std::string>(
         "--shard", [&options](const std::string& text) { parseShard(text, options); },
         "Run the I-th of N shares alone")
      ->type_name("I/N");
  addCount(cli, "--threads", options.threads, 1, 1024,
           "Scans at once [default: one, so that times mean something]")
      ->type_name("N");
  cli.add_flag("--resume", options.resume, "Go on with the run that the folder holds");
  return program.run(argc, argv, [&] { return runList(program, options); });
}

int mainOfMerge(int argc, char** argv, const std::string& command) {
  Program program("polyloc-eval merge", "Puts the shares of a list together.");
  std::vector<std::string> folders;
  std::string folder;
  program.options().add_option("DIR", folders, "Folders of all shares")->required();
  addText(program.options(), "-o", folder, "A new folder for the whole")
      ->required()
      ->type_name("DIR");
  return program.run(argc, argv, [&] { return mergeRuns(program, folders, folder, command); });
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  std::string command = "polyloc-eval";
  bool has_list = false, has_map = false;
  for (const std::string& argument : arguments) {
    command += " " + argument;
    has_map = has_map || argument.rfind("--map", 0) == 0;
    has_list = has_list || endsWith(argument, ".yaml") || endsWith(argument, ".yml");
  }
  if (!arguments.empty() && arguments.front() == "merge") {
    return mainOfMerge(argc - 1, argv + 1, command);
  }
  return has_list && !has_map ? mainOfList(argc, argv, command) : mainOfSet(argc, argv);
}
