#pragma once

#include <mrpt_polyloc/polar/RotationRange.h>
#include <mrpt_polyloc/polar/SampledPolarFunction.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace mrpt_polyloc {

/// A lower bound of the sampled polar coordinate metric over rotations, for partial views too.
///
/// The samples of f are cut into bins of w neighbours each. In a bin the sum of squared differences
/// is at least w times the square of the mean difference (Jensen), so for every rotation s
/// distance^2 >= (2 pi / k) Sum_bins w (mean of f - mean of g where the bin comes to lie)^2. This
/// is computed for all rotations of a range, and the least taken.
class BinMeansBound {
 public:
  /// \param f what others are compared with; neighbouring valid samples too few for a bin take no
  /// part \param width of a bin in samples, a power of two not above k
  /// \throws InvalidParamsError for a bad width or range.
  explicit BinMeansBound(const SampledPolarFunction& f, std::size_t width = 8,
                         const RotationRange& range = {});

  /// At most distanceOverRotations(f, g, range).distance, where g is cut off at `reach` [m] first.
  /// Rounding, in single precision, is allowed for. [m rad^(1/2)]
  /// \throws InvalidParamsError if g is partial or of another number of samples.
  /// O(k (bins + log w)), vectorised.
  double operator()(const SampledPolarFunction& g,
                    double reach = std::numeric_limits<double>::infinity()) const;

  std::size_t binCount() const { return starts_.size(); }

 private:
  std::size_t k_, width_;
  IndexRange rotations_;
  double norm_;                        // of f
  std::vector<std::uint32_t> starts_;  // of the bins, for the first rotation
  std::vector<float> means_;           // of f in them
};

}  // namespace mrpt_polyloc
