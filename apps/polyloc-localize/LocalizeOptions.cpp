#include "LocalizeOptions.h"

#include "../common/map_input.h"
#include <mrpt_polyloc/base/angles.h>

namespace mrpt_polyloc::apps {
namespace {

void addPriorOptions(CLI::App& cli, LocalizeOptions& options) {
  CLI::Option* const compass =
      addNumber(
          cli, "--compass",
          [&options](double degrees) {
            options.prior.compass =
                PosePrior::Compass{toRadians(degrees), toRadians(options.compass_tolerance_deg)};
          },
          {}, "Heading of the robot in the map")
          ->type_name("DEG");
  addNumber(
      cli, "--compass-tolerance",
      [&options](double degrees) {
        options.compass_tolerance_deg = degrees;
        if (options.prior.compass) options.prior.compass->tolerance = toRadians(degrees);
      },
      {0.0, 180.0}, "Greatest error of the compass [default: 10]")
      ->type_name("DEG")
      ->needs(compass);
  cli.add_option_function<std::string>(
         "--near", [&options](const std::string& text) { options.prior.near = parseDisk(text); },
         "The robot is within R metres of (X, Y)")
      ->type_name("X,Y,R");
}

/// --map may be given several times.
void addMaps(CLI::App& cli, LocalizeOptions& options) {
  cli.remove_option(cli.get_option("--map"));
  cli.add_option_function<std::vector<std::string>>(
         "--map",
         [&options](const std::vector<std::string>& maps) {
           for (const std::string& map : maps) {
             if (map.empty()) throw UsageError("--map: the name is empty");
           }
           options.maps = maps;
           options.search.map = maps.front();
         },
         std::string(kMapFormats) + "; given several times: in which of them, and where?")
      ->required()
      ->allow_extra_args(false)
      ->take_all()
      ->type_name("MAP");
}

void addScanOptions(CLI::App& cli, LocalizeOptions& options) {
  cli.add_option_function<std::string>(
         "--rows",
         [&options](const std::string& text) {
           options.rows = text;
           options.ranges = parseRows(text);
         },
         "Only these scans: 0-based, ranges inclusive")
      ->type_name("I,J-K");
  addSetOptions(cli, options.sets, options.search.file);
  addNumber(
      cli, "--laser-fov",
      [&options](double degrees) { options.search.file.laser_fov = toRadians(degrees); },
      {0.0, 360.0, true}, "Field of view of a CARMEN laser, where the log does not say it")
      ->type_name("DEG");
}

void addOutputOptions(CLI::App& cli, LocalizeOptions& options) {
  cli.add_flag(
      "--explain", options.explain,
      "Search nothing: print what was assumed of the map and of the readings, with figures, "
      "and what looks odd");
  addText(cli, "--svg", options.svg,
          "Draw the map, the last localized scan with its hypotheses, and the path of the best")
      ->type_name("PIC.svg");
  addText(cli, "--pf-ini", options.pf_ini,
          "Write where MRPT's pf-localization shall start its particles: a box around the first "
          "hypothesis of the first localized scan")
      ->type_name("OUT.ini");
  addText(cli, "-o", options.output, "Write the CSV there [default: standard output]")
      ->type_name("OUT.csv");
}

}  // namespace

void addOptions(CLI::App& cli, LocalizeOptions& options) {
  addSearchOptions(cli, options.search);
  addMaps(cli, options);
  addPriorOptions(cli, options);
  addScanOptions(cli, options);
  addCertifiedOptions(cli, options.search);
  addOutputOptions(cli, options);
}

}  // namespace mrpt_polyloc::apps
