#pragma once

#include "Cli.h"
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/localization/MapIndex.h>

#include <optional>
#include <string>

namespace mrpt_polyloc::apps {

/// Adds --max-memory: what the index of a map may take [MB].
void addMemoryOption(CLI::App& cli, std::optional<double>& megabytes);

/// Refuses a map of which the index would take more memory than is allowed, before anything is
/// built. \param allowed [MB]; not given: half of what is free now, or anything where the system
/// does not tell \param another_way out that the program knows, "do so; "
/// \throws FormatError naming the map, with the estimate and the ways out
void requireMemory(const std::string& path, const PolygonMap& map, const MapIndexParams& params,
                   const std::optional<double>& allowed, const std::string& another_way = {});

/// Makes the system refuse this process more memory than is free now, so that a file
/// that asks for more fails as an error, and the machine does not swap. A lower limit that is set
/// already stays. Does nothing where the system does not tell, or under a sanitizer.
void limitMemory();

/// What new programs can take without swapping [MB], as the system says; none if it does not.
std::optional<double> freeMegabytes();

}  // namespace mrpt_polyloc::apps
