#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/MapIndexParts.h>
#include <mrpt_polyloc/localization/ranking/SetEvidence.h>
#include <mrpt_polyloc/localization/ranking/SetRefiner.h>
#include <mrpt_polyloc/localization/ranking/match_features.h>
#include <mrpt_polyloc/travel/HypothesisTracker.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// However alike its scans are, a look says so much: a robot that is carried while its wheels stand
/// must be missed some time.
constexpr double kLeastGain = 0.05;

/// ... and whether it fits at all so much more: a robot that was carried should be missed within
/// some ten scans, and a search for nothing costs little.
constexpr double kLeastDoubtGain = 0.4;

/// Mean over the lasers, by their hits, of the log-odds that a scan was taken where the robot is
/// believed to be.
double matchLogOdds(const ScanSet& now, const TPose2D& pose_map_robot, const SetEvidence& evidence,
                    const PoseRefiner* const* refiners, const Calibration& calibration) {
  double sum = 0.0, hits = 0.0;
  const std::vector<RangeScan>& scans = now.now().scans;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (scans[i].hitCount() == 0) continue;
    const ScanCost& cost = evidence.costs(0)[i];
    const TPose2D beams = scans[i].beamFrameFromRobot(pose_map_robot);
    const std::vector<ScoredPose> alone{{refiners[i]->at(beams), cost.mean(beams)}};
    const double p = calibration.matchProbability(
        matchFeatures(alone, alone.front(), cost, BeamSectors(cost.beams())));
    const auto weight = static_cast<double>(scans[i].hitCount());
    sum += weight * std::log(std::max(p, 1e-12) / std::max(1.0 - p, 1e-12));
    hits += weight;
  }
  return hits > 0.0 ? sum / hits : 0.0;
}

}  // namespace

Hypothesis TrackedHypothesis::toHypothesis() const {
  Hypothesis hypothesis;
  hypothesis.pose_map_robot = pose_map_robot;
  hypothesis.covariance = covariance;
  hypothesis.weight = weight;
  hypothesis.cost = cost;
  return hypothesis;
}

void HypothesisTrackerParams::check() const {
  correlation.check();
  requirePositive("most_standard_errors", most_standard_errors);
  requireInRange("least_weight", least_weight, 0.0, 0.1);
  requireInRange("max_hypotheses", static_cast<double>(max_hypotheses), 1.0, 1e4);
  requireInRange("search_threads", search_threads, 0.0, 1024.0);
  requireInRange("lost_per_metre", lost_per_metre, 0.0, 1.0);
  requireInRange("least_none_probability", least_none_probability, 0.0, 0.5);
  requireInRange("search_probability", search_probability, 0.0, 1.0);
  requireInRange("most_odds", most_odds, 1.0, 1e9);
  requireInRange("unique_probability", unique_probability, 0.5, 1.0);
}

HypothesisTracker::HypothesisTracker(GlobalLocalizer localizer, HypothesisTrackerParams params,
                                     PosePrior prior)
    : localizer_(std::move(localizer)), params_(params), prior_(prior) {
  params_.check();
  prior_.check();
}

void HypothesisTracker::reset() {
  state_ = TrackingState();
  since_scan_ = Motion();
  since_search_ = 0.0;
}

void HypothesisTracker::reset(const PosePrior& prior) {
  prior.check();
  prior_ = prior;
  reset();
}

void HypothesisTracker::move(const Motion& motion) {
  motion.check();
  since_scan_ = since_scan_ + motion;
  state_.travelled += motion.length();
  for (TrackedHypothesis& hypothesis : state_.hypotheses) {
    hypothesis.pose_map_robot =
        mrpt_polyloc::move(hypothesis.pose_map_robot, motion, hypothesis.covariance);
  }
}

const TrackingState& HypothesisTracker::update(const RangeScan& scan) {
  return update(std::vector<RangeScan>{scan});
}

