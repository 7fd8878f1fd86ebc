#pragma once

#include <mrpt_polyloc/base/export.h>

namespace mrpt_polyloc {

/// What the answer means.
enum class LocalizationStatus {
  unique,     ///< the first hypothesis has no rival that explains the scan as well
  ambiguous,  ///< several poses explain the scan about equally well
  /// No pose explains the scan: another building, or too much changed. (Of a search that a budget
  /// ended: none of those found by then.)
  no_match,
  too_few_beams  ///< the scan holds too little information to search for
};

/// "unique", "ambiguous", "no_match" or "too_few_beams".
POLYLOC_EXPORT const char* toString(LocalizationStatus status);

}  // namespace mrpt_polyloc
