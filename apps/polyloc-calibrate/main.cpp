// polyloc-calibrate: what do costs mean? See README.md beside this file.

#include "../common/Cli.h"
#include "../common/OutputFiles.h"
#include "../common/map_input.h"
#include "../common/memory_budget.h"
#include "../common/scan_input.h"
#include "calibration_sets.h"
#include "curves.h"
#include "sample_collection.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/CalibrationFit.h>
#include <mrpt_polyloc/evaluation/calibration_files.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace mrpt_polyloc;
using namespace mrpt_polyloc::apps;

struct Options {
  std::string sets, folder, header;
  std::uint64_t own = CollectionSize{}.own;
  std::uint64_t cluttered = CollectionSize{}.cluttered;
  std::uint64_t foreign = CollectionSize{}.foreign;
  std::uint64_t threads = 0;
  CalibrationFitParams fit;
  ScanFileOptions file;
  double scale = 1.0;  ///< of all maps
  std::optional<double> max_memory;
};

void addOptions(CLI::App& cli, Options& options) {
  constexpr std::uint64_t kMost = 1'000'000;
  addText(cli, "SETS", options.sets, "A list: NAME MAP SCANS TRUTH [GOOD] a line")->required();
  addText(cli, "-o", options.folder, "Folder for calibration.json, report.json and the curves")
      ->required()
      ->type_name("DIR");
  addReadingOptions(cli, options.file);
  addScaleOption(cli, options.scale);
  addMemoryOption(cli, options.max_memory);
  addText(cli, "--header", options.header, "Write the constants as C++ too: default_calibration.h")
      ->type_name("FILE.h");
  addCount(cli, "--own", options.own, 1, kMost,
           "At most so many scans of a set in its own map [default: all]")
      ->type_name("N");
  addCount(cli, "--cluttered", options.cluttered, 0, kMost,
           "At most so many good scans of a set with clutter added [default: 60]")
      ->type_name("N");
  addCount(cli, "--foreign", options.foreign, 1, kMost,
           "At most so many scans of a set in each other map [default: 40]")
      ->type_name("N");
  addNumber(cli, "--lost", options.fit.lost, {0.0, 0.5},
            "Share of the true scans that may be refused [default: 0.005]")
      ->type_name("SHARE");
  addNumber(cli, "--unique-right", options.fit.unique_right, {0.0, 1.0},
            "Share of the unique answers that must be right [default: 0.995]")
      ->type_name("SHARE");
  addNumber(cli, "--foreign-unique", options.fit.foreign_unique, {0.0, 1.0},
            "Share of the scans of other buildings that may be called unique [default: 0.003]")
      ->type_name("SHARE");
  addNumber(cli, "--clutter-weight", options.fit.clutter_weight, {0.0, 1e6, true},
            "A cluttered scan counts as so many own ones [default: 0.1]")
      ->type_name("WEIGHT");
  addCount(cli, "--threads", options.threads, 1, 1024,
           "Threads for the index and for scans at once [default: all cores for the index, one "
           "scan at a time]")
      ->type_name("N");
}

/// The comment of the header: which scans, how asked for.
std::vector<std::string> originOf(const Options& options, const std::vector<CalibrationSet>& sets) {
  std::vector<std::string> lines = {"polyloc-calibrate SETS --own " + std::to_string(options.own) +
                                    " --cluttered " + std::to_string(options.cluttered) +
                                    " --foreign " + std::to_string(options.foreign)};
  lines.push_back(formatted("  --lost %g --unique-right %g --foreign-unique %g --clutter-weight %g",
                            options.fit.lost, options.fit.unique_right, options.fit.foreign_unique,
                            options.fit.clutter_weight));
  lines.push_back("on the sets");
  for (const CalibrationSet& set : sets) {
    lines.push_back("  " + set.name.substr(0, 60) + " (" + std::to_string(set.scans.size()) +
                    " scans)");
  }
  return lines;
}

std::string percent(double share) {
  return formatted("%.1f %%", 100.0 * share);
}

