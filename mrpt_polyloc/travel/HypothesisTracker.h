#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/ranking/Hypothesis.h>
#include <mrpt_polyloc/localization/scan/Motion.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

struct POLYLOC_EXPORT HypothesisTrackerParams {
  /// How much of an independent scan each is. Not fitted: a tracker must come to a decision within
  /// some metres, and where a map is off by the same over metres it may be too sure.
  ScanCorrelation correlation{0.5, 0.7853981633974483};
  /// A scan speaks for one hypothesis against another by at most so many standard errors: a person
  /// in the view is one wrong scan, not many.
  double most_standard_errors = 3.0;
  double least_weight = 1e-4;       ///< hypotheses that fall below this are hopeless, and dropped
  std::size_t max_hypotheses = 40;  ///< of a search, so many are followed
  int search_threads = 1;           ///< see SearchOptions::threads
  /// Probability, for each metre driven, that the robot is carried elsewhere, or that what stands
  /// in the map moved.
  double lost_per_metre = 1e-3;
  /// What "none of these" never falls below: after any time a robot may be carried.
  double least_none_probability = 1e-3;
  /// From this probability of "none of these" on the tracker searches anew.
  double search_probability = 0.5;
  /// A scan changes the odds of "none of these" by at most this factor, either way.
  double most_odds = 20.0;
  /// From this probability of the first on the status is `unique`.
  double unique_probability = 0.95;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// A pose that is followed.
struct POLYLOC_EXPORT TrackedHypothesis {
  /// The same as long as it lives, and never given twice.
  std::uint64_t id = 0;
  mrpt::math::TPose2D pose_map_robot{0, 0, 0};                                   ///< now [m, rad]
  mrpt::math::CMatrixDouble33 covariance = mrpt::math::CMatrixDouble33::Zero();  ///< of it
  /// Probability that it is the robot's pose; those of all and "none of these" sum to 1.
  double weight = 0.0;
  double cost = 0.0;  ///< mean robust cost per beam of the last scans [m]

  /// The same as one scan's hypothesis, not behind any other.
  Hypothesis toHypothesis() const;
};

/// What the tracker holds after a scan.
struct POLYLOC_EXPORT TrackingState {
  /// unique: the first hypothesis has unique_probability; ambiguous: some live, and none has;
  /// no_match: "none of these" is likelier than not, or none lives; too_few_beams: nothing was
  /// searched yet, for no scan said enough.
  LocalizationStatus status = LocalizationStatus::too_few_beams;
  std::vector<TrackedHypothesis> hypotheses;  ///< heaviest first
  double none_probability = 1.0;              ///< that none of them is the robot's pose
  std::size_t scans = 0;                      ///< taken so far
  double travelled = 0.0;                     ///< so far [m]
  bool has_searched = false;                  ///< whether the last update() made a search
  /// Of the last search: the share of the posterior that what it found holds, see
  /// LocalizationResult::listed; 0 if max_hypotheses were not enough for all that may be right. Far
  /// below 1 the robot may be where no hypothesis is, and who is left in the end need not be right.
  double listed = 0.0;
  std::vector<std::uint64_t> dropped;  ///< by the last update(): hopeless ones
  std::vector<std::uint64_t> merged;   ///< by the last update(): became one with a heavier
};

/// Follows hypotheses over a drive, without particles: the first scan is searched; then every
/// hypothesis is moved by the wheels with growing covariance, refined by each scan (the movement's
/// covariance and the scan's information weighed against each other), and weighed by it; hopeless
/// ones are dropped, those that become one are merged. "None of these" has a probability of its
/// own, by how likely the scans were taken where the hypotheses say (see MatchFeatures); where it
/// grows too much, what a new search finds joins them with its share.
///
/// *Weights.* A scan multiplies the weight of a hypothesis by exp(-decay z g): z the standard
/// errors by which it explains the scan worse than the one that does best, decay that of
/// Calibration, and g, from 0 to 1, how independent the scan is of the one before it
/// (ScanCorrelation::gain()). That is Bayes' rule where exp(-decay z) is the calibrated likelihood
/// ratio of one scan.
///
/// Deterministic: the same scans and movements give the same states. Not thread-safe; copyable, so
/// that a planner may try what would be seen.
class POLYLOC_EXPORT HypothesisTracker {
 public:
  /// \throws InvalidParamsError
  explicit HypothesisTracker(GlobalLocalizer localizer, HypothesisTrackerParams params = {},
                             PosePrior prior = {});

  /// Moves all hypotheses by what the wheels say. May be called several times between scans.
  /// \throws InvalidParamsError unless the motion is finite
  void move(const Motion& motion);

  /// Takes the scans of one moment, of one laser or several, at the pose that the movements so far
  /// led to. \returns state()
  const TrackingState& update(const std::vector<RangeScan>& scans);
  const TrackingState& update(const RangeScan& scan);

  const TrackingState& state() const { return state_; }

  /// Follows what a search found for the robot's pose now, as of the scans of the last metres
  /// (GlobalLocalizer::localize(ScanSet)), and forgets the rest. The next update() weighs it.
  const TrackingState& start(const LocalizationResult& found);

  /// The state as a search's result, to seed MRPT's filters from (see ParticleSeeder): weights are
  /// shares of the hypotheses alone, match_probability that one of them is right.
  LocalizationResult result() const;

  /// Forgets all; the next scan is searched.
  void reset();
  /// The same; what is known of the pose of that scan takes the place of what was known of the
  /// first. \throws InvalidParamsError
  void reset(const PosePrior& prior);

  const GlobalLocalizer& localizer() const { return localizer_; }
  const HypothesisTrackerParams& params() const { return params_; }

 private:
  void search(const ScanSet& now);
  void adopt(const LocalizationResult& found, bool is_cut);
  void weigh(const ScanSet& now, double share);
  void doubt(const ScanSet& now, double share);
  void mergeNear();
  void settle();

  GlobalLocalizer localizer_;
  HypothesisTrackerParams params_;
  PosePrior prior_;  ///< of the first scan's pose
  TrackingState state_;
  Motion since_scan_;          ///< since the last scan
  double since_search_ = 0.0;  ///< independent scans since the last search
  std::uint64_t next_id_ = 1;
};

}  // namespace mrpt_polyloc
