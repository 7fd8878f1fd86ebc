#include "FilterRun.h"

#include "step_motion.h"
#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/mrpt_archive.h>

#include <mrpt/poses/CPose2D.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <algorithm>
#include <exception>
#include <string>
#include <thread>
#include <time.h>

namespace mrpt_polyloc::replay {
namespace {

using mrpt::bayes::CParticleFilter;
using mrpt::slam::CMonteCarloLocalization2D;

/// Wall time of a job [ms].
template <class Job>
double timed(const Job& job) {
  const Stopwatch watch;
  job();
  return 1e3 * watch.seconds();
}

/// Runs a job of MRPT's filter and adds what it took.
template <class Job>
void timeFilter(StepRecord& record, const Job& job) {
  const double before = threadCpuMs();
  record.filter_ms += timed(job);
  record.filter_cpu_ms += threadCpuMs() - before;
}

/// A filter with its particles, and what keeps it from staying lost.
class Driver {
 public:
  Driver(const ReplaySetup& setup, std::uint32_t seed)
      : setup_(&setup),
        seeder_(setup.maps.polygons.index(), setup.config.seeds),
        recovery_(setup.localizer, seeder_, setup.maps.polygons, setup.config.recovery),
        seed_(seed) {
    particles_.options.KLD_params = setup.config.kld;
    particles_.options.metricMap = setup.maps.metric;
    filter_.m_options = setup.config.filter;
    // MRPT's other algorithms do nothing without an action.
    weigher_.m_options = setup.config.filter;
    weigher_.m_options.PF_algorithm = CParticleFilter::pfStandardProposal;
  }

  StepRecord start(const ReplayStep& first) {
    StepRecord record;
    if (setup_->config.init == Init::polyloc) {
      record.search_ms = timed([&] {
        const LocalizationResult found = recovery_.start(*first.laser, nextSeed(), particles_);
        record.search = found.status;
        record.hypotheses = found.hypotheses.size();
      });
    } else {
      ParticleSeederParams everywhere = setup_->config.seeds;
      everywhere.particles = setup_->config.uniform_particles;
      ParticleSeeder(setup_->maps.polygons.index(), everywhere).seed({}, nextSeed(), particles_);
    }
    record.particles = particles_.size();
    timeFilter(record, [&] { weigh(first); });
    judge(first, record);
    return record;
  }

  StepRecord step(const ReplayStep& next) {
    StepRecord record;
    timeFilter(record, [&] {
      filter_.executeOn(particles_, next.action.get(), next.frame.get(), nullptr);
    });
    record.particles = particles_.size();
    recovery_.move(motionOf(next));
    judge(next, record);
    return record;
  }

  void describe(StepRecord& record, bool with_cloud) const {
    const auto [covariance, mean] = particles_.getCovarianceAndMean();
    record.covariance = covariance;
    record.estimate = mean.asTPose();
    if (!with_cloud) return;
    for (const auto& particle : particles_.m_particles) record.cloud.push_back(particle.d);
  }

 private:
  /// Each draw of the seeder has numbers of its own; those of MRPT's filter are another generator.
  std::uint64_t nextSeed() { return (static_cast<std::uint64_t>(seed_) << 32U) + draws_++; }

  void weigh(const ReplayStep& at) {
    weigher_.executeOn(particles_, nullptr, at.frame.get(), nullptr);
  }

  void judge(const ReplayStep& at, StepRecord& record) {
    if (!setup_->config.recovers) return;
    FilterRecovery::Verdict verdict;
    record.monitor_ms =
        timed([&] { verdict = recovery_.update(*at.laser, nextSeed(), particles_); });
    record.fit = verdict.fit;
    record.best_fit = verdict.best_fit;
    record.mixed_in = verdict.mixed_in;
    record.health = verdict.health;
    if (verdict.search) {
      record.search = verdict.search->status;
      record.hypotheses = verdict.search->hypotheses.size();
      const double took =
          verdict.search->statistics.search_ms + verdict.search->statistics.refinement_ms;
      record.search_ms += took;
      record.monitor_ms = std::max(0.0, record.monitor_ms - took);
    }
    if (verdict.mixed_in) timeFilter(record, [&] { weigh(at); });
  }

  const ReplaySetup* setup_;
  ParticleSeeder seeder_;
  FilterRecovery recovery_;
  CMonteCarloLocalization2D particles_;
  CParticleFilter filter_, weigher_;
  std::uint32_t seed_;
  std::uint64_t draws_ = 0;
};

RunRecord runHere(const ReplaySetup& setup, const std::vector<std::size_t>& replayed,
                  std::uint32_t seed, const std::vector<std::size_t>& reported) {
  mrpt::random::getRandomGenerator().randomize(seed);
  RunRecord run;
  run.seed = seed;
  Driver driver(setup, seed);
  for (std::size_t k = 0; k < replayed.size(); ++k) {
    const ReplayStep& at = setup.steps[replayed[k]];
    try {
      StepRecord record = k == 0 ? driver.start(at) : driver.step(at);
      record.step = replayed[k];
      record.stamp = at.scan.stamp();
      driver.describe(record,
                      std::find(reported.begin(), reported.end(), record.step) != reported.end());
      run.steps.push_back(std::move(record));
    } catch (const std::exception& error) {
      throw FormatError(setup.config.rawlog_file, "object " + std::to_string(at.object),
                        "MRPT's filter stopped: " + plainMessage(error));
    }
  }
  return run;
}

}  // namespace

std::vector<std::size_t> replayedSteps(const ReplayConfig& config, std::size_t count) {
  std::vector<std::size_t> replayed;
  for (std::size_t i = config.rawlog_offset; i < count; ++i) {
    const auto cuts_it = [i](const StepRange& range) {
      return range.first <= i && i <= range.last;
    };
    if (std::none_of(config.carried.begin(), config.carried.end(), cuts_it)) replayed.push_back(i);
  }
  if (replayed.empty()) {
    throw FormatError(config.path, "",
                      "no step is left to replay of the " + std::to_string(count) +
                          " of the rawlog: see rawlog_offset and carried");
  }
  return replayed;
}

std::vector<std::size_t> stepsAfterGaps(const std::vector<std::size_t>& replayed) {
  std::vector<std::size_t> after;
  for (std::size_t k = 1; k < replayed.size(); ++k) {
    if (replayed[k] != replayed[k - 1] + 1) after.push_back(replayed[k]);
  }
  return after;
}

RunRecord runFilter(const ReplaySetup& setup, const std::vector<std::size_t>& replayed,
                    std::uint32_t seed, const std::vector<std::size_t>& reported) {
  // MRPT's generator keeps state that randomize() does not reset (std::normal_distribution's spare
  // number), and is one of each thread.
  RunRecord run;
  std::exception_ptr failure;
  std::thread thread([&] {
    try {
      run = runHere(setup, replayed, seed, reported);
    } catch (...) {
      failure = std::current_exception();
    }
  });
  thread.join();
  if (failure) std::rethrow_exception(failure);
  return run;
}

}  // namespace mrpt_polyloc::replay
