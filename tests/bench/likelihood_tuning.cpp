// likelihood_tuning MAP RAWLOG [PARTICLES [RUNS]]: how the sharpness of CPolygonMap2D's likelihood
// serves MRPT's particle filter. With the robust metric sigma and independent_beams enter only as
// independent_beams / sigma, so that alone is varied. The filter runs over an action/sensory-frame
// rawlog, started from a search (300 particles) and uniformly (PARTICLES, adaptive as in MRPT's
// demo), RUNS times each.
//
// The reference is the search itself: the pose of every scan that it calls unique. Success: within
// 0.5 m and 10 degrees of it from some step to the end. Of the runs that succeed, once converged:
// rms error, and the median of the error's squared Mahalanobis distance by the particles'
// covariance in x and y: 1.39 where the spread is right, more where the filter is overconfident.
#include <mrpt_polyloc/geometry/FreeSpaceSampler.h>
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

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <vector>

namespace {

using namespace mrpt_polyloc;
using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;

struct Step {
  mrpt::obs::CActionCollection::Ptr action;
  mrpt::obs::CSensoryFrame::Ptr frame;
  LocalizationResult found;
};

std::vector<Step> readSteps(const char* path, const GlobalLocalizer& localizer) {
  mrpt::obs::CRawlog rawlog;
  if (!rawlog.loadFromRawLogFile(path)) throw std::runtime_error(std::string(path) + ": no rawlog");
  std::vector<Step> steps;
  for (std::size_t i = 0; i + 1 < rawlog.size(); ++i) {
    if (rawlog.getType(i) != mrpt::obs::CRawlog::TEntryType::etActionCollection) continue;
    Step step{rawlog.getAsAction(i), rawlog.getAsObservations(i + 1), {}};
    const auto scan = step.frame->getObservationByClass<CObservation2DRangeScan>();
    if (!scan) continue;
    step.found = localizer.localize(toRangeScan(*scan));
    steps.push_back(std::move(step));
  }
  return steps;
}

struct Outcome {
  bool success = false;
  std::size_t converged = 0;        ///< the first step of those that are right to the end
  std::vector<double> squares;      ///< of the errors in position, from then on [m2]
  std::vector<double> mahalanobis;  ///< squared
};

/// The filter's estimate against the reference, step by step.
class Judge {
 public:
  void add(std::size_t step, const Step& truth, const mrpt::slam::CMonteCarloLocalization2D& pdf) {
    if (truth.found.status != LocalizationStatus::unique) return;
    const TPose2D& pose = truth.found.hypotheses.front().pose_map_robot;
    const auto [covariance, mean] = pdf.getCovarianceAndMean();
    const double dx = mean.x() - pose.x, dy = mean.y() - pose.y;
    const double turn = std::remainder(mean.phi() - pose.phi, 2.0 * M_PI);
    if (std::hypot(dx, dy) > 0.5 || std::abs(turn) > M_PI / 18.0) {
      outcome_ = {};
      outcome_.converged = step + 1;
      return;
    }
    const double a = covariance(0, 0), b = covariance(0, 1), d = covariance(1, 1);
    outcome_.success = true;
    outcome_.squares.push_back(dx * dx + dy * dy);
    const double determinant = std::max(a * d - b * b, 1e-30);  // 0 if one particle is left
    outcome_.mahalanobis.push_back((d * dx * dx - 2.0 * b * dx * dy + a * dy * dy) / determinant);
  }
  const Outcome& outcome() const { return outcome_; }

 private:
  Outcome outcome_;
};

mrpt::bayes::CParticleFilter makeFilter(bool adaptive) {
  mrpt::bayes::CParticleFilter filter;
  filter.m_options.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
  filter.m_options.adaptiveSampleSize = adaptive;
  return filter;
}

Outcome runFilter(const std::vector<Step>& steps, const std::shared_ptr<const CPolygonMap2D>& map,
                  std::size_t uniform, unsigned seed) {
  mrpt::random::getRandomGenerator().randomize(seed);
  mrpt::slam::CMonteCarloLocalization2D particles;
  particles.options.metricMap = map;
  auto& kld = particles.options.KLD_params;
  kld.KLD_binSize_XY = 0.1;
  kld.KLD_binSize_PHI = M_PI / 18.0;
  kld.KLD_delta = kld.KLD_epsilon = 0.01;
  kld.KLD_minSampleSize = 150;
  kld.KLD_maxSampleSize = static_cast<unsigned>(std::max<std::size_t>(uniform, 300));
  ParticleSeederParams params;
  if (uniform > 0) params.particles = uniform;
  const ParticleSeeder seeder(*map->map(), params);
  seeder.seed(uniform > 0 ? LocalizationResult{} : steps.front().found, seed, particles);
  auto filter = makeFilter(uniform > 0);
  Judge judge;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    filter.executeOn(particles, i > 0 ? steps[i].action.get() : nullptr, steps[i].frame.get());
    judge.add(i, steps[i], particles);
  }
  return judge.outcome();
}

template <class Value>
double medianOf(std::vector<Value> values) {
  if (values.empty()) return std::nan("");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

/// One line: successes, median step of convergence, rms error, median squared Mahalanobis distance.
void report(const char* start, const std::vector<Step>& steps,
            const std::shared_ptr<const CPolygonMap2D>& map, std::size_t uniform, unsigned runs) {
  std::vector<std::size_t> converged;
  std::vector<double> squares, mahalanobis;
  for (unsigned run = 1; run <= runs; ++run) {
    const Outcome outcome = runFilter(steps, map, uniform, run);
    if (!outcome.success) continue;
    converged.push_back(outcome.converged);
    squares.insert(squares.end(), outcome.squares.begin(), outcome.squares.end());
    mahalanobis.insert(mahalanobis.end(), outcome.mahalanobis.begin(), outcome.mahalanobis.end());
  }
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  const TLikelihoodOptions& options = map->likelihoodOptions;
  std::printf("%s,%.1f,%zu,%u,%.0f,%.3f,%.1f\n", start, options.independent_beams / options.sigma,
              converged.size(), runs, medianOf(converged),
              std::sqrt(sum / static_cast<double>(squares.size())), medianOf(mahalanobis));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3 || argc > 5) {
    std::fprintf(stderr, "usage: likelihood_tuning MAP RAWLOG [PARTICLES [RUNS]]\n");
    return 2;
  }
  const std::size_t uniform = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 5000;
  const auto runs = argc > 4 ? static_cast<unsigned>(std::strtoul(argv[4], nullptr, 10)) : 20;
  const PolygonMap polygons = loadMap(argv[1]).map;
  const GlobalLocalizer localizer(polygons);
  const std::vector<Step> steps = readSteps(argv[2], localizer);
  if (steps.empty()) throw std::runtime_error(std::string(argv[2]) + ": no laser scan");
  const auto unique = std::count_if(steps.begin(), steps.end(), [](const Step& step) {
    return step.found.status == LocalizationStatus::unique;
  });
  std::printf("# %zu scans, %td of them unique\n", steps.size(), unique);
  std::printf("start,beams_per_sigma,success,runs,median_step,rms_m,mahalanobis2\n");
  const auto map = std::make_shared<CPolygonMap2D>(polygons);
  for (const double sharpness : {12.5, 25.0, 50.0, 100.0, 200.0, 400.0}) {
    map->likelihoodOptions.sigma = map->likelihoodOptions.independent_beams / sharpness;
    report("search", steps, map, 0, runs);
    if (uniform > 0) report("uniform", steps, map, uniform, runs);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
