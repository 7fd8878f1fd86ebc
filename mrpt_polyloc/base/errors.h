#pragma once

#include <mrpt_polyloc/base/export.h>

#include <stdexcept>
#include <string>

namespace mrpt_polyloc {

/// A file that cannot be read as what its name says: names the file and the place (line, coordinate
/// or field) in `what()`, as `FILE: PLACE: REASON` (PLACE left out when there is none).
class POLYLOC_EXPORT FormatError : public std::runtime_error {
 public:
  FormatError(const std::string& file, const std::string& place, const std::string& reason)
      : std::runtime_error(file + ": " + (place.empty() ? "" : place + ": ") + reason) {}
};

/// A map that cannot be used: `what()` says why, with the coordinates of the first defects.
class POLYLOC_EXPORT InvalidMapError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An option outside its range: `what()` names the field, its value and the range.
class POLYLOC_EXPORT InvalidParamsError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace mrpt_polyloc
