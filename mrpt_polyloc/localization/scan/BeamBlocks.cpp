#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/scan/BeamBlocks.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mrpt_polyloc {
namespace {

std::size_t sectorOf(double bearing) {
  const double turns = std::remainder(bearing, kTwoPi) / kTwoPi + 0.5;
  // Bearings at a whole number of degrees must not be torn apart by rounding.
  constexpr double kSlack = 1e-6;
  const double sector = std::floor(turns * static_cast<double>(BeamBlocks::kSectors) + kSlack);
  return static_cast<std::size_t>(sector) % BeamBlocks::kSectors;
}

}  // namespace

BeamBlocks::BeamBlocks(const std::vector<Beam>& beams) {
  constexpr std::size_t kNone = kSectors;
  std::array<std::size_t, kSectors> block_of_sector;
  block_of_sector.fill(kNone);
  for (const Beam& beam : beams) {
    std::size_t& block = block_of_sector[sectorOf(beam.bearing)];
    if (block == kNone) {
      block = sizes_.size();
      sizes_.push_back(0.0);
    }
    sizes_[block] += 1.0;
    block_of_.push_back(static_cast<std::uint8_t>(block));
  }
}

PairedDifference BeamBlocks::difference(const std::vector<float>& a,
                                        const std::vector<float>& b) const {
  std::array<double, kSectors> sums{};
  PairedDifference result;
  if (block_of_.empty()) return result;
  double total = 0.0;
  for (std::size_t i = 0; i < block_of_.size(); ++i) {
    const double difference = static_cast<double>(b[i]) - static_cast<double>(a[i]);
    sums[block_of_[i]] += difference;
    total += difference;
  }
  result.mean = total / static_cast<double>(block_of_.size());
  const auto blocks = static_cast<double>(sizes_.size());
  if (sizes_.size() < 2) {
    result.standard_error = std::abs(result.mean);
    return result;
  }
  double mean_of_blocks = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < sizes_.size(); ++i) mean_of_blocks += sums[i] / sizes_[i] / blocks;
  for (std::size_t i = 0; i < sizes_.size(); ++i) {
    squares += std::pow(sums[i] / sizes_[i] - mean_of_blocks, 2);
  }
  result.standard_error = std::sqrt(squares / (blocks - 1.0) / blocks);
  return result;
}

}  // namespace mrpt_polyloc
