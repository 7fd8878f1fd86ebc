#pragma once

#include "Cli.h"
#include <mrpt_polyloc/io/scan_files.h>

namespace mrpt_polyloc::apps {

/// Adds --max-range, --min-range and --strict: what every program that reads scans asks for.
void addReadingOptions(CLI::App& cli, ScanFileOptions& file);

}  // namespace mrpt_polyloc::apps