const TrackingState& HypothesisTracker::update(const std::vector<RangeScan>& scans) {
  const ScanSet now(scans);
  state_.has_searched = false;
  state_.dropped.clear();
  state_.merged.clear();
  ++state_.scans;
  if (now.hitCount() < localizer_.params().least_hits) return state_;  // it says too little

  const bool is_first = state_.status == LocalizationStatus::too_few_beams;
  const double gain = is_first ? 1.0 : std::max(kLeastGain, params_.correlation.gain(since_scan_));
  since_search_ += gain;
  if (is_first) {
    search(now);
  } else {
    // Carried, or the world has changed, on the way.
    const double lost = 1.0 - std::exp(-params_.lost_per_metre * since_scan_.length());
    state_.none_probability += lost * (1.0 - state_.none_probability);
    for (TrackedHypothesis& hypothesis : state_.hypotheses) hypothesis.weight *= 1.0 - lost;
    if (!state_.hypotheses.empty()) {
      weigh(now, gain);
      doubt(now, std::max(gain, kLeastDoubtGain));
    }
    constexpr double kBetweenSearches = 0.2;  // independent scans
    if (state_.none_probability >= params_.search_probability &&
        since_search_ >= kBetweenSearches) {
      search(now);
    }
  }
  since_scan_ = Motion();
  mergeNear();
  settle();
  return state_;
}

void HypothesisTracker::search(const ScanSet& now) {
  SearchOptions options;
  options.max_hypotheses = params_.max_hypotheses;
  options.threads = params_.search_threads;
  options.unite_valleys = false;  // the next scans may tell where in it
  const bool is_first = state_.status == LocalizationStatus::too_few_beams;
  const LocalizationResult found =
      localizer_.localize(now, is_first ? prior_ : PosePrior(), options);
  adopt(found, found.hypotheses.size() == options.max_hypotheses &&
                   found.hypotheses.back().weight >= params_.least_weight);
}

/// What was believed of "none of these" is shared between the new ones and, still, none of them.
void HypothesisTracker::adopt(const LocalizationResult& found, bool is_cut) {
  state_.has_searched = true;
  since_search_ = 0.0;
  state_.listed = is_cut ? 0.0 : found.listed;
  const double share =
      state_.none_probability * std::min(found.match_probability * found.listed, 0.999);
  for (const Hypothesis& hypothesis : found.hypotheses) {
    state_.hypotheses.push_back({next_id_++, hypothesis.pose_map_robot, hypothesis.covariance,
                                 share * hypothesis.weight / found.listed, hypothesis.cost});
  }
  state_.none_probability -= share;
}

const TrackingState& HypothesisTracker::start(const LocalizationResult& found) {
  const std::size_t scans = state_.scans;
  const double travelled = state_.travelled;
  reset();
  state_.scans = scans;
  state_.travelled = travelled;
  if (found.status == LocalizationStatus::too_few_beams) return state_;
  adopt(found, false);
  mergeNear();
  settle();
  return state_;
}

void HypothesisTracker::weigh(const ScanSet& now, double gain) {
  const MapIndexParts& parts = localizer_.index().parts();
  const GlobalLocalizerParams& with = localizer_.params();
  const MomentWeights alone(now, with.correlation);
  const SetRefiner refiner(parts.predictor(), now, alone, with.refinement,
                           with.hypotheses.calibration);
  const SetEvidence evidence(parts.predictor(), now, alone, with.cost, with.hypotheses.evidence);
  std::vector<SetEvidence::Values> values;
  for (TrackedHypothesis& hypothesis : state_.hypotheses) {
    const GaussianPose known{hypothesis.pose_map_robot, hypothesis.covariance, gain};
    const RefinedWay refined = refiner.refine({hypothesis.pose_map_robot}, known);
    hypothesis.pose_map_robot = refined.poses.back();
    hypothesis.covariance = refined.covariance;
    hypothesis.cost = evidence.cost(refined.poses);
    hypothesis.weight *= std::exp(-0.5 * std::min(refined.tension, 20.0) * gain);
    values.push_back(evidence.at(refined.poses));
  }
  // Against the one that explains this scan best.
  std::size_t best = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (evidence.mean(values[i]) < evidence.mean(values[best])) best = i;
  }
  double before = 0.0, after = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double behind =
        standardErrors(evidence.difference(values[best], values[i]), with.hypotheses.mapError());
    const double counted = std::clamp(behind, 0.0, params_.most_standard_errors);
    before += state_.hypotheses[i].weight;
    state_.hypotheses[i].weight *=
        std::exp(-with.hypotheses.calibration.weight_decay * counted * gain);
    after += state_.hypotheses[i].weight;
  }
  // Among themselves; whether any is right is another question, see doubt().
  if (!(after > 0.0)) return;
  for (TrackedHypothesis& hypothesis : state_.hypotheses) hypothesis.weight *= before / after;
}

