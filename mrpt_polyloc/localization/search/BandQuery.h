#pragma once

#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/localization/scan/RobustCost.h>
#include <mrpt_polyloc/localization/search/QuantizedRange.h>
#include <mrpt_polyloc/localization/search/SearchMetric.h>
#include <mrpt_polyloc/localization/search/SearchTree.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// A scan as the certified search sees it: at most one beam per angular bin, ready to be held
/// against range bands at any heading.
///
/// Headings are multiples of the bins' width, shifted by the scan's phase, so that a beam of a
/// regular scanner whose spacing divides one degree meets exactly one bin per heading. Beams of
/// other scanners, or off that phase, would meet two; they are left out where enough are in phase.
struct BandQuery {
  /// Bins that are looked at together: bytes of an AVX-512 register, or of two of AVX2.
  static constexpr std::size_t kLanes = 64;
  static constexpr std::size_t kVectors = 3;
  static constexpr std::size_t kRoom = 384;  ///< the circle twice, in whole vectors

  /// \param cost truncations of the robust metric
  explicit BandQuery(const RangeScan& scan, const RobustCostParams& cost = {},
                     SearchMetric search_metric = SearchMetric::robust);

  /// Heading of the beam frame at the begin of heading bin h (0 to kBandBins - 1) [rad].
  double heading(double h) const { return h * kBandBinWidth - phase; }
  /// The search cost [m] that stands for a sum of units: of the finest unit of QuantizedRange, or
  /// of its square for the polar metric.
  double meters(unsigned units) const;
  /// The other way round, rounded down; the greatest where it would be exceeded.
  unsigned units(double meters) const;

  /// The scan in QuantizedRange of one scale, by the bin of a beam's bearing, the circle twice.
  struct Scaled {
    /// The range, where it is held against what it may fall short of, or against what it may have
    /// passed. Without a beam the former is the greatest and the latter 0, which cost nothing. A
    /// no-return falls short of nothing, and has passed what stands within the range where a wall
    /// would count.
    alignas(64) std::array<std::uint8_t, kRoom> short_range, long_range;
    std::uint8_t cap_short, cap_long, cap_none;
    std::uint8_t cap_gap, cap_open_gap;  ///< where no open edge may come before the wall, or may
  };
  std::array<Scaled, QuantizedRange::kScales> scaled;
  alignas(64) std::array<std::uint8_t, kRoom> no_return{};  ///< all bits, or none
  /// The same in the units of SearchTree::View.
  alignas(64) std::array<std::uint16_t, kRoom> short_view{}, long_view{}, no_return_view{};
  std::uint16_t cap_short_view = 0, cap_long_view = 0, cap_open_view = 0, cap_none_view = 0;
  std::array<bool, kRoom> informs_from{};  ///< whether a vector from there on holds a beam
  SearchMetric metric;
  bool has_wide_caps = false;  ///< sums of bytes might overflow
  double phase = 0.0;          ///< [rad]
  bool is_in_phase = true;     ///< every beam meets one bin per heading
  bool has_no_returns = false;
  std::vector<Beam> beams;  ///< those that take part

 private:
  using ChosenBeams = std::array<const Beam*, kBandBins>;  ///< one a bin, or null
  ChosenBeams choose(const std::vector<Beam>& informative);
  void takeRanges(const ChosenBeams& chosen, const RobustCostParams& cost);
  void takeViewRanges(const ChosenBeams& chosen, const RobustCostParams& cost);
};

}  // namespace mrpt_polyloc
