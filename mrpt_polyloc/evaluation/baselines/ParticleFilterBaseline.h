#pragma once

#include <mrpt_polyloc/evaluation/baselines/BaselineAnswer.h>
#include <mrpt_polyloc/geometry/OccupancyBitmap.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace mrpt_polyloc {

struct ParticleFilterBaselineParams {
  std::size_t particles = 40'000;             ///< at first, and at most: as in MRPT's own demo
  double sigma = 0.2;                         ///< LF_stdHit of the field [m], as in MRPT's own demo
  int decimation = 10;                        ///< LF_decimation: every so many hits is weighed
  double min_std_xy = 0.04;                   ///< of a movement [m], as pf-localization's default
  double min_std_phi = 0.034906585039886592;  ///< [rad] 2 degrees, as pf-localization's default

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// A baseline: MRPT's particle filter (mrpt::slam::CMonteCarloLocalization2D, standard proposal,
/// sample size adapted by KLD) that starts with particles everywhere in the free cells of an
/// occupancy grid, and is moved and weighed along a drive: what pf-localization does.
///
/// It needs a drive where others have one scan. Const calls are thread-safe; each runs in a thread
/// of its own, for MRPT's random numbers are the thread's.
class ParticleFilterBaseline {
 public:
  /// \throws InvalidParamsError; InvalidMapError if there is no free or no occupied cell
  explicit ParticleFilterBaseline(const OccupancyBitmap& bitmap,
                                  const ParticleFilterBaselineParams& params = {});
  ~ParticleFilterBaseline();
  ParticleFilterBaseline(const ParticleFilterBaseline&) = delete;
  ParticleFilterBaseline& operator=(const ParticleFilterBaseline&) = delete;

  /// Where the particles gather after the drive: means of heaps, the heaviest first. Scores: the
  /// share of the weight within half a metre and 15 degrees. None for a drive without hits. The
  /// same seed gives the same answers.
  std::vector<BaselineAnswer> localize(const ScanSet& drive, std::uint32_t seed) const;

  std::size_t bytes() const;  ///< of one grid with its cache

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace mrpt_polyloc
