#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/scan/BeamSectors.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mrpt_polyloc {
namespace {

std::size_t sectorOf(double bearing) {
  const double turns = std::remainder(bearing, kTwoPi) / kTwoPi + 0.5;
  // Bearings at a whole number of degrees must not be torn apart by rounding.
  constexpr double kSlack = 1e-6;
  const double sector = std::floor(turns * static_cast<double>(BeamSectors::kSectors) + kSlack);
  return static_cast<std::size_t>(sector) % BeamSectors::kSectors;
}

}  // namespace

BeamSectors::BeamSectors(const std::vector<Beam>& beams) {
  constexpr std::size_t kNone = kSectors;
  std::array<std::size_t, kSectors> number_of_sector;
  number_of_sector.fill(kNone);
  for (const Beam& beam : beams) {
    std::size_t& sector = number_of_sector[sectorOf(beam.bearing)];
    if (sector == kNone) {
      sector = sizes_.size();
      sizes_.push_back(0.0);
    }
    sizes_[sector] += 1.0;
    sector_of_.push_back(static_cast<std::uint8_t>(sector));
  }
}

PairedDifference BeamSectors::difference(const std::vector<float>& a,
                                         const std::vector<float>& b) const {
  std::array<double, kSectors> sums{};
  PairedDifference result;
  if (sector_of_.empty()) return result;
  double total = 0.0;
  for (std::size_t i = 0; i < sector_of_.size(); ++i) {
    const double difference = static_cast<double>(b[i]) - static_cast<double>(a[i]);
    sums[sector_of_[i]] += difference;
    total += difference;
  }
  result.mean = total / static_cast<double>(sector_of_.size());
  const auto sectors = static_cast<double>(sizes_.size());
  if (sizes_.size() < 2) {
    result.standard_error = std::abs(result.mean);
    return result;
  }
  double mean_of_sectors = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < sizes_.size(); ++i) mean_of_sectors += sums[i] / sizes_[i] / sectors;
  for (std::size_t i = 0; i < sizes_.size(); ++i) {
    squares += std::pow(sums[i] / sizes_[i] - mean_of_sectors, 2);
  }
  result.standard_error = std::sqrt(squares / (sectors - 1.0) / sectors);
  return result;
}

}  // namespace mrpt_polyloc
