#pragma once

#include "../common/Cli.h"
#include "../common/search.h"
#include <mrpt_polyloc/geometry/OccupancyBitmap.h>

#include <cstdint>
#include <optional>
#include <string>

namespace mrpt_polyloc::apps {

/// What a list may say of a baseline; what it does not say is the baseline's default.
struct BaselineOptions {
  std::string method;
  double cell = 0.05;  ///< of the grid that polygon maps are drawn into [m]
  std::optional<double> step, sigma;
  std::uint64_t headings = 0, refined = 0, hits = 0, particles = 0;  ///< 0: the default
  double drive = 5.0;  ///< of the particle filter: so many metres before each row [m]
};

/// likelihood_lattice, correlative or particle_filter.
bool isBaseline(const std::string& method);

/// Whether a baseline takes the drive before a row, not the row's scan alone.
bool needsDrive(const BaselineOptions& options);

/// Adds --cell, --step, --sigma, --headings, --refined, --hits, --particles and --drive.
void addBaselineOptions(CLI::App& cli, BaselineOptions& options);

/// A baseline as the programs see a method. Its answers have no status: they are `ambiguous`,
/// their weights and their match are their scores, their costs one minus these.
/// \throws InvalidMapError, InvalidParamsError
ScanLocalizer makeBaseline(const PolygonMap& map, const OccupancyBitmap& bitmap,
                           const BaselineOptions& options);

}  // namespace mrpt_polyloc::apps
