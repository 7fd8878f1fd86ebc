// polyloc-localize: where were these scans taken? See README.md beside this file.

#include "../common/Cli.h"
#include "../common/OutputFiles.h"
#include "../common/angles.h"
#include "../common/map_input.h"
#include "../common/parsing.h"
#include "../common/search.h"
#include "hypothesis_csv.h"
#include "particle_filter_ini.h"
#include "scan_picture.h"
#include <mrpt_polyloc/geometry/errors.h>
#include <mrpt_polyloc/mrpt_bridge/scan_files.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace mrpt_polyloc;
using namespace mrpt_polyloc::apps;

struct Options {
  SearchOptions search;
  double compass_deg = 0.0;
  double compass_tolerance_deg = 10.0;  // what a compass indoors is good for
  bool has_compass = false;
  std::string near, rows, sensor, index, svg, pf_ini, output;
  double laser_fov_deg = 0.0;   // 0: not given
  double time_budget_ms = 0.0;  // 0: not given
};

void addOptions(CLI::App& cli, Options& options) {
  addSearchOptions(cli, options.search);
  CLI::Option* const compass =
      addNumber(cli, "--compass", options.compass_deg, {}, "Heading of the robot in the map")
          ->type_name("DEG");
  addNumber(cli, "--compass-tolerance", options.compass_tolerance_deg, {0.0, 180.0},
            "Greatest error of the compass [default: 10]")
      ->type_name("DEG")
      ->needs(compass);
  cli.add_option("--near", options.near, "The robot is within R metres of (X, Y)")
      ->type_name("X,Y,R");
  cli.add_option("--rows", options.rows, "Only these scans: 0-based, ranges inclusive")
      ->type_name("I,J-K");
  cli.add_option("--sensor", options.sensor, "Only scans of the sensor of this label")
      ->type_name("LABEL");
  addNumber(cli, "--laser-fov", options.laser_fov_deg, {0.0, 360.0, true},
            "Field of view of a CARMEN laser, where the log does not say it")
      ->type_name("DEG");
  cli.add_option("--index", options.index, "Keep the search index in a file (not built yet)")
      ->type_name("FILE");
  addNumber(cli, "--time-budget", options.time_budget_ms, {0.0, 1e12, true},
            "Most time for a scan; needs --method certified (not built yet)")
      ->type_name("MS");
  cli.add_option("--svg", options.svg,
                 "Draw the map, the last localized scan and its hypotheses, and the path")
      ->type_name("PIC.svg");
  cli.add_option("--pf-ini", options.pf_ini,
                 "Write the start of the particles for MRPT's pf-localization: a box around the "
                 "first hypothesis of the first localized scan")
      ->type_name("OUT.ini");
  cli.add_option("-o", options.output, "Write the CSV there [default: standard output]")
      ->type_name("OUT.csv");
}

void checkUsage(const Options& options) {
  checkMethod(options.search);
  if (options.time_budget_ms > 0.0) {
    throw UsageError(
        "the exhaustive search always finishes; --time-budget needs --method certified");
  }
  if (!options.index.empty()) throw UsageError("--index is not built yet");
}

PosePrior priorOf(const Options& options) {
  PosePrior prior;
  if (options.has_compass) {
    prior.compass = PosePrior::Compass{toRadians(options.compass_deg),
                                       toRadians(options.compass_tolerance_deg)};
  }
  if (!options.near.empty()) prior.near = parseDisk(options.near);
  return prior;
}

std::vector<RangeScan> loadChosenScans(const Options& options) {
  ScanFileOptions file;
  file.sensor_label = options.sensor;
  if (options.laser_fov_deg > 0.0) file.laser_fov = toRadians(options.laser_fov_deg);
  return loadScans(options.search.scans, file);
}

std::vector<std::size_t> chosenRows(const Options& options, const std::vector<RowRange>& ranges,
                                    std::size_t count) {
  const std::vector<std::size_t> rows = selectRows(ranges, count);
  if (rows.empty()) {
    throw FormatError(options.search.scans, "--rows " + options.rows,
                      "no such row; the file holds the rows 0 to " + std::to_string(count - 1));
  }
  return rows;
}

/// Lines for the particle filter, from the first scan that could be localized.
std::string iniText(const Options& options, const std::vector<LocalizedScan>& localized) {
  for (const LocalizedScan& scan : localized) {
    const auto& hypotheses = scan.result.hypotheses;
    if (!hypotheses.empty()) return particleFilterIni(hypotheses.front());
  }
  throw FormatError(options.pf_ini, "", "not written: no scan could be localized");
}

int localize(const Program& program, const Options& options) {
  checkUsage(options);
  const PosePrior prior = priorOf(options);
  constexpr RowRange kAll{0, std::numeric_limits<std::uint64_t>::max()};
  const std::vector<RowRange> ranges =
      options.rows.empty() ? std::vector<RowRange>{kAll} : parseRows(options.rows);
  for (const std::string& path : {options.output, options.svg, options.pf_ini}) {
    requireWritable(path);
  }

  RepairedMap loaded = loadMapWithWarnings(program, options.search.map);
  const std::vector<RangeScan> scans = loadChosenScans(options);
  const std::vector<std::size_t> rows = chosenRows(options, ranges, scans.size());
  const GlobalLocalizer localizer = makeLocalizer(std::move(loaded.map), options.search);
  const std::vector<LocalizedScan> localized =
      localizeScans(localizer, scans, rows, prior, options.search);

  OutputFiles files;
  const std::string csv = hypothesisCsv(localized);
  if (!options.output.empty()) files.add(options.output, csv);
  if (!options.svg.empty()) files.add(options.svg, scanPicture(localizer.map(), scans, localized));
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
  Options options;
  addOptions(program.options(), options);
  return program.run(argc, argv, [&] {
    options.has_compass = program.options().count("--compass") > 0;
    return localize(program, options);
  });
}
