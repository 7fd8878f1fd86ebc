#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/visibility/BeamPattern.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace mrpt_polyloc {

BeamPattern::BeamPattern(const std::vector<double>& bearings) : order_(bearings.size()) {
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    if (!std::isfinite(bearings[i])) {
      throw InvalidParamsError("bearings[" + std::to_string(i) + "]: not finite");
    }
  }
  std::vector<double> wrapped(bearings.size());
  std::transform(bearings.begin(), bearings.end(), wrapped.begin(),
                 [](double b) { return b - 2.0 * kPi * std::floor((b + kPi) / (2.0 * kPi)); });
  std::iota(order_.begin(), order_.end(), std::uint32_t{0});
  std::stable_sort(order_.begin(), order_.end(), [&wrapped](std::uint32_t a, std::uint32_t b) {
    return wrapped[a] < wrapped[b];
  });
  is_in_order_ = std::is_sorted(order_.begin(), order_.end());
  cosines_.assign(bearings.size(), 0.0F);
  sines_.assign(bearings.size(), 0.0F);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const double bearing = wrapped[order_[i]];
    bearings_.push_back(static_cast<float>(bearing));
    cosines_[i] = static_cast<float>(std::cos(bearing));
    sines_[i] = static_cast<float>(std::sin(bearing));
  }

  // About six slots to a beam of a full circle: regular patterns then have one beam a slot at most.
  std::size_t slots = 64;
  while (slots < 4 * bearings.size()) slots *= 2;
  slots_per_radian_ = static_cast<float>(static_cast<double>(slots) / (2.0 * kPi));
  std::vector<std::int32_t> beams_in_slot(slots + 4);
  for (const float bearing : bearings_) {
    ++beams_in_slot[static_cast<std::size_t>(slotOf(bearing, slots_per_radian_))];
  }
  first_in_slot_.resize(beams_in_slot.size());
  std::partial_sum(beams_in_slot.begin(), beams_in_slot.end() - 1, first_in_slot_.begin() + 1);
  const std::int32_t most = *std::max_element(beams_in_slot.begin(), beams_in_slot.end());
  while (2 * greatest_step_ <= most) greatest_step_ *= 2;

  // The search may look so far beyond the last beam, for angles that none comes after.
  constexpr float kBeyond = 10.0F;
  bearings_.resize(bearings_.size() + 2 * static_cast<std::size_t>(greatest_step_), kBeyond);
}

}  // namespace mrpt_polyloc
