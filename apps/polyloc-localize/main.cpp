// polyloc-localize: where were these scans taken? See README.md beside this file.

#include "../common/Cli.h"
#include "../common/OutputFiles.h"
#include "../common/map_input.h"
#include "../common/search.h"
#include "LocalizeOptions.h"
#include "explanation.h"
#include "hypothesis_csv.h"
#include "particle_filter_ini.h"
#include "scan_picture.h"
#include <mrpt_polyloc/base/errors.h>

#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace mrpt_polyloc;
using namespace mrpt_polyloc::apps;

std::vector<std::size_t> chosenRows(const LocalizeOptions& options, std::size_t count) {
  const std::vector<std::size_t> rows = selectRows(options.ranges, count);
  if (rows.empty()) {
    throw FormatError(options.search.scans, "--rows " + options.rows,
                      "no such row; the file holds the rows 0 to " + std::to_string(count - 1));
  }
  return rows;
}

/// Lines for the particle filter, from the first scan that could be localized.
std::string iniText(const LocalizeOptions& options, const std::vector<LocalizedScan>& localized) {
  for (const LocalizedScan& scan : localized) {
    const auto& hypotheses = scan.result.hypotheses;
    if (!hypotheses.empty()) return particleFilterIni(hypotheses.front());
  }
  throw FormatError(options.pf_ini, "", "not written: no scan could be localized");
}

/// Rows of one log in several maps.
int localizeInMaps(const Program& program, const LocalizeOptions& options) {
  if (!options.svg.empty() || !options.pf_ini.empty() || !options.search.index.empty() ||
      options.explain) {
    throw UsageError("--svg, --pf-ini, --index and --explain are of one map");
  }
  requireWritable(options.output);
  std::vector<PolygonMap> maps;
  for (const std::string& map : options.maps) {
    maps.push_back(loadMapWithWarnings(program, map, options.search.scale).map);
  }
  const DriveLog drive = loadSearchedDrive(program, options.search, options.sets);
  const std::vector<std::size_t> rows = chosenRows(options, drive.moments.size());
  const MultiMapSearch search = makeMultiMapSearch(std::move(maps), options.maps, options.search);
  const std::string csv = hypothesisCsv(
      localizeDrive(search, options.maps, drive, options.sets, rows, options.prior, options.search),
      true);
  OutputFiles files;
  if (!options.output.empty()) files.add(options.output, csv);
  files.commit();
  if (options.output.empty()) std::cout << csv;
  return kDone;
}

int localize(const Program& program, const LocalizeOptions& options) {
  if (options.maps.size() > 1) return localizeInMaps(program, options);
  if (options.explain) {
    if (options.search.method == "exact") {
      throw UsageError("--explain is of scans of a log: it does not go with --method exact");
    }
    std::cout << explain(options);
    return kDone;
  }
  if (options.search.view_range && options.prior.near) {
    throw UsageError(
        "--near does not go with --view-range: robots may be anywhere along a segment");
  }
  for (const std::string& path : {options.output, options.svg, options.pf_ini}) {
    requireWritable(path);
  }
  RepairedMap loaded = loadMapWithWarnings(program, options.search.map, options.search.scale);
  std::optional<DriveLog> drive;
  if (options.sets.areAsked(options.search.file)) {
    drive = loadSearchedDrive(program, options.search, options.sets);
  }
  const std::vector<RangeScan> scans =
      drive ? firstScans(*drive) : loadSearchedScans(program, options.search);
  const std::vector<std::size_t> rows = chosenRows(options, scans.size());
  const ScanLocalizer localizer = makeLocalizer(std::move(loaded.map), options.search, rows.size());
  const std::vector<LocalizedScan> localized =
      drive ? localizeDrive(localizer, *drive, options.sets, rows, options.prior, options.search)
            : localizeScans(localizer, scans, rows, options.prior, options.search);

  OutputFiles files;
  const std::string csv = hypothesisCsv(localized);
  if (!options.output.empty()) files.add(options.output, csv);
  if (!options.svg.empty()) files.add(options.svg, scanPicture(localizer.map, scans, localized));
  if (!options.pf_ini.empty()) files.add(options.pf_ini, iniText(options, localized));
  files.commit();
  if (options.output.empty()) std::cout << csv;
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("polyloc-localize",
                  "Finds every pose in a map that explains a 2D laser scan.\n"
                  "CSV, one row per hypothesis: the pose of the robot in the map, m and deg.");
  LocalizeOptions options;
  addOptions(program.options(), options);
  return program.run(argc, argv, [&] { return localize(program, options); });
}
