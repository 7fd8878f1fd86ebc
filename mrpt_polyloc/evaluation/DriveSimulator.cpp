#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/evaluation/DriveSimulator.h>
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/evaluation/simulated_odometry.h>

#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>

#include <cmath>
#include <optional>
#include <set>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// Whether a robot can go straight from one place to another.
bool isClear(const PolygonMap& map, const WallSegments& walls, const TPose2D& from,
             const TPose2D& to, double clearance) {
  constexpr double kLook = 0.05;  // [m]
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const auto looks = static_cast<int>(std::ceil(length / kLook));
  for (int i = 1; i <= looks; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(looks);
    const TPoint2D place(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y));
    if (!map.contains(place) || walls.distance(place) < clearance) return false;
  }
  return true;
}

/// The next pose: ahead, turned as little as there must be.
std::optional<TPose2D> nextPose(const PolygonMap& map, const WallSegments& walls,
                                const TPose2D& pose, double step, double clearance,
                                Random& random) {
  constexpr double kWander = 8.0 * kDegree, kTurn = 15.0 * kDegree;
  constexpr int kTurns = 12;  // half a circle either way
  const double wander = kWander * random.normal();
  const double side = random.unit() < 0.5 ? 1.0 : -1.0;
  for (int i = 0; i <= 2 * kTurns; ++i) {
    const int turns = (i + 1) / 2;
    const double turn = wander + (i % 2 == 0 ? side : -side) * kTurn * turns;
    const TPose2D turned(pose.x, pose.y, pose.phi + turn);
    const TPose2D next = turned + TPose2D(step, 0, 0);
    if (isClear(map, walls, pose, next, clearance)) return next;
  }
  return std::nullopt;
}

std::vector<StampedPose> drivenPoses(const PolygonMap& map, const DriveSimulatorParams& params,
                                     std::size_t count, std::uint64_t seed) {
  SimulatorParams blind = params.laser;
  blind.beams = 1;
  std::vector<StampedPose> poses;
  if (params.step <= 0.0) {
    for (const SimulatedScan& scan : simulateScans(map, blind, count, seed)) {
      poses.push_back(scan.truth);
    }
    return poses;
  }
  poses.push_back(simulateScans(map, blind, 1, seed).front().truth);
  const WallSegments walls(map);
  Random random(seed ^ 0xd1b54a32d192ed03ULL);  // a stream of its own
  while (poses.size() < count) {
    const auto next = nextPose(map, walls, poses.back().pose_map_robot, params.step,
                               params.laser.clearance, random);
    if (!next) {
      throw InvalidMapError("the robot cannot move " + std::to_string(params.step) +
                            " m in any direction from (" +
                            std::to_string(poses.back().pose_map_robot.x) + ", " +
                            std::to_string(poses.back().pose_map_robot.y) + ")");
    }
    TPose2D pose = *next;
    pose.normalizePhi();
    poses.push_back({poses.back().stamp + 1.0, pose});
  }
  return poses;
}

}  // namespace

void DriveSimulatorParams::check() const {
  laser.check();
  odometry.check();
  requireInRange("step", step, 0.0, 1e3);
  if (lasers.empty()) throw InvalidParamsError("lasers: there is none");
  std::set<std::string> labels;
  for (const LaserMount& mount : lasers) {
    const TPose2D& pose = mount.pose_robot_laser;
    if (!std::isfinite(pose.x) || !std::isfinite(pose.y) || !std::isfinite(pose.phi)) {
      throw InvalidParamsError("lasers: '" + mount.label + "' is not at a finite place");
    }
    if (!labels.insert(mount.label).second) {
      throw InvalidParamsError("lasers: there are two of the label '" + mount.label + "'");
    }
  }
}

std::vector<SimulatedMoment> simulateMoments(const PolygonMap& map,
                                             const DriveSimulatorParams& params, std::size_t count,
                                             std::uint64_t seed) {
  params.check();
  const std::vector<StampedPose> poses = drivenPoses(map, params, count, seed);
  std::vector<TPose2D> truth;
  for (const StampedPose& pose : poses) truth.push_back(pose.pose_map_robot);
  const std::vector<Motion> wheels = simulatedOdometry(truth, params.odometry, seed);
  const ChangedWorld world(map, params.laser.world, seed);
  Random noise(seed ^ 0x9e3779b97f4a7c15ULL);
  std::vector<SimulatedMoment> moments;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    SimulatedMoment moment{poses[i], {0, 0, 0}, {}};
    if (params.step > 0.0) moment.measured = wheels[i].pose_before_after;
    for (const LaserMount& mount : params.lasers) {
      moment.observations.push_back(simulateScan(
          world, params.laser, truth[i] + mount.pose_robot_laser, poses[i].stamp, noise));
      moment.observations.back().sensorLabel = mount.label;
      moment.observations.back().sensorPose =
          mrpt::poses::CPose3D(mrpt::poses::CPose2D(mount.pose_robot_laser));
    }
    moments.push_back(std::move(moment));
  }
  return moments;
}

}  // namespace mrpt_polyloc
