#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/evaluation/simulated_odometry.h>

#include <cmath>

namespace mrpt_polyloc {

std::vector<Motion> simulatedOdometry(const std::vector<mrpt::math::TPose2D>& poses_map_robot,
                                      const MotionNoise& noise, std::uint64_t seed) {
  noise.check();
  Random random(seed);
  std::vector<Motion> motions(poses_map_robot.size());
  for (std::size_t i = 1; i < poses_map_robot.size(); ++i) {
    const Motion exact = measuredMotion(poses_map_robot[i] - poses_map_robot[i - 1], noise);
    mrpt::math::TPose2D measured = exact.pose_before_after;
    measured.x += std::sqrt(exact.covariance(0, 0)) * random.normal();
    measured.y += std::sqrt(exact.covariance(1, 1)) * random.normal();
    measured.phi += std::sqrt(exact.covariance(2, 2)) * random.normal();
    motions[i] = measuredMotion(measured, noise);
  }
  return motions;
}

}  // namespace mrpt_polyloc
