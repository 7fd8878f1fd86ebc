#pragma once

#include <mrpt_polyloc/base/export.h>

#include <mrpt/math/TPoint2D.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mrpt_polyloc {

// Numbers as text, to be read and written by programs: with a decimal point and without grouping,
// whatever the host's locale is (a viewer with a window sets it to its user's).

/// The number that the whole of a text spells (a leading plus sign, nan and inf allowed); none if
/// it is anything else, or out of range.
POLYLOC_EXPORT std::optional<double> parseNumber(std::string_view text);

/// The decimal integer that the whole of a text is: digits only; none if it is anything else.
POLYLOC_EXPORT std::optional<std::uint64_t> parseCount(std::string_view text);

/// Appends the shortest decimal text that reads back as exactly this finite number; without
/// exponent for numbers a map is likely to hold.
POLYLOC_EXPORT void appendNumber(std::string& text, double value);

/// What std::printf() would print in the "C" locale.
POLYLOC_EXPORT __attribute__((format(printf, 1, 2))) std::string formatted(const char* format, ...);

/// "(X, Y)" with six decimals, for messages.
POLYLOC_EXPORT std::string pointText(const mrpt::math::TPoint2D& point);

}  // namespace mrpt_polyloc
