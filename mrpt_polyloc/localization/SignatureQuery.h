#pragma once

#include <mrpt_polyloc/geometry/angles.h>
#include <mrpt_polyloc/localization/RangeScan.h>
#include <mrpt_polyloc/localization/RobustCost.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace mrpt_polyloc {

/// Bins of the circle in a signature: 1.4 degrees each; the number of headings searched, too.
constexpr std::size_t kBins = 256;

/// The caps of the search's cost, in steps of RangeCode; at most 63, so that sums over the bins fit
/// in bytes.
struct SignatureCosts {
  std::uint8_t cap_short = 20;  ///< beam ends before the wall
  std::uint8_t cap_long = 32;   ///< beam passes the wall
  std::uint8_t cap_open = 10;   ///< beam passed an open edge
  std::uint8_t cap_none = 6;    ///< no return where a near wall stands

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// A scan as the search sees it: per angular bin the code of its range, and the caps of its costs
/// (all 0: the bin says nothing). Every array holds the circle twice, so that any rotation of it is
/// a run of kBins entries.
struct SignatureQuery {
  std::array<std::uint8_t, 2 * kBins> range{};
  std::array<std::uint8_t, 2 * kBins> cap_short{};
  std::array<std::uint8_t, 2 * kBins> cap_long{};
  std::array<std::uint8_t, 2 * kBins> cap_open{};
  std::size_t used_bins = 0;  ///< of kBins

  /// Whether any of the 64 bins from `first` (<= 2 kBins - 64) on says something.
  bool informsFrom(std::size_t first) const { return informs_from_[first]; }

  /// Takes for each bin the beam nearest to its centre, hits before no-returns.
  /// \param none_share see RobustCostParams
  explicit SignatureQuery(const RangeScan& scan, const SignatureCosts& costs = {},
                          double none_share = RobustCostParams{}.none_share);

 private:
  std::array<bool, 2 * kBins> informs_from_{};
};

/// The heading that the search calls `bin` [rad].
inline double headingOfBin(std::size_t bin) {
  return kTwoPi * static_cast<double>(bin) / static_cast<double>(kBins);
}

}  // namespace mrpt_polyloc
