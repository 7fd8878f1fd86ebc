#pragma once

#include <mrpt_polyloc/base/errors.h>

#include <mrpt/config/CConfigFileBase.h>

#include <string>
#include <vector>

namespace mrpt_polyloc {

/// A misspelt option would be silently replaced by its default.
/// \throws InvalidParamsError naming the section and the first name in it that is not known
void requireKnownKeys(const mrpt::config::CConfigFileBase& source, const std::string& section,
                      const std::vector<std::string>& known);

/// The number that an option spells, or `otherwise` where it is not given or empty. MRPT's
/// read_double() takes a word for 0. \throws InvalidParamsError naming the option
double readNumber(const mrpt::config::CConfigFileBase& source, const std::string& section,
                  const std::string& name, double otherwise);

/// Calls act(), and has its InvalidParamsError name the section, too. Without brackets, for MRPT
/// takes what stands before one in a message for a place in its source.
template <class Act>
void namingSection(const std::string& section, const Act& act) {
  try {
    act();
  } catch (const InvalidParamsError& error) {
    throw InvalidParamsError(std::string(error.what()) + " in section '" + section + "'");
  }
}

}  // namespace mrpt_polyloc
