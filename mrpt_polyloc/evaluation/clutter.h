#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <cstdint>

namespace mrpt_polyloc {

/// What stands before a sensor that is not in the map.
struct POLYLOC_EXPORT Clutter {
  double short_beams = 0.0;       ///< probability that a hit is cut to a random shorter range
  double occluders_a_circle = 0;  ///< objects for each 360 degrees of the field of view

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// A real scan with clutter added, as Simulator adds it to simulated ones: short beams end
/// uniformly between the sensor and what they hit; an occluder covers 8 to 19 degrees at 20 to 90 %
/// of the range of its middle beam. No-returns stay where nothing is put before them. The same seed
/// gives the same scan. \throws InvalidParamsError
POLYLOC_EXPORT RangeScan withClutter(const RangeScan& scan, const Clutter& clutter,
                                     std::uint64_t seed);

}  // namespace mrpt_polyloc
