#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <string>
#include <vector>

namespace mrpt_polyloc {

/// A misspelt option would be silently replaced by its default.
/// \throws InvalidParamsError naming the section and the first name in it that is not known
void requireKnownKeys(const mrpt::config::CConfigFileBase& source, const std::string& section,
                      const std::vector<std::string>& known);

/// The number that an option spells, or `otherwise` where it is not given or empty. MRPT's
/// read_double() takes a word for 0. \throws InvalidParamsError naming section and option
double readNumber(const mrpt::config::CConfigFileBase& source, const std::string& section,
                  const std::string& name, double otherwise);

}  // namespace mrpt_polyloc
