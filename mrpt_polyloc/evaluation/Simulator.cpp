#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/Simulator.h>
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/geometry/FreeSpaceSampler.h>

#include <mrpt/core/Clock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace mrpt_polyloc {
namespace {

TPoint2D drawPlace(const FreeSpaceSampler& sampler, const WallSegments& walls, double clearance,
                   Random& random) {
  constexpr int kTries = 20'000;  // a place that takes 1/2000 of the free space is found
  for (int i = 0; i < kTries; ++i) {
    const TPoint2D place = sampler.draw(random);
    if (walls.distance(place) >= clearance) return place;
  }
  throw InvalidMapError("no place found in the free space that is " + formatted("%f", clearance) +
                        " m from all walls");
}

bool isFullCircle(double fov) {
  return fov > 2.0 * kPi - 1e-9;
}

/// MRPT's aperture: the angle between the first and the last beam.
double apertureOf(const SimulatorParams& params) {
  const double beams = static_cast<double>(params.beams);
  return isFullCircle(params.fov) ? params.fov * (beams - 1.0) / beams : params.fov;
}

std::vector<double> bearingsOf(const SimulatorParams& params) {
  const double aperture = apertureOf(params);
  std::vector<double> bearings(params.beams, 0.0);
  if (params.beams == 1) return bearings;
  const double step = aperture / static_cast<double>(params.beams - 1);
  for (std::size_t i = 0; i < params.beams; ++i) {
    bearings[i] = -0.5 * aperture + step * static_cast<double>(i);
  }
  return bearings;
}

/// Puts objects in front of what the beams see.
void occlude(std::vector<double>& ranges, const SimulatorParams& params, Random& random) {
  const std::vector<double> bearings = bearingsOf(params);
  const std::vector<double> clear = ranges;
  for (std::size_t k = 0; k < params.occluders; ++k) {
    const double half_width = 0.5 * random.uniform(8.0, 19.0) * kDegree;
    const double middle = random.uniform(-0.5, 0.5) * params.fov;
    const double fraction = random.uniform(0.2, 0.9);
    const auto apart = [&](std::size_t i) {
      return std::abs(std::remainder(bearings[i] - middle, 2.0 * kPi));
    };
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < bearings.size(); ++i) {
      if (apart(i) < apart(nearest)) nearest = i;
    }
    const double object =
        std::max(fraction * std::min(clear[nearest], params.max_range), params.nearest_occluder);
    for (std::size_t i = 0; i < bearings.size(); ++i) {
      if (apart(i) <= half_width) ranges[i] = std::min(ranges[i], object);
    }
  }
}

/// What the sensor makes of true ranges.
void fillRanges(mrpt::obs::CObservation2DRangeScan& observation, const std::vector<double>& ranges,
                const SimulatorParams& params, Random& random) {
  constexpr double kLeastRange = 0.001;  // noise must not make a range 0, which means "invalid"
  observation.resizeScan(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    // Every beam draws the same number of times, so that options do not shift each other's draws.
    const double noise = params.sigma * random.normal();
    const bool is_short = random.unit() < params.short_beams;
    const double fraction = random.unit();
    const bool is_lost = random.unit() < params.dropout;
    double range = ranges[i];
    if (is_short) range = fraction * std::min(range, params.max_range);
    const bool is_hit = !is_lost && range + noise < params.max_range;
    const double read = is_hit ? std::max(range + noise, kLeastRange) : params.max_range;
    observation.setScanRange(i, static_cast<float>(read));
    observation.setScanRangeValidity(i, is_hit);
  }
}

mrpt::obs::CObservation2DRangeScan emptyObservation(const SimulatorParams& params, double stamp) {
  mrpt::obs::CObservation2DRangeScan observation;
  observation.sensorLabel = "LASER";
  observation.timestamp = mrpt::Clock::fromDouble(stamp);
  observation.aperture = static_cast<float>(apertureOf(params));
  observation.rightToLeft = true;
  observation.maxRange = static_cast<float>(params.max_range);
  observation.stdError = static_cast<float>(params.sigma);
  return observation;
}

