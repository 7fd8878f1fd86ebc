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

/// Loads a map and warns of what had to be repaired in it.
/// \throws FormatError, InvalidMapError
RepairedMap loadMapWithWarnings(const Program& program, const std::string& path);

}  // namespace mrpt_polyloc::apps
