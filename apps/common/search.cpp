#include "search.h"

#include "OutputFiles.h"
#include "Progress.h"
#include "map_input.h"
#include "scan_input.h"
#include "view_polygons.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/calibration_files.h>
#include <mrpt_polyloc/localization/CellLocalizer.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/exact/ExactLocalizer.h>
#include <mrpt_polyloc/localization/exact/SkeletonLocalizer.h>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

constexpr std::uint64_t kMostThreads = 1024;
constexpr std::uint64_t kMostHypotheses = 1'000'000;

constexpr const char* kMethods = "certified, cells, exact";

/// \throws UsageError if the method is unknown.
void checkMethod(const std::string& method) {
  for (const char* known : {"certified", "cells", "exact"}) {
    if (method == known) return;
  }
  throw UsageError("--method: unknown method '" + method + "'; there is: " + kMethods);
}

constexpr const char* kRobust = "robust";
constexpr const char* kPolar = "polar";

/// \throws UsageError for options that do not go with the method.
void checkTogether(const SearchOptions& search) {
  if (search.cell_range && search.method != "cells") {
    throw UsageError("--range is that of visibility cells: it needs --method cells");
  }
  if (search.method == "exact" && !search.calibration_file.empty()) {
    throw UsageError("--calibration is of scans with noise: it does not go with --method exact");
  }
  if (search.method == "certified") return;
  if (!search.index.empty()) throw UsageError("--index needs --method certified");
  if (search.time_budget_ms > 0.0) throw UsageError("--time-budget needs --method certified");
  if (search.search_metric != kRobust) {
    throw UsageError("--search-metric needs --method certified");
  }
}

/// The content of a file; none if there is no such file. \throws FormatError if it cannot be read
std::optional<std::string> readIfThere(const std::string& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file || content.empty()) throw FormatError(path, "", "cannot be read, or is empty");
  return content;
}

std::shared_ptr<const GlobalLocalizer> makeShared(PolygonMap map, const std::string& index,
                                                  const GlobalLocalizerParams& params) {
  if (index.empty()) return std::make_shared<const GlobalLocalizer>(std::move(map), params);
  if (const std::optional<std::string> content = readIfThere(index)) {
    return std::make_shared<const GlobalLocalizer>(std::move(map), *content, index, params);
  }
  requireWritable(index);
  auto localizer = std::make_shared<const GlobalLocalizer>(std::move(map), params);
  writeFile(index, localizer->serializedIndex());
  return localizer;
}

Calibration calibrationOf(const SearchOptions& search) {
  return search.calibration_file.empty() ? search.calibration
                                         : loadCalibration(search.calibration_file);
}

ScanLocalizer makeGlobal(PolygonMap map, const SearchOptions& search) {
  GlobalLocalizerParams params;
  params.max_hypotheses = search.max_hypotheses;
  params.threads = static_cast<int>(search.threads);
  params.certified.time_budget_ms = search.time_budget_ms;
  if (search.search_metric == kPolar) params.search_metric = SearchMetric::polar;
  params.hypotheses.calibration = calibrationOf(search);
  // Shared, for a std::function must be copyable.
  const auto localizer = makeShared(std::move(map), search.index, params);
  return {localizer->map(),
          [localizer](const RangeScan& scan, const PosePrior& prior) {
            return localizer->localize(scan, prior);
          },
          localizer->indexBytes()};
}

ScanLocalizer makeCells(PolygonMap map, const SearchOptions& search) {
  CellLocalizerParams params;
  params.max_hypotheses = search.max_hypotheses;
  params.threads = static_cast<int>(search.threads);
  params.range = search.cell_range;
  params.hypotheses.calibration = calibrationOf(search);
  const auto localizer = std::make_shared<const CellLocalizer>(std::move(map), params);
  return {localizer->map(),
          [localizer](const RangeScan& scan, const PosePrior& prior) {
            return localizer->localize(scan, prior);
          },
          localizer->indexBytes()};
}

/// What both exact localizers are to the programs.
template <class Localizer>
ScanLocalizer exactLocalizer(const PolygonMap& map, std::size_t max_hypotheses) {
  const auto localizer = std::make_shared<const Localizer>(map);
  return {map,
          [localizer, max_hypotheses](const RangeScan& scan, const PosePrior& prior) {
            return resultOf(localizer->localize(viewPolygon(scan), prior), localizer->tolerance(),
                            max_hypotheses);
          },
          localizer->bytes()};
}

