#pragma once

#include "../common/parsing.h"
#include "../common/scan_sets.h"
#include "../common/search.h"
#include <mrpt_polyloc/localization/scan/PosePrior.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// The command line of polyloc-localize.
struct LocalizeOptions {
  SearchOptions search;
  SetOptions sets;
  /// As given, one or several (floors, buildings); search.map is the first.
  std::vector<std::string> maps;
  PosePrior prior;
  double compass_tolerance_deg = 10.0;  ///< what a compass indoors is good for
  std::string rows;                     ///< --rows as given, for messages
  std::vector<RowRange> ranges = {{0, std::numeric_limits<std::uint64_t>::max()}};
  bool explain = false;             ///< tell what was made of map and scans, and search nothing
  std::string svg, pf_ini, output;  ///< paths; empty: not asked for
};

/// Adds all options of polyloc-localize to a command line.
void addOptions(CLI::App& cli, LocalizeOptions& options);

}  // namespace mrpt_polyloc::apps
