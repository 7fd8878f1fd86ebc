#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/MapIndex.h>

#include <mrpt/poses/CPose3DPDFParticles.h>
#include <mrpt/poses/CPosePDFParticles.h>
#include <mrpt/poses/CPosePDFSOG.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace mrpt_polyloc {

class FreeSpaceSampler;

struct POLYLOC_EXPORT ParticleSeederParams {
  std::size_t particles = 300;  ///< in all; more where the hypotheses need more, see below
  /// At least so many for each hypothesis, however small its weight: a few would miss the robot's
  /// heading, and the hypothesis be lost by chance.
  std::size_t least_per_hypothesis = 20;
  /// Share of the particles, and of belief, spread over the whole free space: for the case that no
  /// hypothesis is right.
  double uniform_share = 0.05;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// A pose of the robot in the map, with the logarithm of its share of belief.
struct POLYLOC_EXPORT WeightedPose {
  mrpt::math::TPose2D pose_map_robot;
  double log_weight = 0.0;
};

/// The hypotheses as MRPT's sum of Gaussians, weights and covariances kept; no mode if there is no
/// hypothesis.
POLYLOC_EXPORT mrpt::poses::CPosePDFSOG toSog(const LocalizationResult& result);

/// Starts the particles of MRPT's filters where the search says: each hypothesis gets particles in
/// proportion to its weight, at least `least_per_hypothesis`, drawn from its Gaussian; together
/// they carry its weight. The rest is uniform over the free space. Without hypotheses all are.
///
/// MRPT 2.5.8 cannot do this itself: CPosePDFParticles::copyFrom() does nothing for a sum of
/// Gaussians, and CPosePDFSOG::drawManySamples() throws. Const and thread-safe.
class POLYLOC_EXPORT ParticleSeeder {
 public:
  /// \throws InvalidParamsError, also if the index is null; InvalidMapError without free space
  explicit ParticleSeeder(const MapIndex::Ptr& index, const ParticleSeederParams& params = {});
  /// With a triangulation of its own; keeps no reference to the map.
  explicit ParticleSeeder(const PolygonMap& map, const ParticleSeederParams& params = {});

  /// Particles whose weights sum to 1, all of them finite logarithms; the same for the same seed.
  /// A covariance may be singular; its negative eigenvalues, if any, count as 0.
  /// \throws InvalidParamsError naming the mode if its mean, covariance or weight is not finite (a
  /// weight of 0, log -infinity, is floored at 1e-300)
  std::vector<WeightedPose> draw(const mrpt::poses::CPosePDFSOG& modes, std::uint64_t seed) const;

  /// Replaces the particles of a filter: of mrpt::slam::CMonteCarloLocalization2D, which is a
  /// CPosePDFParticles, or of CMonteCarloLocalization3D, there with z, pitch and roll 0.
  void seed(const LocalizationResult& result, std::uint64_t seed,
            mrpt::poses::CPosePDFParticles& particles) const;
  void seed(const LocalizationResult& result, std::uint64_t seed,
            mrpt::poses::CPose3DPDFParticles& particles) const;

 private:
  std::shared_ptr<const FreeSpaceSampler> free_space_;
  ParticleSeederParams params_;
};

}  // namespace mrpt_polyloc
