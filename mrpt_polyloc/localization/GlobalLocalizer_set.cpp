#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/MapIndexParts.h>
#include <mrpt_polyloc/localization/answer_threads.h>
#include <mrpt_polyloc/localization/ranking/set_ranking.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// A scan of a set.
struct Place {
  std::size_t moment, scan;
};

/// The scans that say enough to be searched, in the order in which they are: now first, then each
/// that is the least correlated with those before it.
std::vector<Place> searchOrder(const ScanSet& set, const MomentWeights& weights,
                               std::size_t least_hits, std::size_t most) {
  std::vector<Place> left, order;
  for (std::size_t k = set.moments().size(); k-- > 0;) {
    for (std::size_t i = 0; i < set.moments()[k].scans.size(); ++i) {
      if (set.moments()[k].scans[i].hitCount() >= least_hits) left.push_back({k, i});
    }
  }
  while (!left.empty() && order.size() < most) {
    std::size_t next = 0;
    double least = 2.0;
    for (std::size_t i = 0; i < left.size() && !order.empty(); ++i) {
      double nearest = 0.0;
      for (const Place& taken : order) {
        nearest = std::max(nearest, weights.correlations[left[i].moment][taken.moment]);
      }
      if (nearest >= least) continue;
      least = nearest;
      next = i;
    }
    order.push_back(left[next]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(next));
  }
  return order;
}

/// What a prior of the robot now says of it at another moment: wider by what the wheels may be
/// wrong, three standard deviations.
PosePrior carried(const PosePrior& now, const Motion& from_now) {
  constexpr double kDeviations = 3.0;
  PosePrior then = now;
  if (then.compass) {
    then.compass->heading += from_now.pose_before_after.phi;
    then.compass->tolerance =
        std::min(kPi, then.compass->tolerance + kDeviations * std::sqrt(from_now.covariance(2, 2)));
  }
  if (then.near) {
    // The heading may be any: the way points anywhere from the disk.
    const double std_position =
        std::sqrt(std::max(from_now.covariance(0, 0), from_now.covariance(1, 1)));
    then.near->radius += from_now.length() + kDeviations * std_position;
  }
  return then;
}

/// Adds poses that are not nearly one of those there.
void unite(std::vector<TPose2D>& poses, const std::vector<TPose2D>& others,
           const HypothesisParams& params) {
  for (const TPose2D& pose : others) {
    const bool is_new = std::none_of(poses.begin(), poses.end(), [&](const TPose2D& other) {
      return std::hypot(pose.x - other.x, pose.y - other.y) < params.merge_distance &&
             angleBetween(pose.phi, other.phi) < params.merge_angle;
    });
    if (is_new) poses.push_back(pose);
  }
}

void addSearch(SearchStatistics& sum, const SearchStatistics& of_one) {
  sum.positions = of_one.positions;
  sum.evaluated += of_one.evaluated;
  sum.refined += of_one.refined;
  sum.search_ms += of_one.search_ms;
}

}  // namespace

LocalizationResult GlobalLocalizer::localize(const ScanSet& set, const PosePrior& prior,
                                             const SearchOptions& options) const {
  if (set.single() != nullptr) return localize(*set.single(), prior, options);
  prior.check();
  options.check();
  if (options.threads > 1) {
    return inOwnArena(options,
                      [&](const SearchOptions& inside) { return localize(set, prior, inside); });
  }
  const Stopwatch watch;
  const Budget budget = budgetOf(options);
  const MapIndexParts& parts = index_->parts();
  const MomentWeights weights(set, params_.correlation);

  // One scan alone may well seem to be of another building: all together decide that.
  GlobalLocalizer searcher = *this;
  searcher.params_.hypotheses.calibration.least_match_probability = 0.0;
  constexpr std::size_t kOfEachScan = 50;
  SearchOptions of_each = options;
  of_each.max_hypotheses = std::max(options.max_hypotheses, kOfEachScan);
  of_each.unite_valleys = false;  // another scan may tell where in it

  LocalizationResult result;
  std::vector<TPose2D> candidates;
  bool is_cut_short = false;
  for (const Place& place :
       searchOrder(set, weights, params_.least_hits, params_.most_searched_scans)) {
    const bool is_first = candidates.empty() && !result.certificate;
    if (options.time_budget_ms > 0.0) {
      const double left = options.time_budget_ms - 1e3 * watch.seconds();
      is_cut_short = is_cut_short || (left <= 0.0 && !is_first);
      if (is_cut_short) break;
      constexpr double kLeastBudget = 1e-6;  // 0 would be none
      of_each.time_budget_ms = std::max(left, kLeastBudget);
    }
    of_each.keep_regions = options.keep_regions && is_first;
    const Motion& from_now = set.fromNow(place.moment);
    LocalizationResult found = searcher.localize(set.moments()[place.moment].scans[place.scan],
                                                 carried(prior, from_now), of_each);
    is_cut_short = is_cut_short || !found.certificate || !found.certificate->isDecided();
    addSearch(result.statistics, found.statistics);
    if (is_first) {
      result.certificate = found.certificate;
      if (result.certificate) {
        result.certificate->moment = place.moment;
        result.certificate->scan = place.scan;
      }
      result.regions = std::move(found.regions);
    }
    std::vector<TPose2D> poses;
    const TPose2D way = inverse(from_now).pose_before_after;
    for (const Hypothesis& hypothesis : found.hypotheses) {
      poses.push_back(hypothesis.pose_map_robot + way);
    }
    unite(candidates, poses, params_.hypotheses);

    const Assessment all = rankCandidates(
        candidates, set, weights, parts.triangulation(), prior, parts.predictor(),
        {options.max_hypotheses, params_.cost, params_.refinement, params_.hypotheses}, budget);
    result.status = all.status;
    result.match_probability = all.match_probability;
    result.features = all.features;
    result.wheel_scale = all.wheel_scale;
    result.hypotheses = all.hypotheses;
    result.listed = all.listed;
    // A search of one scan alone may have left the right place out: only a clear answer is one.
    const double first_is_right =
        all.hypotheses.empty() ? 0.0 : all.match_probability * all.hypotheses.front().weight;
    if (first_is_right >= params_.sure_probability || budget.isSpent()) break;
  }
  is_cut_short = is_cut_short || budget.isSpent();
  if (result.status == LocalizationStatus::unique && is_cut_short) {
    result.status = LocalizationStatus::ambiguous;
  }
  result.statistics.refinement_ms = 1e3 * watch.seconds() - result.statistics.search_ms;
  return result;
}

}  // namespace mrpt_polyloc
