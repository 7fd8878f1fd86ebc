#pragma once

#include <mrpt_polyloc/base/export.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// A stated probability and whether it came true.
struct POLYLOC_EXPORT Forecast {
  double probability = 0.0;
  bool came_true = false;
};

/// The forecasts of one interval of probabilities.
struct POLYLOC_EXPORT ReliabilityBin {
  double from = 0.0, to = 0.0;  ///< [from, to); the last bin holds its end, too
  std::size_t count = 0;
  double stated = 0.0;      ///< mean stated probability; 0 if there is none
  double true_share = 0.0;  ///< share that came true; 0 if there is none
};

/// The reliability diagram of forecasts: of what was stated with probability p, a share of p should
/// come true. \param edges rising, at least two \throws InvalidParamsError for other edges
POLYLOC_EXPORT std::vector<ReliabilityBin> reliability(const std::vector<Forecast>& forecasts,
                                                       const std::vector<double>& edges);

/// Mean over the forecasts of |stated - true share| of their bin.
POLYLOC_EXPORT double calibrationError(const std::vector<ReliabilityBin>& bins);

}  // namespace mrpt_polyloc
