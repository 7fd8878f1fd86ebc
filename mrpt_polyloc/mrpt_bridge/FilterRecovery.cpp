#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/mrpt_bridge/FilterRecovery.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPosePDFParticles;

/// Systematic resampling without chance: the particles at (k + 1/2) / count of the total weight.
std::vector<mrpt::math::TPose2D> evenlyByWeight(const CPosePDFParticles& particles,
                                                std::size_t count) {
  const auto& all = particles.m_particles;
  std::vector<mrpt::math::TPose2D> taken;
  if (all.empty()) return taken;
  double greatest = all.front().log_w;
  for (const auto& particle : all) greatest = std::max(greatest, particle.log_w);
  std::vector<double> until(all.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    sum += std::exp(all[i].log_w - greatest);
    until[i] = sum;
  }
  for (std::size_t k = 0, i = 0; k < count; ++k) {
    const double target = sum * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    while (i + 1 < all.size() && until[i] < target) ++i;
    taken.push_back(all[i].d);
  }
  return taken;
}

bool isInDoubt(FilterHealth health) {
  return health == FilterHealth::doubtful || health == FilterHealth::lost;
}

/// Per beam, on a scale of its own, so that the monitor's thresholds hold whatever the filter uses.
TLikelihoodOptions fitOptions() {
  TLikelihoodOptions options;
  options.independent_beams = 1.0;
  return options;
}

}  // namespace

void FilterRecoveryParams::check() const {
  requireInRange("max_hypotheses", static_cast<double>(max_hypotheses), 1.0, 1e6);
  requireInRange("search_threads", search_threads, 0.0, 1024.0);
  monitor.check();
  last_metres.check();
  requireInRange("share", share, 0.0, 1.0);
  requireNotNegative("least_gain", least_gain);
  requireInRange("sure_weight", sure_weight, 0.0, 1.0);
  requireInRange("judged_particles", static_cast<double>(judged_particles), 1.0, 1e6);
}

double filterFit(const CPolygonMap2D& map, const CObservation2DRangeScan& scan,
                 const CPosePDFParticles& particles, std::size_t judged) {
  CPolygonMap2D judge = map;  // shares the polygons
  judge.likelihoodOptions = fitOptions();
  const std::vector<double> fits =
      judge.computeLikelihoods(scan, evenlyByWeight(particles, judged));
  return std::accumulate(fits.begin(), fits.end(), 0.0) / static_cast<double>(fits.size());
}

void mixIn(const std::vector<WeightedPose>& drawn, double share, CPosePDFParticles& particles) {
  const std::size_t before = particles.m_particles.size();
  const std::size_t half = (before + 1) / 2;
  const std::size_t room = before > drawn.size() ? before - drawn.size() : 0;
  const std::size_t kept = share < 1.0 ? std::max(half, room) : 0;
  const std::vector<mrpt::math::TPose2D> old = evenlyByWeight(particles, kept);

  particles.clearParticles();
  particles.m_particles.resize(old.size() + (share > 0.0 ? drawn.size() : 0));
  for (std::size_t i = 0; i < particles.m_particles.size(); ++i) {
    auto& particle = particles.m_particles[i];
    if (i < old.size()) {
      particle.d = old[i];
      particle.log_w = std::log1p(-share) - std::log(static_cast<double>(old.size()));
    } else {
      particle.d = drawn[i - old.size()].pose_map_robot;
      particle.log_w = std::log(share) + drawn[i - old.size()].log_weight;
    }
  }
}

FilterRecovery::FilterRecovery(const GlobalLocalizer& localizer, const ParticleSeeder& seeder,
                               CPolygonMap2D map, const FilterRecoveryParams& params)
    : localizer_(&localizer),
      seeder_(&seeder),
      map_(std::move(map)),
      params_(params),
      monitor_(params.monitor),
      seen_(params.last_metres) {
  params_.check();
}

void FilterRecovery::move(const Motion& motion) {
  motion.check();
  since_scan_ = since_scan_ + motion;
}

/// Takes the scan, and returns what was seen on the last metres.
ScanSet FilterRecovery::lastMetresWith(RangeScan scan) {
  if (params_.last_metres.length <= 0.0) return ScanSet(std::move(scan));
  if (scan.stamp() < last_stamp_) seen_.clear();  // a clock set back, or a log begun again
  last_stamp_ = scan.stamp();
  const Motion way = std::exchange(since_scan_, Motion());
  return seen_.add({std::move(scan)}, way);
}

LocalizationResult FilterRecovery::search(const ScanSet& seen) const {
  SearchOptions options;
  options.max_hypotheses = params_.max_hypotheses;
  options.threads = params_.search_threads;
  return localizer_->localize(seen, {}, options);
}

LocalizationResult FilterRecovery::start(const CObservation2DRangeScan& scan, std::uint64_t seed,
                                         CPosePDFParticles& particles) {
  seen_.clear();
  LocalizationResult found = search(lastMetresWith(toRangeScan(scan)));
  seeder_->seed(found, seed, particles);
  is_placed_ = !found.hypotheses.empty();
  return found;
}

FilterRecovery::Verdict FilterRecovery::update(const CObservation2DRangeScan& scan,
                                               std::uint64_t seed, CPosePDFParticles& particles) {
  Verdict verdict;
  RangeScan beams = toRangeScan(scan);
  verdict.health = health_;
  if (beams.hitCount() < params_.least_hits) return verdict;
  verdict.fit = filterFit(map_, scan, particles, params_.judged_particles);
  const bool was_in_doubt = isInDoubt(health_);
  // Before it is placed the filter's own steps say nothing of how a good fit looks.
  if (is_placed_) health_ = monitor_.update(*verdict.fit);
  verdict.health = health_;
  if (isInDoubt(health_) && !was_in_doubt) seen_.clear();
  const ScanSet seen = lastMetresWith(std::move(beams));
  if (is_placed_ && health_ != FilterHealth::lost) {
    if (health_ != FilterHealth::doubtful) unsure_ = 0;
    return verdict;
  }

  verdict.search = search(seen);
  if (verdict.search->hypotheses.empty()) return verdict;
  const Hypothesis& best = verdict.search->hypotheses.front();
  verdict.best_fit = -best.cost / fitOptions().sigma;
  if (is_placed_) {
    const bool gains = *verdict.best_fit >= *verdict.fit + params_.least_gain;
    const bool is_sure =
        best.weight >= params_.sure_weight && *verdict.best_fit >= monitor_.threshold();
    if (gains && !is_sure && unsure_++ < params_.patience) return verdict;
    unsure_ = 0;
    monitor_.recovered();  // found, or as well off as can be: either way judged from here on
    if (!gains) return verdict;
  }
  mixIn(seeder_->draw(toSog(*verdict.search), seed), params_.share, particles);
  verdict.mixed_in = true;
  is_placed_ = true;
  return verdict;
}

}  // namespace mrpt_polyloc
