#include "search.h"

#include "OutputFiles.h"
#include "Progress.h"
#include "map_input.h"
#include "memory_budget.h"
#include "scan_input.h"
#include "view_polygons.h"
#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/calibration_files.h>
#include <mrpt_polyloc/localization/CellLocalizer.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/MultiMapLocalizer.h>
#include <mrpt_polyloc/localization/exact/ExactLocalizer.h>
#include <mrpt_polyloc/localization/exact/LimitedRangeLocalizer.h>
#include <mrpt_polyloc/localization/exact/SkeletonLocalizer.h>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <filesystem>
#include <fstream>
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

constexpr const char* kLargerLeaves = "take larger leaves by --leaf-size M; ";

constexpr const char* kIndex = "index";
constexpr const char* kTree = "tree";
constexpr const char* kRobust = "robust";
constexpr const char* kPolar = "polar";

/// \throws UsageError for options that do not go with the method.
void checkTogether(const SearchOptions& search) {
  if (search.cell_range && search.method != "cells") {
    throw UsageError("--range is that of visibility cells: it needs --method cells");
  }
  if (search.nearest != kIndex && search.method != "cells") {
    throw UsageError("--nearest is of the views of visibility cells: it needs --method cells");
  }
  if (search.view_range && search.method != "exact") {
    throw UsageError("--view-range is of polygons seen without noise: it needs --method exact");
  }
  if (search.method == "exact" && !search.calibration_file.empty()) {
    throw UsageError("--calibration is of scans with noise: it does not go with --method exact");
  }
  if (search.method == "exact" && (search.max_lost || search.cell_size > 0.0)) {
    throw UsageError(
        "--max-lost and --cell-size are of scans with noise: they do not go with --method exact");
  }
  if (search.method == "certified") return;
  if (search.leaf_size) throw UsageError("--leaf-size needs --method certified");
  if (!search.index.empty()) throw UsageError("--index needs --method certified");
  if (search.time_budget_ms > 0.0) throw UsageError("--time-budget needs --method certified");
  if (search.search_metric != kRobust) {
    throw UsageError("--search-metric needs --method certified");
  }
}

MapIndexParams indexParamsOf(const SearchOptions& search) {
  MapIndexParams params;
  params.threads = static_cast<int>(search.threads);
  if (search.leaf_size) params.leaf_size = *search.leaf_size;
  return params;
}

/// \throws FormatError for a stored index of other leaves than are asked for
MapIndex::Ptr loadIndex(const std::string& file, PolygonMap map,
                        const std::optional<double>& leaf_size) {
  MapIndex::Ptr index = MapIndex::load(file, std::move(map));
  if (leaf_size && index->leafSize() != *leaf_size) {
    throw FormatError(file, "",
                      formatted("is of leaves of %g m, not of %g as --leaf-size asks for: give "
                                "another file to --index",
                                index->leafSize(), *leaf_size));
  }
  return index;
}

/// The index of the certified search: read from its file if that is there, else made, and kept
/// there if a file is named.
MapIndex::Ptr makeIndex(PolygonMap map, const SearchOptions& search) {
  const std::string& file = search.index;
  const MapIndexParams params = indexParamsOf(search);
  if (file.empty()) return MapIndex::build(std::move(map), params);
  if (std::filesystem::exists(file)) return loadIndex(file, std::move(map), search.leaf_size);
  requireWritable(file);
  const MapIndex::Ptr index = MapIndex::build(std::move(map), params);
  OutputFiles files;
  std::ofstream stream(files.stage(file), std::ios::binary);
  index->save(stream);
  stream.close();
  if (!stream) throw FormatError(file, "", "cannot be written");
  files.commit();
  return index;
}

HypothesisParams hypothesesOf(const SearchOptions& search) {
  HypothesisParams params;
  params.calibration = search.calibration_file.empty() ? search.calibration
                                                       : loadCalibration(search.calibration_file);
  if (search.max_lost) {
    params.calibration.least_match_probability = params.calibration.thresholdFor(*search.max_lost);
  }
  params.cell_size = search.cell_size;
  return params;
}

mrpt_polyloc::SearchOptions optionsOf(const SearchOptions& search) {
  mrpt_polyloc::SearchOptions options;
  options.max_hypotheses = search.max_hypotheses;
  options.time_budget_ms = search.time_budget_ms;
  options.threads = search.threads > 1 ? 0 : 1;  // as many as localizeScans() takes
  if (search.search_metric == kPolar) options.metric = SearchMetric::polar;
  return options;
}

/// A localizer as the programs see it. Shared, for a std::function must be copyable.
template <class Localizer>
ScanLocalizer shared(Localizer localizer, const SearchOptions& search, std::size_t bytes) {
  const auto held = std::make_shared<const Localizer>(std::move(localizer));
  return {held->map(),
          [held, options = optionsOf(search)](const RangeScan& scan, const PosePrior& prior) {
            return held->localize(scan, prior, options);
          },
          bytes,
          {}};
}

ScanLocalizer makeGlobal(PolygonMap map, const SearchOptions& search) {
  GlobalLocalizerParams params;
  params.hypotheses = hypothesesOf(search);
  requireMemory(search.map, map, indexParamsOf(search), search.max_memory, kLargerLeaves);
  const MapIndex::Ptr index = makeIndex(std::move(map), search);
  const auto held = std::make_shared<const GlobalLocalizer>(index, params);
  ScanLocalizer localizer = shared(GlobalLocalizer(*held), search, index->bytes());
  localizer.localize_set = [held, options = optionsOf(search)](const ScanSet& set,
                                                               const PosePrior& prior) {
    return held->localize(set, prior, options);
  };
  return localizer;
}

