// seed_filter MAP RAWLOG: MRPT's particle filter over an action/sensory-frame rawlog, started from
// the hypotheses of a search. Prints "pose X Y PHI_DEG" of the robot in the map at the end.
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>
#include <mrpt_polyloc/mrpt_bridge/ParticleSeeder.h>

#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <cstdio>
#include <iostream>
#include <memory>

namespace {

using mrpt::obs::CObservation2DRangeScan;

mrpt::bayes::CParticleFilter makeFilter() {
  mrpt::bayes::CParticleFilter filter;
  filter.m_options.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
  filter.m_options.adaptiveSampleSize = false;
  return filter;
}

void run(const char* map_file, const char* rawlog_file) {
  mrpt::random::getRandomGenerator().randomize(1);
  mrpt::obs::CRawlog rawlog;
  if (!rawlog.loadFromRawLogFile(rawlog_file)) throw std::runtime_error("no rawlog");
  mrpt::bayes::CParticleFilter filter = makeFilter();
  // begin: seed
  const auto index = mrpt_polyloc::MapIndex::build(mrpt_polyloc::loadMap(map_file).map);
  const mrpt_polyloc::GlobalLocalizer localizer(index);
  const mrpt_polyloc::ParticleSeeder seeder(index);  // 300 particles, 5 % of them anywhere

  mrpt::slam::CMonteCarloLocalization2D particles;
  particles.options.metricMap = std::make_shared<mrpt_polyloc::CPolygonMap2D>(index);  // or yours
  const auto first = rawlog.getAsObservations(1);
  const auto scan = first->getObservationByClass<CObservation2DRangeScan>();
  seeder.seed(localizer.localize(mrpt_polyloc::toRangeScan(*scan)), /*seed=*/1, particles);
  filter.executeOn(particles, nullptr,
                   first.get());  // weighs the seeds with the scan they are from
  for (std::size_t i = 2; i + 1 < rawlog.size(); i += 2) {
    filter.executeOn(particles, rawlog.getAsAction(i).get(), rawlog.getAsObservations(i + 1).get());
  }
  // end
  mrpt::poses::CPose2D pose;
  particles.getMean(pose);
  std::printf("pose %.2f %.2f %.1f\n", pose.x(), pose.y(), pose.phi() * 180.0 / M_PI);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "usage: seed_filter MAP RAWLOG\n";
    return 2;
  }
  run(argv[1], argv[2]);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
