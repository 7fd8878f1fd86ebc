#pragma once

#include <mrpt_polyloc/base/errors.h>

#include <cmath>
#include <string>

namespace mrpt_polyloc {

/// \throws InvalidParamsError unless low <= value <= high.
inline void requireInRange(const char* field, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw InvalidParamsError(std::string(field) + " is " + std::to_string(value) + ", not within [" +
                           std::to_string(low) + ", " + std::to_string(high) + "]");
}

/// \throws InvalidParamsError unless the value is finite and greater than zero.
inline void requirePositive(const char* field, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw InvalidParamsError(std::string(field) + " is " + std::to_string(value) +
                           ", not positive and finite");
}

/// \throws InvalidParamsError unless the value is finite and not below zero.
inline void requireNotNegative(const char* field, double value) {
  if (value >= 0.0 && std::isfinite(value)) return;
  throw InvalidParamsError(std::string(field) + " is " + std::to_string(value) +
                           ", not zero or positive and finite");
}

}  // namespace mrpt_polyloc
