#include <mrpt_polyloc/visibility/BeamPattern.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mrpt_polyloc {

BeamPattern::BeamPattern(const std::vector<double>& bearings) : order_(bearings.size()) {
  constexpr double kPi = 3.14159265358979323846;
  std::vector<double> wrapped(bearings.size());
  std::transform(bearings.begin(), bearings.end(), wrapped.begin(),
                 [](double b) { return b - 2.0 * kPi * std::floor((b + kPi) / (2.0 * kPi)); });
  std::iota(order_.begin(), order_.end(), std::uint32_t{0});
  std::stable_sort(order_.begin(), order_.end(), [&wrapped](std::uint32_t a, std::uint32_t b) {
    return wrapped[a] < wrapped[b];
  });
  for (const std::uint32_t i : order_) {
    bearings_.push_back(static_cast<float>(wrapped[i]));
    cosines_.push_back(static_cast<float>(std::cos(wrapped[i])));
    sines_.push_back(static_cast<float>(std::sin(wrapped[i])));
  }

  // Slots so narrow that each holds about one beam of a full circle; one more takes the angle pi
  // (and what rounding puts just beyond it).
  const std::size_t slots = std::max<std::size_t>(64, 2 * bearings.size());
  slots_per_radian_ = static_cast<float>(static_cast<double>(slots) / (2.0 * kPi));
  first_in_slot_.resize(slots + 2);
  std::size_t beam = 0;
  for (std::size_t slot = 0; slot < first_in_slot_.size(); ++slot) {
    // One slot early: the float product in firstFrom() may round up to the next slot.
    const double start =
        -kPi + (static_cast<double>(slot) - 1.0) / static_cast<double>(slots_per_radian_);
    while (beam < wrapped.size() && static_cast<double>(bearings_[beam]) < start) ++beam;
    first_in_slot_[slot] = static_cast<std::uint32_t>(beam);
  }
}

}  // namespace mrpt_polyloc
