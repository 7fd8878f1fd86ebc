#pragma once

#include <limits>

/// Values that are no ordinary numbers, in double and, with an F as of literals, in float.
namespace mrpt_polyloc::test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kInfinityF = std::numeric_limits<float>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr float kNaNF = std::numeric_limits<float>::quiet_NaN();

}  // namespace mrpt_polyloc::test