std::string ofWhole(std::size_t part, std::size_t whole) {
  return std::to_string(part) + " of " + std::to_string(whole) + " (" +
         percent(whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole)) + ")";
}

void printOutcome(const char* title, const CalibrationOutcome& outcome) {
  std::cout << title << "\n  true scans refused       " << ofWhole(outcome.good_lost, outcome.good)
            << "\n  cluttered scans refused  " << ofWhole(outcome.cluttered_lost, outcome.cluttered)
            << "\n  foreign scans refused    " << ofWhole(outcome.foreign_refused, outcome.foreign)
            << "\n  at 3 % of the true lost  " << percent(pointAtLoss(outcome.roc, 0.03).refused)
            << "\n  foreign called unique    " << ofWhole(outcome.foreign_unique, outcome.foreign)
            << "\n  unique right             " << ofWhole(outcome.unique_right, outcome.unique)
            << "\n  where so many true scans may be lost, foreign scans refused\n   ";
  for (const double lost : Calibration::kLostShares) {
    std::cout << formatted(" %g: %.1f %%", lost, 100.0 * pointAtLoss(outcome.roc, lost).refused);
  }
  std::cout << "\n  reliability\n";
  for (const ReliabilityBin& bin : outcome.reliability) {
    if (bin.count == 0) continue;
    std::cout << "    stated " << percent(bin.stated) << ", right " << percent(bin.true_share)
              << ", scans " << bin.count << "\n";
  }
}

int calibrate(const Program& program, const Options& options) {
  const std::vector<CalibrationSet> sets = loadCalibrationSets(program, options.sets, options.file);
  const std::filesystem::path folder = options.folder;
  makeFolder(options.folder);
  requireWritable(folder / "calibration.json");
  requireWritable(options.header);

  SearchOptions search;
  search.max_hypotheses = 50;
  search.threads = options.threads;
  search.scale = options.scale;
  search.max_memory = options.max_memory;
  const std::vector<CalibrationSample> samples = collectSamples(
      program, sets, {options.own, options.cluttered, options.foreign}, std::move(search));
  Calibration calibration;
  try {
    calibration = fitCalibration(samples, options.fit);
  } catch (const InvalidParamsError& error) {
    throw FormatError(options.sets, "", error.what());
  }
  const CalibrationOutcome fitted =
      judge(samples, std::vector<Calibration>(samples.size(), calibration));
  std::optional<CalibrationOutcome> cross_validated;
  if (const auto folds = leaveOneMapOut(samples, options.fit)) {
    cross_validated = judge(samples, *folds);
  }

  nlohmann::ordered_json report;
  report["calibration"] = calibrationJson(calibration);
  report["fitted"] = outcomeJson(fitted);
  if (cross_validated) report["cross_validated"] = outcomeJson(*cross_validated);
  RocCurves roc{fitted.roc, {}};
  ReliabilityCurves reliability{fitted.reliability, {}};
  if (cross_validated) roc.cross_validated = cross_validated->roc;
  if (cross_validated) reliability.cross_validated = cross_validated->reliability;

  OutputFiles files;
  files.add(folder / "calibration.json", calibrationJson(calibration).dump(2) + "\n");
  files.add(folder / "report.json", report.dump(2) + "\n");
  files.add(folder / "roc.csv", rocCsv(roc));
  files.add(folder / "roc.svg", rocSvg(roc));
  files.add(folder / "reliability.csv", reliabilityCsv(reliability));
  files.add(folder / "reliability.svg", reliabilitySvg(reliability));
  if (!options.header.empty()) {
    files.add(options.header, calibrationHeader(calibration, originOf(options, sets)));
  }
  files.commit();
  printOutcome("fitted", fitted);
  if (cross_validated) printOutcome("each map left out", *cross_validated);
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("polyloc-calibrate",
                  "Fits what costs mean: when to refuse a scan, what hypotheses weigh.");
  Options options;
  addOptions(program.options(), options);
  return program.run(argc, argv, [&] { return calibrate(program, options); });
}
