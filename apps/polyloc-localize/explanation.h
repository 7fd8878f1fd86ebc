#pragma once

#include "LocalizeOptions.h"

#include <string>

namespace mrpt_polyloc::apps {

/// What was made of a map and a log before anything is searched: what was assumed, figures, and
/// what looks odd, each with what to try. For --explain. \throws FormatError, InvalidMapError as
/// the loaders
std::string explain(const LocalizeOptions& options);

}  // namespace mrpt_polyloc::apps
