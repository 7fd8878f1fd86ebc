#pragma once

#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// By how much one pose explains a scan worse than another, and how sure that is.
struct PairedDifference {
  double mean = 0.0;            ///< over the beams [m]
  double standard_error = 0.0;  ///< of the mean, by the scatter among sectors of beams [m]
};

/// The beams of a scan in sectors of ten degrees. Neighbouring beams hit the same objects, so that
/// not beams but sectors are the independent observations, however finely a sensor resolves them.
class BeamSectors {
 public:
  static constexpr std::size_t kSectors = 36;  ///< of the whole circle

  /// \param beams those whose costs are compared, with finite bearings
  explicit BeamSectors(const std::vector<Beam>& beams);

  /// Sectors that hold a beam.
  std::size_t count() const { return sizes_.size(); }

  /// Of the costs of two poses, beam by beam: mean of (b - a) and its standard error. With fewer
  /// than two sectors the error is the difference itself: nothing is sure.
  PairedDifference difference(const std::vector<float>& a, const std::vector<float>& b) const;

 private:
  std::vector<std::uint8_t> sector_of_;  ///< of each beam
  std::vector<double> sizes_;            ///< beams of each sector
};

}  // namespace mrpt_polyloc
