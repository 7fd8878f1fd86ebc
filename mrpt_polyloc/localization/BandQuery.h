#pragma once

#include <mrpt_polyloc/localization/CellTree.h>
#include <mrpt_polyloc/localization/RangeScan.h>
#include <mrpt_polyloc/localization/RobustCost.h>

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
  static constexpr std::size_t kRoom = 384;  ///< the circle twice, in whole vectors

  explicit BandQuery(const RangeScan& scan, const RobustCostParams& cost = {});

  /// Heading of the beam frame at the begin of heading bin h (0 to kBandBins - 1) [rad].
  double heading(double h) const { return h * kBandBinWidth - phase; }
  /// The search cost [m] that stands for a sum of units.
  double meters(unsigned units) const {
    return static_cast<double>(units) / (RangeUnits::kPerMeter * static_cast<double>(beams.size()));
  }
  unsigned units(double meters) const {
    return static_cast<unsigned>(meters * RangeUnits::kPerMeter *
                                 static_cast<double>(beams.size()));
  }

  /// By the bin of a beam's bearing, the circle twice [RangeUnits]: the range, where it is held
  /// against what it may fall short of, or against what it may have passed. Without a beam the
  /// former is the greatest and the latter 0, which cost nothing. A no-return falls short of
  /// nothing, and has passed what stands within the range where a wall would count.
  alignas(64) std::array<std::uint16_t, kRoom> short_range{}, long_range{};
  alignas(64) std::array<std::uint16_t, kRoom> cap_long{};   ///< differs for no-returns
  alignas(64) std::array<std::uint16_t, kRoom> no_return{};  ///< all bits, or none
  std::uint16_t cap_short = 0, cap_open = 0;
  std::array<bool, kRoom> informs_from{};  ///< whether a vector from there on holds a beam
  double phase = 0.0;                      ///< [rad]
  bool is_in_phase = true;                 ///< every beam meets one bin per heading
  bool has_no_returns = false;
  std::vector<Beam> beams;  ///< those that take part
};

/// Lower bound of the search cost, RobustCost summed over the query's beams [units], over all poses
/// of a node: positions of its cells, headings from bin `heading` on, as many as its level's
/// window.
unsigned bandCost(const CellTree::Bands& bands, const BandQuery& query, std::size_t heading);

}  // namespace mrpt_polyloc
