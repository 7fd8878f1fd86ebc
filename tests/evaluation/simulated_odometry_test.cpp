#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/evaluation/simulated_odometry.h>

#include <gtest/gtest.h>

#include <cmath>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

std::vector<TPose2D> way(std::size_t count) {
  Random random(4);
  std::vector<TPose2D> poses{{1, 2, 0.5}};
  while (poses.size() < count) {
    poses.push_back(poses.back() + TPose2D(random.uniform(0.2, 0.8), 0.1, random.uniform(-1, 1)));
  }
  return poses;
}

TEST(SimulatedOdometry, ErrorsAreThoseThatItStates) {
  const std::vector<TPose2D> poses = way(4000);
  const std::vector<Motion> motions = simulatedOdometry(poses, {0.05, 0.02, 0.1}, 3);
  ASSERT_EQ(motions.size(), poses.size());
  EXPECT_EQ(motions.front().length(), 0.0);
  double x = 0.0, y = 0.0, phi = 0.0, mean = 0.0;
  const double count = static_cast<double>(poses.size() - 1);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const TPose2D exact = poses[i] - poses[i - 1];
    const Motion stated = measuredMotion(exact, {0.05, 0.02, 0.1});
    const TPose2D& seen = motions[i].pose_before_after;
    x += std::pow(seen.x - exact.x, 2) / stated.covariance(0, 0) / count;
    y += std::pow(seen.y - exact.y, 2) / stated.covariance(1, 1) / count;
    const double turn = std::remainder(seen.phi - exact.phi, 2 * M_PI);
    phi += turn * turn / stated.covariance(2, 2) / count;
    mean += turn / count;
  }
  // A mean of 4000 squares of normal deviates has a standard deviation of 0.022.
  EXPECT_NEAR(x, 1.0, 0.1);
  EXPECT_NEAR(y, 1.0, 0.1);
  EXPECT_NEAR(phi, 1.0, 0.1);
  EXPECT_NEAR(mean, 0.0, 0.01);
}

TEST(SimulatedOdometry, IsOfItsSeedAndWithoutNoiseExact) {
  const std::vector<TPose2D> poses = way(20);
  const auto a = simulatedOdometry(poses, {}, 1), b = simulatedOdometry(poses, {}, 1);
  const auto c = simulatedOdometry(poses, {}, 2), exact = simulatedOdometry(poses, {0, 0, 0}, 1);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_EQ(a[i].pose_before_after, b[i].pose_before_after);
    EXPECT_NE(a[i].pose_before_after, c[i].pose_before_after);
    const TPose2D way_there = poses[i] - poses[i - 1];
    EXPECT_NEAR(exact[i].pose_before_after.x, way_there.x, 1e-12);
  }
}

}  // namespace
}  // namespace mrpt_polyloc
