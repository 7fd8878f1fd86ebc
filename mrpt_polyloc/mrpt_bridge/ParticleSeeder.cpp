#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/geometry/FreeSpaceSampler.h>
#include <mrpt_polyloc/localization/MapIndexParts.h>
#include <mrpt_polyloc/mrpt_bridge/ParticleSeeder.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;
using mrpt::poses::CPosePDFSOG;

const double kLeastLogWeight = std::log(1e-300);  // MRPT refuses particles of weight 0

void requireFinite(const CPosePDFSOG::TGaussianMode& mode, std::size_t index) {
  bool is_finite = mode.log_w < HUGE_VAL;  // false for NaN, too; -infinity is a weight of 0
  for (const double value : {mode.mean.x(), mode.mean.y(), mode.mean.phi()}) {
    is_finite = is_finite && std::isfinite(value);
  }
  for (int i = 0; i < 9; ++i) is_finite = is_finite && std::isfinite(mode.cov(i / 3, i % 3));
  if (!is_finite) {
    throw InvalidParamsError("mode " + std::to_string(index) +
                             ": its mean, covariance or weight is not finite");
  }
}

/// Weights that sum to 1, none of them 0.
std::vector<double> normalisedWeights(const CPosePDFSOG& modes) {
  double greatest = kLeastLogWeight;
  for (const auto& mode : modes) greatest = std::max(greatest, mode.log_w);
  std::vector<double> weights;
  double sum = 0.0;
  for (const auto& mode : modes) {
    weights.push_back(std::exp(std::max(mode.log_w - greatest, kLeastLogWeight)));
    sum += weights.back();
  }
  for (double& weight : weights) weight = std::max(weight / sum, 1e-300);
  return weights;
}

/// Draws from a Gaussian of poses.
class GaussianSampler {
 public:
  explicit GaussianSampler(const CPosePDFSOG::TGaussianMode& mode)
      : mean_(mode.mean.x(), mode.mean.y(), mode.mean.phi()) {
    Eigen::Matrix3d covariance;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) covariance(i, j) = 0.5 * (mode.cov(i, j) + mode.cov(j, i));
    }
    // Not by Cholesky: along a corridor or at a perfect fit a covariance may be singular.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    root_ = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  }

  TPose2D draw(Random& random) const {
    Eigen::Vector3d normal;
    for (int i = 0; i < 3; ++i) normal[i] = random.normal();
    const Eigen::Vector3d pose = mean_ + root_ * normal;
    return {pose[0], pose[1], std::remainder(pose[2], kTwoPi)};
  }

 private:
  Eigen::Vector3d mean_;
  Eigen::Matrix3d root_;
};

template <class Particles, class SetPose>
void replace(Particles& particles, const std::vector<WeightedPose>& drawn, SetPose set_pose) {
  particles.clearParticles();
  particles.m_particles.resize(drawn.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    set_pose(particles.m_particles[i].d, drawn[i].pose_map_robot);
    particles.m_particles[i].log_w = drawn[i].log_weight;
  }
}

/// Shared with the index, and keeps it alive.
std::shared_ptr<const Triangulation> triangulationOf(const MapIndex::Ptr& index) {
  if (!index) throw InvalidParamsError("index: there is none");
  return {index, &index->parts().triangulation()};
}

}  // namespace

void ParticleSeederParams::check() const {
  requireInRange("particles", static_cast<double>(particles), 1.0, 1e8);
  requireInRange("least_per_hypothesis", static_cast<double>(least_per_hypothesis), 1.0, 1e6);
  requireInRange("uniform_share", uniform_share, 0.0, 1.0);
}

CPosePDFSOG toSog(const LocalizationResult& result) {
  CPosePDFSOG modes(0);  // the default is one mode at the origin
  for (const Hypothesis& hypothesis : result.hypotheses) {
    CPosePDFSOG::TGaussianMode mode;
    mode.mean = mrpt::poses::CPose2D(hypothesis.pose_map_robot);
    mode.cov = hypothesis.covariance;
    mode.log_w = std::log(hypothesis.weight);
    modes.push_back(mode);
  }
  return modes;
}

ParticleSeeder::ParticleSeeder(const MapIndex::Ptr& index, const ParticleSeederParams& params)
    : free_space_(std::make_shared<FreeSpaceSampler>(triangulationOf(index))), params_(params) {
  params_.check();
}

ParticleSeeder::ParticleSeeder(const PolygonMap& map, const ParticleSeederParams& params)
    : free_space_(std::make_shared<FreeSpaceSampler>(map)), params_(params) {
  params_.check();
}

std::vector<WeightedPose> ParticleSeeder::draw(const CPosePDFSOG& modes, std::uint64_t seed) const {
  for (std::size_t i = 0; i < modes.size(); ++i) requireFinite(modes.get(i), i);
  Random random(seed);
  std::vector<WeightedPose> drawn;
  const double all = static_cast<double>(params_.particles);

  double share = modes.empty() ? 1.0 : params_.uniform_share;
  const auto uniform = static_cast<std::size_t>(std::ceil(share * all - 1e-9));
  const auto guided = static_cast<double>(params_.particles - uniform);
  if (uniform == 0) share = 0.0;
  const std::vector<double> weights =
      share < 1.0 ? normalisedWeights(modes) : std::vector<double>();
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const auto count = std::max(params_.least_per_hypothesis,
                                static_cast<std::size_t>(std::lround(weights[i] * guided)));
    const double log_weight =
        std::log1p(-share) + std::log(weights[i] / static_cast<double>(count));
    const GaussianSampler sampler(modes.get(i));
    for (std::size_t k = 0; k < count; ++k) drawn.push_back({sampler.draw(random), log_weight});
  }
  const double log_weight = std::log(share / static_cast<double>(uniform));
  for (std::size_t k = 0; k < uniform; ++k) {
    const TPoint2D place = free_space_->draw(random);
    drawn.push_back({{place.x, place.y, random.uniform(-kPi, kPi)}, log_weight});
  }
  return drawn;
}

void ParticleSeeder::seed(const LocalizationResult& result, std::uint64_t seed,
                          mrpt::poses::CPosePDFParticles& particles) const {
  replace(particles, draw(toSog(result), seed),
          [](auto& particle, const TPose2D& pose) { particle = pose; });
}

void ParticleSeeder::seed(const LocalizationResult& result, std::uint64_t seed,
                          mrpt::poses::CPose3DPDFParticles& particles) const {
  replace(particles, draw(toSog(result), seed),
          [](auto& particle, const TPose2D& pose) { particle = mrpt::math::TPose3D(pose); });
}

}  // namespace mrpt_polyloc
