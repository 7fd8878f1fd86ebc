#include "tests/support/map_factories.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/mrpt_bridge/ParticleSeeder.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// A covariance with correlations: L L^T of a lower triangle.
mrpt::math::CMatrixDouble33 covariance(const std::array<double, 6>& l) {
  const double root[3][3] = {{l[0], 0, 0}, {l[1], l[2], 0}, {l[3], l[4], l[5]}};
  mrpt::math::CMatrixDouble33 result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      result(i, j) = 0.0;
      for (int k = 0; k < 3; ++k) result(i, j) += root[i][k] * root[j][k];
    }
  }
  return result;
}

LocalizationResult twoHypotheses() {
  LocalizationResult result;
  result.status = LocalizationStatus::ambiguous;
  result.hypotheses = {{{2, 3, 0.5}, covariance({0.3, 0.1, 0.2, 0.02, -0.01, 0.05}), 0.9, 0.1},
                       {{8, 7, -2.0}, covariance({0.1, -0.05, 0.1, 0.0, 0.03, 0.02}), 0.1, 0.1}};
  return result;
}

ParticleSeederParams paramsOf(std::size_t particles, std::size_t least, double share) {
  ParticleSeederParams params;
  params.particles = particles;
  params.least_per_hypothesis = least;
  params.uniform_share = share;
  return params;
}

double sumOfWeights(const std::vector<WeightedPose>& drawn) {
  double sum = 0.0;
  for (const WeightedPose& particle : drawn) sum += std::exp(particle.log_weight);
  return sum;
}

