#pragma once

#include <optional>
#include <string_view>

namespace mrpt_polyloc {

/// The number that the whole of `text` spells (decimal point whatever the locale; a leading plus
/// sign, nan and inf allowed); none if it is anything else.
std::optional<double> parseNumber(std::string_view text);

}  // namespace mrpt_polyloc
