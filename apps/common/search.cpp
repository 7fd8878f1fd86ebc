#include "search.h"

#include "Progress.h"
#include "map_input.h"
#include "view_polygons.h"
#include <mrpt_polyloc/evaluation/calibration_files.h>
#include <mrpt_polyloc/localization/ExactLocalizer.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

constexpr std::uint64_t kMostThreads = 1024;
constexpr std::uint64_t kMostHypotheses = 1'000'000;

constexpr const char* kBuiltMethods = "exhaustive, exact";

/// \throws UsageError if the method is unknown or not built yet.
void checkMethod(const std::string& method) {
  if (method == "exhaustive" || method == "exact") return;
  constexpr std::array<const char*, 2> planned = {"certified", "cells"};
  if (std::find(planned.begin(), planned.end(), method) != planned.end()) {
    throw UsageError("--method " + method + " is not built yet; there is: " + kBuiltMethods);
  }
  throw UsageError("--method: unknown method '" + method + "'; there is: " + kBuiltMethods);
}

ScanLocalizer makeExhaustive(PolygonMap map, const SearchOptions& search) {
  GlobalLocalizerParams params;
  params.max_hypotheses = search.max_hypotheses;
  params.threads = static_cast<int>(search.threads);
  params.hypotheses.calibration = search.calibration_file.empty()
                                      ? search.calibration
                                      : loadCalibration(search.calibration_file);
  // Shared, for a std::function must be copyable.
  const auto localizer = std::make_shared<const GlobalLocalizer>(std::move(map), params);
  return {localizer->map(),
          [localizer](const RangeScan& scan, const PosePrior& prior) {
            return localizer->localize(scan, prior);
          },
          localizer->indexBytes()};
}

ScanLocalizer makeExact(const PolygonMap& map, const SearchOptions& search) {
  ExactLocalizerParams params;
  params.max_hypotheses = search.max_hypotheses;
  const auto localizer = std::make_shared<const ExactLocalizer>(map, params);
  return {map,
          [localizer](const RangeScan& scan, const PosePrior& prior) {
            return localizer->localize(viewPolygon(scan), prior);
          },
          localizer->bytes()};
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
  addText(options, "--map", search.map, kMapFormats)->required()->type_name("MAP");
  addText(options, "--scans", search.scans,
          "The scans: .rawlog or CARMEN .log/.clf, plain or gz; for --method exact .wkt")
      ->required()
      ->type_name("FILE");
  options
      .add_option_function<std::string>(
          "--method",
          [&search](const std::string& method) {
            checkMethod(method);
            search.method = method;
          },
          "How to search: exhaustive [default], exact (a polygon seen without any noise); "
          "certified "
          "and cells are not built yet")
      ->type_name("NAME");
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

ScanLocalizer makeLocalizer(PolygonMap map, const SearchOptions& search) {
  return search.method == "exact" ? makeExact(map, search) : makeExhaustive(std::move(map), search);
}

std::vector<RangeScan> loadSearchedScans(const SearchOptions& search, const ScanFileOptions& file) {
  return search.method == "exact" ? loadViewPolygons(search.scans) : loadScans(search.scans, file);
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
