#pragma once

#include <mrpt_polyloc/visibility/FloatBlocks.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// The bearings of a scan, sorted and with their sines and cosines, so that the beams an edge
/// covers are one run (or two) of consecutive ones. Immutable.
class BeamPattern {
 public:
  /// \param bearings any order, any number, repeated ones too [rad]
  /// \throws InvalidParamsError for one that is not finite
  explicit BeamPattern(const std::vector<double>& bearings);

  std::size_t size() const { return order_.size(); }
  /// order()[i] is the place in the constructor's argument of the i-th sorted beam.
  const std::vector<std::uint32_t>& order() const { return order_; }
  /// Whether the constructor's argument is sorted already: order()[i] = i.
  bool isInOrder() const { return is_in_order_; }
  /// Of the sorted beams, in [-pi, pi].
  const float* bearings() const { return bearings_.data(); }
  /// In whole blocks (see FloatBlocks).
  const float* cosines() const { return cosines_.data(); }
  const float* sines() const { return sines_.data(); }

  /// For each angle, in [-pi, pi] up to rounding, the first sorted beam at or after it; size() if
  /// there is none. Without branches; to be inlined into vector code.
  __attribute__((always_inline)) void firstFrom(const float* __restrict__ angles, std::size_t count,
                                                std::int32_t* __restrict__ beams) const {
    const std::int32_t* __restrict__ first_in_slot = first_in_slot_.data();
    const float* __restrict__ bearings = bearings_.data();
    const float slots_per_radian = slots_per_radian_;
    for (std::size_t i = 0; i < count; ++i) {
      beams[i] = first_in_slot[slotOf(angles[i], slots_per_radian)];
    }
    for (std::int32_t step = greatest_step_; step > 0; step /= 2) {
      for (std::size_t i = 0; i < count; ++i) {
        beams[i] += bearings[beams[i] + step - 1] < angles[i] ? step : 0;
      }
    }
  }

 private:
  /// The circle is cut into equal slots; a few more take what rounding puts beyond pi.
  static std::int32_t slotOf(float angle, float slots_per_radian) {
    return static_cast<std::int32_t>((angle + 3.1415930F) * slots_per_radian);
  }

  std::vector<std::uint32_t> order_;
  bool is_in_order_ = true;
  std::vector<float> bearings_;
  FloatBlocks cosines_, sines_;
  std::vector<std::int32_t> first_in_slot_;  ///< the first beam in or after a slot
  float slots_per_radian_ = 1.0F;
  std::int32_t greatest_step_ = 1;  ///< power of two above half the most beams in a slot
};

}  // namespace mrpt_polyloc
