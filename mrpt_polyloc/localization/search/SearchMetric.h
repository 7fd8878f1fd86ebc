#pragma once

namespace mrpt_polyloc {

/// By what the certified search holds views against a scan. Both are in metres.
enum class SearchMetric {
  robust,  ///< the mean over beams of RobustCost
  /// The paper's polar coordinate metric at the beams: the root mean square of the differences
  /// between the scan's ranges and those to the first wall. No-returns take no part, and open edges
  /// count for nothing. One beam that ends early may cost more than all others together.
  polar
};

}  // namespace mrpt_polyloc
