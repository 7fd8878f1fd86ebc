#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/scan/Motion.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>
#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>
#include <mrpt_polyloc/mrpt_bridge/FilterMonitor.h>
#include <mrpt_polyloc/mrpt_bridge/ParticleSeeder.h>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPosePDFParticles.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

struct POLYLOC_EXPORT FilterRecoveryParams {
  FilterMonitorParams monitor;
  /// Share of belief that new hypotheses get when the filter is lost. Half: neither the filter nor
  /// the search is believed beforehand, the scans decide.
  double share = 0.5;
  /// New hypotheses are mixed in only if the best explains the scan better than the filter does by
  /// so much [mean log-likelihood per beam]: else the world has changed, not the robot's place, and
  /// rivals would only confuse the filter.
  double least_gain = 0.4;
  /// The robot counts as found if the first hypothesis has at least so much of the weight, and fits
  /// as a healthy filter does. Else the filter waits for a scan that says more: a person who blocks
  /// the view makes it look like many places, or like none.
  double sure_weight = 0.995;
  /// But not for more scans than this: where the place is ambiguous the filter must follow all.
  std::size_t patience = 10;
  /// The fit is the mean over so many particles, taken evenly by weight: enough to see what most of
  /// the belief says, few enough to cost nothing beside the filter.
  std::size_t judged_particles = 50;
  /// Scans with fewer hits are not judged: they fit almost everywhere.
  std::size_t least_hits = 15;
  std::size_t max_hypotheses = 20;  ///< of a search, so many are seeded or mixed in
  int search_threads = 1;           ///< see SearchOptions::threads
  /// A search looks at all scans of the last so many metres, where move() tells how they were
  /// driven. Length 0: at the last scan alone.
  LastMetresParams last_metres = nowAlone();

  static LastMetresParams nowAlone() {
    LastMetresParams params;
    params.length = 0.0;
    return params;
  }

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// The mean over a filter's particles, by weight, of the mean log-likelihood per beam of a scan, a
/// Laplace density of RobustCost with the default options of CPolygonMap2D: 0 for a perfect fit.
/// \param judged number of particles that are looked at
POLYLOC_EXPORT double filterFit(const CPolygonMap2D& map,
                                const mrpt::obs::CObservation2DRangeScan& scan,
                                const mrpt::poses::CPosePDFParticles& particles,
                                std::size_t judged);

/// Mixes new particles into a filter, with `share` of the belief. The old ones are thinned evenly
/// by weight, to as many as keep the number of all what it was, but at least half of them.
/// \param drawn new particles, weights summing to 1
POLYLOC_EXPORT void mixIn(const std::vector<WeightedPose>& drawn, double share,
                          mrpt::poses::CPosePDFParticles& particles);

/// Keeps a Monte Carlo filter from staying lost: starts it from a search, judges how well each scan
/// fits, and when the robot is lost searches again and mixes what is found in.
///
/// Use: start() with the first scan; then after each of the filter's steps update(), and where it
/// returns that hypotheses were mixed in, weigh the particles with the scan once more
/// (`executeOn(filter, nullptr, &frame)`). Keeps references to localizer and seeder.
///
/// *A short drive* tells places apart that one scan cannot. With `last_metres` each search looks at
/// the scans of the last metres (see GlobalLocalizer::localize(ScanSet)): call move() before each
/// update(). What was seen before the filter came into doubt is forgotten then, for the robot may
/// have been carried since.
class POLYLOC_EXPORT FilterRecovery {
 public:
  /// \throws InvalidParamsError
  FilterRecovery(const GlobalLocalizer& localizer, const ParticleSeeder& seeder, CPolygonMap2D map,
                 const FilterRecoveryParams& params = {});

  /// Replaces the particles by what the search finds for the first scan. If it finds nothing they
  /// are spread over the free space, and update() searches at each scan until something is found.
  /// \throws std::invalid_argument as toRangeScan()
  LocalizationResult start(const mrpt::obs::CObservation2DRangeScan& scan, std::uint64_t seed,
                           mrpt::poses::CPosePDFParticles& particles);

  struct Verdict {
    std::optional<double> fit;  ///< none where the scan was not judged
    FilterHealth health = FilterHealth::learning;
    std::optional<LocalizationResult> search;  ///< if there was one
    std::optional<double> best_fit;            ///< of the best hypothesis, if there was one
    bool mixed_in = false;                     ///< whether the particles have changed
  };

  /// How the robot moved since the scan before; several calls add up.
  /// \throws InvalidParamsError unless it is finite
  void move(const Motion& motion);

  /// Judges the filter after its step with this scan. Costs `judged_particles` likelihoods, and a
  /// search if lost.
  Verdict update(const mrpt::obs::CObservation2DRangeScan& scan, std::uint64_t seed,
                 mrpt::poses::CPosePDFParticles& particles);

 private:
  ScanSet lastMetresWith(RangeScan scan);
  LocalizationResult search(const ScanSet& seen) const;

  const GlobalLocalizer* localizer_;
  const ParticleSeeder* seeder_;
  CPolygonMap2D map_;
  FilterRecoveryParams params_;
  FilterMonitor monitor_;
  FilterHealth health_ = FilterHealth::learning;
  ScanAccumulator seen_;
  Motion since_scan_;  ///< since the last scan that was taken
  double last_stamp_ = 0.0;
  bool is_placed_ = true;   ///< some search has found something
  std::size_t unsure_ = 0;  ///< searches in a row that were not sure
};

}  // namespace mrpt_polyloc
