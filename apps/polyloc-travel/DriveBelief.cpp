#include "DriveBelief.h"

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/ranking/MomentWeights.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPose2D;

/// Enough of a drive that rooms and doors of one floor differ, not so much that it costs seconds.
LastMetresParams drivenMetres() {
  LastMetresParams params;
  params.length = 12.0;
  params.spacing = 0.8;
  params.most_moments = 10;
  params.longest_step = 5.0;
  return params;
}

/// Hypotheses of a search: lasers of short range see the same in very many places.
constexpr std::size_t kMostOfOne = 100, kMostOfDrive = 50;
/// A list that holds so much of the posterior is whole.
constexpr double kWhole = 0.97;
/// The probability that an answer by the first scan alone must have: it is the last word.
constexpr double kSureOfOne = 0.98;
/// The weight that an answer must have by the last metres together.
constexpr double kSure = 0.99;
/// After so long a drive [m] ...
constexpr double kLongDrive = 3.0;
/// ... the probability of a match, as of one scan, only bars answers that fit badly all along.
constexpr double kLeastMatch = 0.4;
/// From this probability that none of the hypotheses is right on nothing is made of them.
constexpr double kLost = 0.7;

/// The probability of a match of a drive as of its scans one by one. The robot is in this map, and
/// what that does not have speaks against the right place at each look: that many looks agree on it
/// is no word against the place.
double matchOfOne(double match, double independent) {
  const double some = std::pow(match, 1.0 / independent);
  const double none = std::pow(1.0 - match, 1.0 / independent);
  return some + none > 0.0 ? some / (some + none) : match;
}

/// Whether the pose is known well, too: who looks into the void has its heading from the wheels.
bool isWellHeld(const Hypothesis& hypothesis) {
  constexpr double kPosition = 0.12, kHeading = 2.0 * kDegree;  // [m], standard deviations
  return hypothesis.covariance(0, 0) < kPosition * kPosition &&
         hypothesis.covariance(1, 1) < kPosition * kPosition &&
         hypothesis.covariance(2, 2) < kHeading * kHeading;
}

double lengthOf(const ScanSet& drive) {
  double length = 0.0;
  for (std::size_t i = 1; i < drive.moments().size(); ++i) {
    length += drive.moments()[i].since_before.length();
  }
  return length;
}

HypothesisTrackerParams trackerParams() {
  HypothesisTrackerParams params;
  params.max_hypotheses = kMostOfOne;
  return params;
}

}  // namespace

GlobalLocalizerParams surerSearch() {
  GlobalLocalizerParams params;
  params.sure_probability = 1.0;
  return params;
}

DriveBelief::DriveBelief(const GlobalLocalizer& localizer, const MotionNoise& odometry,
                         const PosePrior& prior)
    : localizer_(localizer),
      odometry_noise_(odometry),
      prior_(prior),
      tracker_(localizer, trackerParams(), prior),
      last_metres_(drivenMetres()) {}

void DriveBelief::move(const Motion& measured, double turned) {
  tracker_.move(measured);
  since_scan_ = since_scan_ + measured;
  odometry_ = odometry_ + measured.pose_before_after;
  driven_ += measured.length();
  turned_ += turned;
}

void DriveBelief::look(const RangeScan& scan) {
  const ScanSet drive = last_metres_.add({scan}, since_scan_);
  since_scan_ = Motion();
  is_searched_now_ = false;
  follow(drive);
  answer_ = conclude(drive);
}

/// What was known of the start, carried on by the wheels and three standard deviations of theirs.
PosePrior DriveBelief::priorNow() const {
  PosePrior prior = prior_;
  if (prior.compass) {
    const double lost =
        odometry_noise_.heading_per_metre * driven_ + odometry_noise_.heading_per_radian * turned_;
    prior.compass->heading += odometry_.phi;
    prior.compass->tolerance = std::min(kPi, prior.compass->tolerance + 3.0 * lost);
  }
  if (prior.near) {
    prior.near->radius += (1.0 + 3.0 * odometry_noise_.position_per_metre) * driven_;
  }
  return prior;
}

/// Lasers of short range see the same in so many places that a search cannot list them all. What
/// is concluded among some of them is worth nothing: the last metres are searched anew with each
/// scan until there is a list that is whole.
void DriveBelief::follow(const ScanSet& drive) {
  if (!is_anchored_ || isLost()) return search(drive);
  const TrackingState& state = tracker_.update(drive.now().scans);
  if (state.has_searched) is_anchored_ = state.listed >= kWhole;
}

/// The tracker goes on with what the scans of the last metres say together.
void DriveBelief::search(const ScanSet& drive) {
  SearchOptions options;
  options.max_hypotheses = drive.single() != nullptr ? kMostOfOne : kMostOfDrive;
  options.unite_valleys = false;
  if (!is_searched_now_) {
    searched_ = localizer_.localize(drive, priorNow(), options);
    const MomentWeights weights(drive, localizer_.params().correlation);
    searched_.match_probability = matchOfOne(searched_.match_probability, weights.independent);
  }
  is_searched_now_ = true;
  const std::vector<Hypothesis>& found = searched_.hypotheses;
  const bool is_cut = found.size() == options.max_hypotheses &&
                      found.back().weight >= tracker_.params().least_weight;
  is_anchored_ = searched_.listed >= kWhole && !is_cut;
  tracker_.start(searched_);
}

/// The pose that the robot is sure of: the tracker's, if the scans of the last metres, searched
/// anew and judged together, have the same answer. If they have another, or several, the tracker
/// goes on with those: it followed what was left of a list without the truth.
std::optional<TPose2D> DriveBelief::conclude(const ScanSet& drive) {
  const TrackingState& state = tracker_.state();
  if (!is_anchored_ || state.hypotheses.empty()) return std::nullopt;
  const TrackedHypothesis first = state.hypotheses.front();
  if (drive.single() != nullptr) {
    const bool is_sure =
        searched_.status == LocalizationStatus::unique && first.weight >= kSureOfOne;
    return is_sure ? std::optional<TPose2D>(first.pose_map_robot) : std::nullopt;
  }
  if (state.status != LocalizationStatus::unique) return std::nullopt;
  search(drive);
  double near = 0.0;
  for (const Hypothesis& hypothesis : searched_.hypotheses) {
    if (isRight(hypothesis.pose_map_robot, first.pose_map_robot, kSamePlace)) {
      near += hypothesis.weight;
    }
  }
  const bool is_known =
      searched_.status == LocalizationStatus::unique ||
      (lengthOf(drive) >= kLongDrive && searched_.match_probability >= kLeastMatch);
  if (near < kSure || !is_known || !isWellHeld(searched_.hypotheses.front())) return std::nullopt;
  return searched_.hypotheses.front().pose_map_robot;  // by all scans: surer than the tracker's
}

bool DriveBelief::isLost() const {
  const TrackingState& state = tracker_.state();
  return state.hypotheses.empty() || state.none_probability > kLost;
}

}  // namespace mrpt_polyloc::apps