ScanLocalizer makeExact(const PolygonMap& map, const SearchOptions& search, std::size_t scans) {
  return SkeletonLocalizer::pays(map, scans)
             ? exactLocalizer<SkeletonLocalizer>(map, search.max_hypotheses)
             : exactLocalizer<ExactLocalizer>(map, search.max_hypotheses);
}

LocalizedScan localizeOne(const ScanLocalizer& localizer, const RangeScan& scan, std::size_t row,
                          const PosePrior& prior) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  LocalizationResult result = localizer.localize(scan, prior);
  const std::chrono::duration<double, std::milli> took = Clock::now() - start;
  return {row, scan.stamp(), std::move(result), took.count()};
}

}  // namespace

void addSearchOptions(CLI::App& options, SearchOptions& search) {
  options.parse_complete_callback([&search] { checkTogether(search); });
  addText(options, "--map", search.map, kMapFormats)->required()->type_name("MAP");
  addScaleOption(options, search.scale);
  addText(options, "--scans", search.scans,
          "The scans: .rawlog or CARMEN .log/.clf, plain, gzip or zstd; for --method exact .wkt")
      ->required()
      ->type_name("FILE");
  addReadingOptions(options, search.file);
  options
      .add_option_function<std::string>(
          "--method",
          [&search](const std::string& method) {
            checkMethod(method);
            search.method = method;
          },
          "How to search: certified [default], cells (the nearest visibility cells), exact (a "
          "polygon seen without any noise)")
      ->type_name("NAME");
  addNumber(
      options, "--range", [&search](double range) { search.cell_range = range; },
      {0.0, std::numeric_limits<double>::max(), true},
      "Range of the visibility cells of --method cells, m [default: the greatest that the budget "
      "of cells allows]")
      ->type_name("M");
  addCount(
      options, "--max-hypotheses", search.max_hypotheses, 1, kMostHypotheses,
      "At most so many hypotheses a scan [default: " + std::to_string(search.max_hypotheses) + "]")
      ->type_name("N");
  addCount(options, "--threads", search.threads, 1, kMostThreads,
           "Threads for the index and for scans at once [default: all cores for the index, one "
           "scan at a time]")
      ->type_name("N");
  addText(options, "--calibration", search.calibration_file,
          "What costs mean for this sensor, from polyloc-calibrate [default: built in]")
      ->type_name("FILE.json");
}

void addCertifiedOptions(CLI::App& options, SearchOptions& search) {
  addText(options, "--index", search.index,
          "Keep the index of the certified search in this file: read if it is there, else written")
      ->type_name("FILE");
  addNumber(options, "--time-budget", search.time_budget_ms, {0.0, 1e9, true},
            "Most time for the certified search of a scan; what it then has proven is less")
      ->type_name("MS");
  options
      .add_option_function<std::string>(
          "--search-metric",
          [&search](const std::string& metric) {
            if (metric != kRobust && metric != kPolar) {
              throw UsageError("--search-metric: unknown metric '" + metric +
                               "'; there is: robust, polar");
            }
            search.search_metric = metric;
          },
          "What the certified search minimises: robust [default], or polar, the polar coordinate "
          "metric, for scans without clutter")
      ->type_name("NAME");
}

ScanLocalizer makeLocalizer(PolygonMap map, const SearchOptions& search, std::size_t scans) {
  if (search.method == "exact") return makeExact(map, search, scans);
  if (search.method == "cells") return makeCells(std::move(map), search);
  return makeGlobal(std::move(map), search);
}

std::vector<RangeScan> loadSearchedScans(const Program& program, const SearchOptions& search) {
  if (search.method == "exact") return loadViewPolygons(search.scans);
  Notes notes;
  std::vector<RangeScan> scans = loadScans(search.scans, search.file, &notes);
  program.note(search.scans, notes);
  return scans;
}

std::vector<LocalizedScan> localizeScans(const ScanLocalizer& localizer,
                                         const std::vector<RangeScan>& scans,
                                         const std::vector<std::size_t>& rows,
                                         const PosePrior& prior, const SearchOptions& search) {
  std::vector<LocalizedScan> localized(rows.size());
  Progress progress("scan", rows.size());
  const auto step = [&](std::size_t i) {
    localized[i] = localizeOne(localizer, scans[rows[i]], rows[i], prior);
    progress.step();
  };
  if (search.threads > 1) {
    tbb::task_arena arena(static_cast<int>(search.threads));
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, rows.size(), step); });
  } else {
    for (std::size_t i = 0; i < rows.size(); ++i) step(i);
  }
  return localized;
}

}  // namespace mrpt_polyloc::apps
