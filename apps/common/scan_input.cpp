#include "scan_input.h"

namespace mrpt_polyloc::apps {

void addReadingOptions(CLI::App& cli, ScanFileOptions& file) {
  constexpr double kMost = 1e6;  // [m]
  addNumber(
      cli, "--max-range", [&file](double range) { file.readings.max_range = range; },
      {0.0, kMost, true},
      "Maximum range of the laser: readings from 98 % of it on are of nothing that came back "
      "[default: what the log says, or shows]")
      ->type_name("M");
  addNumber(
      cli, "--min-range", [&file](double range) { file.readings.min_range = range; }, {0.0, kMost},
      "Hits nearer than this say nothing [default: all count but those of beams that see the robot "
      "itself]")
      ->type_name("M");
  cli.add_flag("--strict", file.strict,
               "Refuse a log that is cut short, instead of reading the "
               "whole part of it");
}

}  // namespace mrpt_polyloc::apps
