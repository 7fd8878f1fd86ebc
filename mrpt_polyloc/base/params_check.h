#pragma once

#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>

#include <cmath>

namespace mrpt_polyloc {

/// \throws InvalidParamsError unless low <= value <= high.
inline void requireInRange(const char* field, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw InvalidParamsError(formatted("%s is %f, not within [%f, %f]", field, value, low, high));
}

/// \throws InvalidParamsError unless the value is finite and greater than zero.
inline void requirePositive(const char* field, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw InvalidParamsError(formatted("%s is %f, not positive and finite", field, value));
}

/// \throws InvalidParamsError unless the value is finite and not below zero.
inline void requireNotNegative(const char* field, double value) {
  if (value >= 0.0 && std::isfinite(value)) return;
  throw InvalidParamsError(formatted("%s is %f, not zero or positive and finite", field, value));
}

}  // namespace mrpt_polyloc
