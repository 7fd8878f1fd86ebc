// own_filter MAP RAWLOG: a particle filter of one's own over an action/sensory-frame rawlog, with a
// polygon map for its weights. Prints "pose X Y PHI_DEG" of the robot in the map at the end.
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>
#include <mrpt_polyloc/mrpt_bridge/ParticleSeeder.h>

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/random/RandomGenerators.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <vector>

namespace {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;

// begin: weigh
/// Multiplies the weights of particles by the likelihood of a scan, and normalises them.
void weigh(const mrpt_polyloc::CPolygonMap2D& map, const CObservation2DRangeScan& scan,
           const std::vector<TPose2D>& particles, std::vector<double>& weights) {
  // All at once is faster than computeObservationLikelihood() for each. NaN, zero beams or a pose
  // off the map are no special cases: these are logarithms, finite and at most 0.
  const std::vector<double> log_likelihoods = map.computeLikelihoods(scan, particles);
  const double best = *std::max_element(log_likelihoods.begin(), log_likelihoods.end());
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] *= std::exp(log_likelihoods[i] - best);
    sum += weights[i];
  }
  for (double& weight : weights) weight /= sum;
}
// end

/// Systematic resampling; all weights are equal afterwards.
void resample(std::vector<TPose2D>& particles, std::vector<double>& weights) {
  const double step = 1.0 / static_cast<double>(particles.size());
  double at = step * mrpt::random::getRandomGenerator().drawUniform(0.0, 1.0);
  double sum = weights.front();
  std::vector<TPose2D> drawn;
  for (std::size_t i = 0; drawn.size() < particles.size(); at += step) {
    while (sum < at && i + 1 < particles.size()) sum += weights[++i];
    drawn.push_back(particles[i]);
  }
  particles = drawn;
  weights.assign(particles.size(), step);
}

void move(std::vector<TPose2D>& particles, const mrpt::obs::CActionRobotMovement2D& movement) {
  for (TPose2D& particle : particles) {
    mrpt::poses::CPose2D increment;
    movement.drawSingleSample(increment);
    particle = (mrpt::poses::CPose2D(particle) + increment).asTPose();
  }
}

TPose2D mean(const std::vector<TPose2D>& particles) {
  double x = 0, y = 0, c = 0, s = 0;
  for (const TPose2D& p : particles) x += p.x, y += p.y, c += std::cos(p.phi), s += std::sin(p.phi);
  const double n = static_cast<double>(particles.size());
  return {x / n, y / n, std::atan2(s, c)};
}

void run(const char* map_file, const char* rawlog_file) {
  mrpt::random::getRandomGenerator().randomize(1);
  mrpt::obs::CRawlog rawlog;
  if (!rawlog.loadFromRawLogFile(rawlog_file)) throw std::runtime_error("no rawlog");
  // begin: make
  const mrpt_polyloc::PolygonMap polygons = mrpt_polyloc::loadMap(map_file).map;
  mrpt_polyloc::CPolygonMap2D map(polygons);  // can go into a CMultiMetricMap, too
  map.likelihoodOptions.sigma = 0.1;
  // end
  std::vector<TPose2D> particles;
  std::vector<double> weights;
  for (std::size_t i = 0; i + 1 < rawlog.size(); i += 2) {
    const auto scan =
        rawlog.getAsObservations(i + 1)->getObservationByClass<CObservation2DRangeScan>();
    if (!scan) continue;
    if (particles.empty()) {
      // begin: start
      const mrpt_polyloc::GlobalLocalizer localizer(map.index());  // shared, not built again
      const auto result = localizer.localize(mrpt_polyloc::toRangeScan(*scan));
      const mrpt_polyloc::ParticleSeeder seeder(map.index());
      for (const auto& drawn : seeder.draw(mrpt_polyloc::toSog(result), /*seed=*/1)) {
        particles.push_back(drawn.pose_map_robot);
        weights.push_back(std::exp(drawn.log_weight));
      }
      // end
    } else {
      move(particles, *rawlog.getAsAction(i)->getBestMovementEstimation());
    }
    weigh(map, *scan, particles, weights);
    resample(particles, weights);
  }
  const TPose2D pose = mean(particles);
  std::printf("pose %.2f %.2f %.1f\n", pose.x, pose.y, pose.phi * 180.0 / M_PI);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "usage: own_filter MAP RAWLOG\n";
    return 2;
  }
  run(argv[1], argv[2]);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
