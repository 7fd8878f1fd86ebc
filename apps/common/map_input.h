#pragma once

#include "Cli.h"
#include <mrpt_polyloc/geometry/validation.h>

#include <string>

namespace mrpt_polyloc::apps {

/// What --map and INPUT take, for the help texts.
extern const char* const kMapFormats;

/// Warns of what had to be repaired in a map: the first few repairs, and how many more.
void warnOfRepairs(const Program& program, const std::string& path,
                   const std::vector<Repair>& repairs);

/// Loads a map, warns of what had to be repaired in it, and notes what was assumed of it.
/// \param scale metres per unit of the file
/// \throws FormatError, InvalidMapError
RepairedMap loadMapWithWarnings(const Program& program, const std::string& path,
                                double scale = 1.0);

/// Adds --scale: what every program that reads a map of its user's asks for.
void addScaleOption(CLI::App& cli, double& scale);

}  // namespace mrpt_polyloc::apps
