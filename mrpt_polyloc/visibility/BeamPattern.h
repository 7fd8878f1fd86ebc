#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// The bearings of a scan, sorted and with their sines and cosines, so that the beams an edge
/// covers are one run (or two) of consecutive ones. Immutable.
class BeamPattern {
 public:
  /// \param bearings any order, any number, repeated ones too; finite [rad]
  explicit BeamPattern(const std::vector<double>& bearings);

  std::size_t size() const { return order_.size(); }
  /// order()[i] is the place in the constructor's argument of the i-th sorted beam.
  const std::vector<std::uint32_t>& order() const { return order_; }
  /// Of the sorted beams, in [-pi, pi).
  const float* bearings() const { return bearings_.data(); }
  const float* cosines() const { return cosines_.data(); }
  const float* sines() const { return sines_.data(); }

  /// Index of the first sorted beam at or after an angle in [-pi, pi]; size() if there is none.
  std::size_t firstFrom(float angle) const {
    const float slot = (angle - kLeast) * slots_per_radian_;
    std::size_t beam = first_in_slot_[slot > 0.0F ? static_cast<std::size_t>(slot) : 0];
    while (beam < order_.size() && bearings_[beam] < angle) ++beam;
    return beam;
  }

 private:
  static constexpr float kLeast = -3.14159265F;
  std::vector<std::uint32_t> order_;
  std::vector<float> bearings_, cosines_, sines_;
  // first_in_slot_[k]: the first beam in or after the k-th of equal slots of the circle.
  float slots_per_radian_ = 1.0F;
  std::vector<std::uint32_t> first_in_slot_;
};

}  // namespace mrpt_polyloc