ScanLocalizer makeCells(PolygonMap map, const SearchOptions& search) {
  CellLocalizerParams params;
  params.threads = static_cast<int>(search.threads);
  params.range = search.cell_range;
  if (search.nearest == kTree) params.nearest = NearestViews::tree;
  params.hypotheses = hypothesesOf(search);
  CellLocalizer localizer(MapIndex::deferred(std::move(map), indexParamsOf(search)), params);
  const std::size_t bytes = localizer.indexBytes();
  return shared(std::move(localizer), search, bytes);
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
          localizer->bytes(),
          {}};
}

/// What is seen up to a range: all of the polygons that is farther away is cut off first.
ScanLocalizer limitedLocalizer(const PolygonMap& map, double range, std::size_t max_hypotheses) {
  const auto localizer = std::make_shared<const LimitedRangeLocalizer>(map);
  return {map,
          [localizer, range, max_hypotheses](const RangeScan& scan, const PosePrior& prior) {
            return resultOf(
                localizer->localize(withinRange(viewPolygon(scan), range), prior.compass),
                localizer->tolerance(), max_hypotheses);
          },
          localizer->bytes()};
}

ScanLocalizer makeExact(const PolygonMap& map, const SearchOptions& search, std::size_t scans) {
  if (search.view_range) return limitedLocalizer(map, *search.view_range, search.max_hypotheses);
  return SkeletonLocalizer::pays(map, scans)
             ? exactLocalizer<SkeletonLocalizer>(map, search.max_hypotheses)
             : exactLocalizer<ExactLocalizer>(map, search.max_hypotheses);
}

LocalizedScan localizeOne(const ScanLocalizer& localizer, const RangeScan& scan, std::size_t row,
                          const PosePrior& prior) {
  const Stopwatch watch;
  LocalizationResult result = localizer.localize(scan, prior);
  const double ms = 1e3 * watch.seconds();
  return {row, scan.stamp(), std::move(result), ms, {}};
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
  options
      .add_option_function<std::string>(
          "--nearest",
          [&search](const std::string& name) {
            if (name != kIndex && name != kTree) {
              throw UsageError("--nearest: unknown '" + name + "'; there is: index, tree");
            }
            search.nearest = name;
          },
          "How --method cells finds the nearest views: index [default], or tree, the bisector tree "
          "of the paper, which is slower and finds the same")
      ->type_name("NAME");
  addNumber(
      options, "--view-range", [&search](double range) { search.view_range = range; },
      {0.0, 1e6, true},
      "--method exact: sight ends at so many metres; of the polygons what is farther is cut off")
      ->type_name("M");
  addMemoryOption(options, search.max_memory);
  addCount(
      options, "--max-hypotheses", search.max_hypotheses, 1, kMostHypotheses,
      "At most so many hypotheses a scan [default: " + std::to_string(search.max_hypotheses) + "]")
      ->type_name("N");
  addCount(options, "--threads", search.threads, 1, kMostThreads,
           "Threads for the index and for scans, several at once or one on all of them [default: "
           "all cores for the index, one for a scan]")
      ->type_name("N");
  addText(options, "--calibration", search.calibration_file,
          "What costs mean for this sensor, from polyloc-calibrate [default: built in]")
      ->type_name("FILE.json");
  addNumber(
      options, "--max-lost", [&search](double share) { search.max_lost = share; }, {0.0, 1.0},
      "Share of the scans taken in the map that may be refused: more refuse more of other "
      "buildings [default: the calibration's own]")
      ->type_name("SHARE");
  addNumber(options, "--cell-size", search.cell_size, {0.0, 100.0, true},
            "Side of the grid cells that the map was made from: walls are known no better "
            "[default: what the map says; 0 if it was drawn]")
      ->type_name("M");
}

void addCertifiedOptions(CLI::App& options, SearchOptions& search) {
  addNumber(
      options, "--leaf-size", [&search](double size) { search.leaf_size = size; }, {0.05, 2.0},
      "Side of the squares of the certified search's index: with larger ones it is built sooner "
      "and takes less memory, and scans take longer [default: 0.25]")
      ->type_name("M");
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

MultiMapSearch makeMultiMapSearch(std::vector<PolygonMap> maps,
                                  const std::vector<std::string>& names,
                                  const SearchOptions& search) {
  const MapIndexParams index_params = indexParamsOf(search);
  std::optional<double> left = search.max_memory;
  for (std::size_t m = 0; m < maps.size(); ++m) {
    requireMemory(names[m], maps[m], index_params, left, kLargerLeaves);
    if (left) *left -= MapIndex::estimate(maps[m], index_params).bytes / 1e6;
  }
  std::vector<GlobalLocalizer> localizers;
  for (PolygonMap& map : maps) {
    GlobalLocalizerParams params;
    params.hypotheses = hypothesesOf(search);
    localizers.emplace_back(MapIndex::build(std::move(map), index_params), params);
  }
  const auto held = std::make_shared<const MultiMapLocalizer>(std::move(localizers));
  return [held, options = optionsOf(search)](const ScanSet& set, const PosePrior& prior,
                                             std::vector<std::size_t>& maps_of) {
    MultiMapResult found = held->localize(set, prior, options);
    maps_of = std::move(found.maps);
    return std::move(found.result);
  };
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
                                         const PosePrior& prior, const SearchOptions& search,
                                         const std::function<void(const LocalizedScan&)>& on_done) {
  std::vector<LocalizedScan> localized(rows.size());
  std::optional<Progress> progress;
  if (!on_done) progress.emplace("scan", rows.size());
  const auto step = [&](std::size_t i) {
    localized[i] = localizeOne(localizer, scans[rows[i]], rows[i], prior);
    if (on_done) on_done(localized[i]);
    if (progress) progress->step();
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