/// What the sensor makes of what stands where, occluders put in between.
mrpt::obs::CObservation2DRangeScan observe(std::vector<double> ranges,
                                           const SimulatorParams& params, double stamp,
                                           Random& noise) {
  occlude(ranges, params, noise);
  mrpt::obs::CObservation2DRangeScan observation = emptyObservation(params, stamp);
  fillRanges(observation, ranges, params, noise);
  return observation;
}

constexpr double kFirstStamp = 1e9;

void require(bool holds, const std::string& message) {
  if (!holds) throw InvalidParamsError("SimulatorParams: " + message);
}

}  // namespace

void SimulatorParams::check() const {
  const auto is_share = [](double x) { return x >= 0.0 && x <= 1.0; };
  require(beams >= 1, "beams must be at least 1");
  require(fov > 0.0 && fov <= 2.0 * kPi + 1e-9, "fov must be in (0, 2 pi]");
  require(std::isfinite(sigma) && sigma >= 0.0, "sigma must be finite and not negative");
  require(std::isfinite(max_range) && max_range > 0.0, "max_range must be finite and positive");
  require(is_share(dropout), "dropout must be in [0, 1]");
  require(is_share(short_beams), "short_beams must be in [0, 1]");
  require(std::isfinite(clearance) && clearance >= 0.0,
          "clearance must be finite and not negative");
  require(std::isfinite(nearest_occluder) && nearest_occluder >= 0.0,
          "nearest_occluder must be finite and not negative");
  world.check();
}

mrpt::obs::CObservation2DRangeScan simulateScan(const ChangedWorld& world,
                                                const SimulatorParams& params,
                                                const mrpt::math::TPose2D& pose_map_laser,
                                                double stamp, Random& noise) {
  const mrpt::math::TPose2D eye = world.worldPose(pose_map_laser);
  return observe(world.ranges({eye.x, eye.y}, eye.phi, bearingsOf(params), params.clearance),
                 params, stamp, noise);
}

mrpt::obs::CObservation2DRangeScan simulateScan(const WallSegments& walls,
                                                const SimulatorParams& params,
                                                const mrpt::math::TPose2D& pose_map_laser,
                                                double stamp, Random& noise) {
  std::vector<double> ranges;
  for (const double bearing : bearingsOf(params)) {
    ranges.push_back(
        walls.range({pose_map_laser.x, pose_map_laser.y}, pose_map_laser.phi + bearing));
  }
  return observe(std::move(ranges), params, stamp, noise);
}

mrpt::obs::CObservation2DRangeScan simulateScan(const WallSegments& walls,
                                                const SimulatorParams& params,
                                                const mrpt::math::TPose2D& pose_map_robot,
                                                std::uint64_t seed) {
  params.check();
  Random noise(seed);
  return simulateScan(walls, params, pose_map_robot, kFirstStamp, noise);
}

std::vector<SimulatedScan> simulateScans(const PolygonMap& map, const SimulatorParams& params,
                                         std::size_t count, std::uint64_t seed) {
  params.check();
  const WallSegments walls(map);
  const ChangedWorld world(map, params.world, seed);
  const FreeSpaceSampler sampler(map);
  Random poses(seed);
  Random noise(seed ^ 0x9e3779b97f4a7c15ULL);  // a stream of its own, see the header

  std::vector<SimulatedScan> scans;
  for (std::size_t row = 0; row < count; ++row) {
    const TPoint2D place = drawPlace(sampler, walls, params.clearance, poses);
    const double heading = poses.uniform(-kPi, kPi);
    const mrpt::math::TPose2D pose(place.x, place.y, heading);
    const double stamp = kFirstStamp + static_cast<double>(row);
    scans.push_back({{stamp, pose}, simulateScan(world, params, pose, stamp, noise)});
  }
  return scans;
}

}  // namespace mrpt_polyloc
