#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/scan/Motion.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace mrpt_polyloc {
namespace {

using mrpt::math::CMatrixDouble33;
using mrpt::math::TPose2D;

Motion randomMotion(Random& random) {
  Motion motion = measuredMotion(
      {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)}, {0.02, 0.01, 0.02});
  motion.covariance(0, 1) = motion.covariance(1, 0) = 0.3 * motion.covariance(0, 0);
  motion.covariance(0, 2) = motion.covariance(2, 0) =
      0.2 * std::sqrt(motion.covariance(0, 0) * motion.covariance(2, 2));
  return motion;
}

/// Normal errors of a covariance, by Cholesky written out.
TPose2D drawn(const Motion& motion, Random& random) {
  const CMatrixDouble33& c = motion.covariance;
  std::array<std::array<double, 3>, 3> root{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = c(i, j);
      for (int k = 0; k < j; ++k) {
        sum -= root[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] *
               root[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)];
      }
      root[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          i == j ? std::sqrt(std::max(sum, 0.0))
                 : sum / root[static_cast<std::size_t>(j)][static_cast<std::size_t>(j)];
    }
  }
  const std::array<double, 3> n{random.normal(), random.normal(), random.normal()};
  TPose2D pose = motion.pose_before_after;
  pose.x += root[0][0] * n[0];
  pose.y += root[1][0] * n[0] + root[1][1] * n[1];
  pose.phi += root[2][0] * n[0] + root[2][1] * n[1] + root[2][2] * n[2];
  return pose;
}

/// The covariance that draws scatter by, around a pose.
CMatrixDouble33 scatter(const std::vector<TPose2D>& draws, const TPose2D& mean) {
  CMatrixDouble33 sum = CMatrixDouble33::Zero();
  for (const TPose2D& pose : draws) {
    const std::array<double, 3> off{pose.x - mean.x, pose.y - mean.y,
                                    std::remainder(pose.phi - mean.phi, 2 * M_PI)};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        sum(i, j) += off[static_cast<std::size_t>(i)] * off[static_cast<std::size_t>(j)] /
                     static_cast<double>(draws.size());
      }
    }
  }
  return sum;
}

void expectNear(const CMatrixDouble33& stated, const CMatrixDouble33& seen) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double scale = std::sqrt(stated(i, i) * stated(j, j));
      EXPECT_NEAR(stated(i, j), seen(i, j), 0.06 * scale) << i << " " << j;
    }
  }
}

TEST(Motion, CovariancesAreThoseOfDraws) {
  Random random(5);
  for (int round = 0; round < 6; ++round) {
    const Motion a = randomMotion(random), b = randomMotion(random);
    std::vector<TPose2D> sums, backs;
    for (int i = 0; i < 20'000; ++i) {
      const TPose2D first = drawn(a, random), second = drawn(b, random);
      sums.push_back(first + second);
      backs.push_back(TPose2D(0, 0, 0) - first);
    }
    const Motion both = a + b, back = inverse(a);
    expectNear(both.covariance, scatter(sums, both.pose_before_after));
    expectNear(back.covariance, scatter(backs, back.pose_before_after));
    CMatrixDouble33 covariance = a.covariance;
    const TPose2D moved = move(a.pose_before_after, b, covariance);
    EXPECT_NEAR(moved.x, both.pose_before_after.x, 1e-12);
    expectNear(covariance, both.covariance);
  }
}

TEST(Motion, ThereAndBackIsNowhere) {
  Random random(6);
  for (int round = 0; round < 100; ++round) {
    const Motion a = randomMotion(random);
    const TPose2D none = (a + inverse(a)).pose_before_after;
    EXPECT_NEAR(none.x, 0.0, 1e-12);
    EXPECT_NEAR(none.y, 0.0, 1e-12);
    EXPECT_NEAR(std::remainder(none.phi, 2 * M_PI), 0.0, 1e-12);
    const Motion twice = inverse(inverse(a));
    expectNear(twice.covariance, a.covariance);
  }
}

TEST(Motion, NoiseGrowsWithWayAndTurn) {
  const MotionNoise noise{0.1, 0.02, 0.3};
  const Motion motion = measuredMotion({3, 4, -0.5}, noise);
  EXPECT_DOUBLE_EQ(motion.covariance(0, 0), 0.25);
  EXPECT_DOUBLE_EQ(motion.covariance(1, 1), 0.25);
  EXPECT_DOUBLE_EQ(motion.covariance(2, 2), 0.01 + 0.0225);
  EXPECT_EQ(measuredMotion({0, 0, 0}, noise).covariance(2, 2), 0.0);
}

TEST(Motion, RefusesWhatIsNotFinite) {
  const double inf = std::numeric_limits<double>::infinity();
  Motion motion;
  motion.pose_before_after.y = inf;
  EXPECT_THROW(motion.check(), InvalidParamsError);
  motion = Motion();
  motion.covariance(1, 1) = -1.0;
  EXPECT_THROW(motion.check(), InvalidParamsError);
  EXPECT_THROW(MotionNoise({-0.1, 0, 0}).check(), InvalidParamsError);
  EXPECT_NO_THROW(Motion().check());
}

}  // namespace
}  // namespace mrpt_polyloc