TEST(ParticleSeeder, SamplesHaveTheMomentsOfTheirGaussians) {
  const LocalizationResult result = twoHypotheses();
  const ParticleSeeder seeder(test::squareMap(), paramsOf(100'000, 20, 0.0));
  const auto drawn = seeder.draw(toSog(result), 3);
  ASSERT_EQ(drawn.size(), 100'000U);
  std::size_t first = 0;
  for (const Hypothesis& hypothesis : result.hypotheses) {
    const auto count = static_cast<std::size_t>(std::lround(hypothesis.weight * 1e5));
    const auto& m = hypothesis.pose_map_robot;
    std::array<double, 3> mean{};
    std::array<std::array<double, 3>, 3> moment{};
    for (std::size_t i = first; i < first + count; ++i) {
      const TPose2D& p = drawn[i].pose_map_robot;
      const std::array<double, 3> d{p.x - m.x, p.y - m.y, p.phi - m.phi};
      for (std::size_t r = 0; r < 3; ++r) {
        mean[r] += d[r] / static_cast<double>(count);
        for (std::size_t c = 0; c < 3; ++c)
          moment[r][c] += d[r] * d[c] / static_cast<double>(count);
      }
    }
    for (int r = 0; r < 3; ++r) {
      const auto row = static_cast<std::size_t>(r);
      const double n = static_cast<double>(count), vr = hypothesis.covariance(r, r);
      EXPECT_NEAR(mean[row], 0.0, 5.0 * std::sqrt(vr / n));
      for (int c = 0; c < 3; ++c) {
        const double vc = hypothesis.covariance(c, c), expected = hypothesis.covariance(r, c);
        EXPECT_NEAR(moment[row][static_cast<std::size_t>(c)], expected,
                    5.0 * std::sqrt((vr * vc + expected * expected) / n))
            << r << c;
      }
    }
    first += count;
  }
}

TEST(ParticleSeeder, KeepsWeightsAndGivesEachHypothesisItsLeast) {
  LocalizationResult result = twoHypotheses();
  result.hypotheses[0].weight = 1.0;
  result.hypotheses[1].weight = 0.0;  // underflown: must stay finite
  const ParticleSeeder seeder(test::squareMap(), paramsOf(100, 30, 0.2));
  const auto drawn = seeder.draw(toSog(result), 1);
  ASSERT_EQ(drawn.size(), 80U + 30U + 20U);
  double first = 0.0, uniform = 0.0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    ASSERT_TRUE(std::isfinite(drawn[i].log_weight)) << i;
    const double weight = std::exp(drawn[i].log_weight);
    if (i < 80) first += weight;
    if (i >= 110) uniform += weight;
  }
  EXPECT_NEAR(first, 0.8, 1e-12);
  EXPECT_NEAR(uniform, 0.2, 1e-12);
  const auto both =
      ParticleSeeder(test::squareMap(), paramsOf(300, 40, 0.05)).draw(toSog(twoHypotheses()), 1);
  EXPECT_EQ(both.size(), 257U + 40U + 15U);  // 0.9 of 285, the least, a twentieth
  EXPECT_NEAR(sumOfWeights(both), 1.0, 1e-12);
}

TEST(ParticleSeeder, WithoutHypothesesAllAreUniformInFreeSpace) {
  const PolygonMap map = test::lRoomMap();
  const auto drawn = ParticleSeeder(map, paramsOf(2000, 20, 0.0)).draw(toSog({}), 9);
  ASSERT_EQ(drawn.size(), 2000U);
  double sin_sum = 0.0;
  for (const WeightedPose& particle : drawn) {
    EXPECT_TRUE(map.contains({particle.pose_map_robot.x, particle.pose_map_robot.y}));
    sin_sum += std::sin(particle.pose_map_robot.phi);
  }
  EXPECT_NEAR(sin_sum / 2000.0, 0.0, 5.0 * std::sqrt(0.5 / 2000.0));
  EXPECT_NEAR(sumOfWeights(drawn), 1.0, 1e-12);
}

TEST(ParticleSeeder, TheSeedDecidesAndBothKindsOfParticlesAgree) {
  const ParticleSeeder seeder(test::squareMap());
  mrpt::poses::CPosePDFParticles a(7), b, other;
  mrpt::poses::CPose3DPDFParticles solid(7);
  seeder.seed(twoHypotheses(), 4, a);
  seeder.seed(twoHypotheses(), 4, b);
  seeder.seed(twoHypotheses(), 5, other);
  seeder.seed(twoHypotheses(), 4, solid);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.size(), solid.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const TPose2D& pose = a.m_particles[i].d;
    EXPECT_EQ(pose, b.m_particles[i].d);
    EXPECT_EQ(mrpt::math::TPose3D(pose), solid.m_particles[i].d);
    EXPECT_EQ(a.m_particles[i].log_w, solid.m_particles[i].log_w);
  }
  EXPECT_NE(a.m_particles[0].d, other.m_particles[0].d);
}

TEST(ParticleSeeder, TakesSingularCovariancesAndRefusesBadModes) {
  const ParticleSeeder seeder(test::squareMap(), paramsOf(50, 20, 0.0));
  LocalizationResult result = twoHypotheses();
  result.hypotheses.resize(1);
  result.hypotheses[0].covariance = mrpt::math::CMatrixDouble33();
  for (int i = 0; i < 9; ++i) result.hypotheses[0].covariance(i / 3, i % 3) = 0.0;
  for (const WeightedPose& particle : seeder.draw(toSog(result), 1)) {
    EXPECT_NEAR(particle.pose_map_robot.x, 2.0, 1e-12);
    EXPECT_NEAR(particle.pose_map_robot.phi, 0.5, 1e-12);
  }
  result.hypotheses[0].covariance(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(seeder.draw(toSog(result), 1), InvalidParamsError);
  EXPECT_THROW(ParticleSeeder(test::squareMap(), paramsOf(0, 20, 0.0)), InvalidParamsError);
  EXPECT_THROW(ParticleSeeder(test::squareMap(), paramsOf(10, 0, 0.0)), InvalidParamsError);
  EXPECT_THROW(ParticleSeeder(test::squareMap(), paramsOf(10, 2, 1.5)), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
