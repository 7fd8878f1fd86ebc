#pragma once

#include "Cli.h"
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/io/scan_files.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/ranking/Calibration.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// What polyloc-localize and polyloc-eval ask for alike.
struct SearchOptions {
  std::string map;
  double scale = 1.0;  ///< metres per unit of the map's file
  std::string scans;
  ScanFileOptions file;  ///< how they are read
  std::string method = "certified";
  std::optional<double> cell_range;  ///< of --method cells [m]
  std::string nearest = "index";     ///< of --method cells: index or tree
  std::optional<double> view_range;  ///< of --method exact: where sight ends [m]
  std::optional<double>
      max_memory;  ///< for the index of the certified search [MB], see requireMemory()
  std::optional<double> leaf_size;  ///< of the certified search's index [m]
  std::string index;                ///< file to keep the certified search's index in; empty: none
  double time_budget_ms = 0.0;      ///< of the certified search; 0: none
  std::string search_metric = "robust";  ///< of the certified search
  std::uint64_t max_hypotheses = 20;
  /// Threads for the index and for scans, several at once, or one scan on all that are free; 0 (not
  /// given): all cores for the index, and one for a scan, so that the times of a scan mean
  /// something.
  std::uint64_t threads = 0;
  std::string calibration_file;  ///< empty: `calibration` holds
  Calibration calibration;
  std::optional<double> max_lost;  ///< share of true scans that may be refused
  double cell_size = 0.0;          ///< of what the map was traced from [m]; 0: what the map says
};

/// Adds --map, --scale, --max-memory, --scans, --max-range, --min-range, --strict, --method,
/// --range, --nearest, --view-range, --max-hypotheses, --threads, --calibration, --max-lost and
/// --cell-size. Those of one method alone are usage errors with another.
void addSearchOptions(CLI::App& options, SearchOptions& search);

/// What a method is to the programs: a map made ready, and one scan in, all poses out.
struct ScanLocalizer {
  PolygonMap map;
  /// Const, thread-safe, and independent of what was localized before.
  std::function<LocalizationResult(const RangeScan&, const PosePrior&)> localize;
  std::size_t index_bytes = 0;  ///< memory of what was prepared
  /// The same for scan sets; only of the certified method.
  std::function<LocalizationResult(const ScanSet&, const PosePrior&)> localize_set = {};
};

/// Adds --leaf-size, --index, --time-budget and --search-metric, which are usage errors with
/// another method than certified.
void addCertifiedOptions(CLI::App& options, SearchOptions& search);

/// Prepares the search of `search.method` in a map, for so many scans: for `exact` with the map's
/// skeletons where that pays. Reads `search.index` if it is there, else writes it.
/// \throws FormatError naming the index or the calibration file, or the map if it would take more
/// memory than is allowed; CellBudgetError
ScanLocalizer makeLocalizer(PolygonMap map, const SearchOptions& search, std::size_t scans);

/// What a method that searches several maps is to the programs: a scan set in, all poses out, and
/// the number of the map of each.
using MultiMapSearch = std::function<LocalizationResult(const ScanSet& set, const PosePrior& prior,
                                                        std::vector<std::size_t>& maps)>;

/// The certified search over several maps.
MultiMapSearch makeMultiMapSearch(std::vector<PolygonMap> maps,
                                  const std::vector<std::string>& names,
                                  const SearchOptions& search);

/// What the method searches for: the scans of a log, with notes on what was assumed of it, or, for
/// `exact`, the polygons of a WKT file (see loadViewPolygons()).
std::vector<RangeScan> loadSearchedScans(const Program& program, const SearchOptions& search);

/// A scan and what was found for it.
struct LocalizedScan {
  std::size_t row = 0;  ///< index in the file
  double stamp = 0.0;   ///< [s]
  LocalizationResult result;
  double ms = 0.0;                     ///< wall time of this scan
  std::vector<std::string> maps = {};  ///< of each hypothesis, where several maps are searched
};

/// Localizes the given rows, in that order, on `search.threads` threads. Results do not depend on
/// their number. \param on_done is told each scan as soon as it is done, by several
/// threads at once, and shows progress itself; none: progress is shown here
std::vector<LocalizedScan> localizeScans(
    const ScanLocalizer& localizer, const std::vector<RangeScan>& scans,
    const std::vector<std::size_t>& rows, const PosePrior& prior, const SearchOptions& search,
    const std::function<void(const LocalizedScan&)>& on_done = {});

}  // namespace mrpt_polyloc::apps