void HypothesisTracker::doubt(const ScanSet& now, double gain) {
  const MapIndexParts& parts = localizer_.index().parts();
  const GlobalLocalizerParams& with = localizer_.params();
  const MomentWeights alone(now, with.correlation);
  const SetEvidence evidence(parts.predictor(), now, alone, with.cost, with.hypotheses.evidence);
  std::vector<PoseRefiner> refiners;
  for (const RangeScan& scan : now.now().scans) {
    refiners.emplace_back(parts.predictor(), scan, with.refinement);
  }
  std::vector<const PoseRefiner*> pointers;
  for (const PoseRefiner& refiner : refiners) pointers.push_back(&refiner);
  const auto heaviest = std::max_element(
      state_.hypotheses.begin(), state_.hypotheses.end(),
      [](const TrackedHypothesis& a, const TrackedHypothesis& b) { return a.weight < b.weight; });
  const double most = std::log(params_.most_odds);
  const double odds = std::clamp(matchLogOdds(now, heaviest->pose_map_robot, evidence,
                                              pointers.data(), with.hypotheses.calibration),
                                 -most, most);
  const double none = state_.none_probability * std::exp(-gain * odds);
  const double some = 1.0 - state_.none_probability;
  if (!(some > 0.0)) return;
  const double before = state_.none_probability;
  state_.none_probability = std::max(none / (none + some), params_.least_none_probability);
  const double scale = (1.0 - state_.none_probability) / (1.0 - before);
  for (TrackedHypothesis& hypothesis : state_.hypotheses) hypothesis.weight *= scale;
}

void HypothesisTracker::mergeNear() {
  std::vector<TrackedHypothesis>& all = state_.hypotheses;
  std::stable_sort(
      all.begin(), all.end(),
      [](const TrackedHypothesis& a, const TrackedHypothesis& b) { return a.weight > b.weight; });
  const HypothesisParams& with = localizer_.params().hypotheses;
  std::vector<TrackedHypothesis> kept;
  for (const TrackedHypothesis& hypothesis : all) {
    const TPose2D& pose = hypothesis.pose_map_robot;
    const auto near = std::find_if(kept.begin(), kept.end(), [&](const TrackedHypothesis& other) {
      const TPose2D& there = other.pose_map_robot;
      return std::hypot(pose.x - there.x, pose.y - there.y) < with.merge_distance &&
             angleBetween(pose.phi, there.phi) < with.merge_angle;
    });
    if (near == kept.end()) {
      kept.push_back(hypothesis);
    } else {
      near->weight += hypothesis.weight;
      state_.merged.push_back(hypothesis.id);
    }
  }
  all = std::move(kept);
}

void HypothesisTracker::settle() {
  std::vector<TrackedHypothesis>& all = state_.hypotheses;
  std::stable_sort(
      all.begin(), all.end(),
      [](const TrackedHypothesis& a, const TrackedHypothesis& b) { return a.weight > b.weight; });
  const auto hopeless = std::find_if(all.begin(), all.end(), [&](const TrackedHypothesis& h) {
    return h.weight < params_.least_weight;
  });
  for (auto it = hopeless; it != all.end(); ++it) state_.dropped.push_back(it->id);
  all.erase(hopeless, all.end());
  double sum = state_.none_probability;
  for (const TrackedHypothesis& hypothesis : all) sum += hypothesis.weight;
  if (sum > 0.0) {
    state_.none_probability /= sum;
    for (TrackedHypothesis& hypothesis : all) hypothesis.weight /= sum;
  }
  if (all.empty() || state_.none_probability > 0.5) {
    state_.status = LocalizationStatus::no_match;
  } else {
    state_.status = all.front().weight >= params_.unique_probability
                        ? LocalizationStatus::unique
                        : LocalizationStatus::ambiguous;
  }
}

LocalizationResult HypothesisTracker::result() const {
  LocalizationResult result;
  result.status = state_.status;
  if (state_.status == LocalizationStatus::too_few_beams) return result;
  result.match_probability = 1.0 - state_.none_probability;
  double sum = 0.0;
  for (const TrackedHypothesis& tracked : state_.hypotheses) sum += tracked.weight;
  if (state_.status == LocalizationStatus::no_match || !(sum > 0.0)) return result;
  const double decay = localizer_.params().hypotheses.calibration.weight_decay;
  for (const TrackedHypothesis& tracked : state_.hypotheses) {
    Hypothesis hypothesis = tracked.toHypothesis();
    hypothesis.weight /= sum;
    // What one scan that would give these weights would have said.
    hypothesis.z_score = std::log(state_.hypotheses.front().weight / tracked.weight) / decay;
    result.hypotheses.push_back(hypothesis);
  }
  result.listed = 1.0;
  return result;
}

}  // namespace mrpt_polyloc
