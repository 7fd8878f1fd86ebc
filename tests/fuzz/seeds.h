#pragma once

#include <map>
#include <string>
#include <vector>

namespace mrpt_polyloc::fuzz {

/// Inputs that are right, or nearly so, by the target's name: what fuzzing starts from.
std::map<std::string, std::vector<std::string>> seeds();

}  // namespace mrpt_polyloc::fuzz
