#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/MapIndexParts.h>
#include <mrpt_polyloc/localization/MultiMapLocalizer.h>
#include <mrpt_polyloc/localization/ranking/SetEvidence.h>
#include <mrpt_polyloc/localization/ranking/WayFinder.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// A hypothesis of one of the maps, and what speaks against it.
struct Candidate {
  std::size_t map = 0;
  Hypothesis hypothesis;
  SetEvidence::Values evidence;
  double mean = 0.0;  ///< of the evidence [m]
};

void addMap(SearchStatistics& sum, const SearchStatistics& of_one) {
  sum.positions += of_one.positions;
  sum.evaluated += of_one.evaluated;
  sum.refined += of_one.refined;
  sum.search_ms += of_one.search_ms;
  sum.refinement_ms += of_one.refinement_ms;
}

}  // namespace

MultiMapLocalizer::MultiMapLocalizer(std::vector<GlobalLocalizer> localizers)
    : localizers_(std::move(localizers)) {
  if (localizers_.empty()) throw InvalidParamsError("maps: there is none");
}

MultiMapResult MultiMapLocalizer::localize(const ScanSet& set, const PosePrior& prior,
                                           const SearchOptions& options) const {
  MultiMapResult all;
  if (localizers_.size() == 1) {
    all.of_map.push_back(localizers_.front().localize(set, prior, options));
    all.result = all.of_map.front();
    all.maps.assign(all.result.hypotheses.size(), 0);
    return all;
  }
  HypothesisParams with = localizers_.front().params().hypotheses;
  double map_error = 0.0;  // of the worst map, as is the tolerance
  for (const GlobalLocalizer& localizer : localizers_) {
    const HypothesisParams& of_map = localizer.params().hypotheses;
    map_error = std::max(map_error, of_map.mapError());
    with.evidence.tolerance = std::max(with.evidence.tolerance, of_map.evidence.tolerance);
  }
  const MomentWeights weights(set, localizers_.front().params().correlation);
  // Rivals count even where they are not asked for.
  constexpr std::size_t kLeastRivals = 20;
  SearchOptions of_each = options;
  of_each.max_hypotheses = std::max(options.max_hypotheses, kLeastRivals);
  of_each.unite_valleys = false;
  std::vector<Candidate> candidates;
  bool is_cut_short = false, is_searched = false;
  for (std::size_t m = 0; m < localizers_.size(); ++m) {
    const GlobalLocalizer& localizer = localizers_[m];
    all.of_map.push_back(localizer.localize(set, prior, of_each));
    const LocalizationResult& found = all.of_map.back();
    addMap(all.result.statistics, found.statistics);
    is_searched = is_searched || found.status != LocalizationStatus::too_few_beams;
    is_cut_short = is_cut_short || (found.certificate && !found.certificate->isDecided());
    if (found.hypotheses.empty()) continue;
    const RangePredictor& predictor = localizer.index().parts().predictor();
    const SetEvidence evidence(predictor, set, weights, localizer.params().cost, with.evidence);
    const RankingParams ranking{of_each.max_hypotheses, localizer.params().cost,
                                localizer.params().refinement, with};
    const WayFinder finder(predictor, set, weights, evidence,
                           localizer.index().parts().triangulation(), prior, ranking);
    for (const Hypothesis& hypothesis : found.hypotheses) {
      std::vector<mrpt::math::TPose2D> way{hypothesis.pose_map_robot};
      if (set.moments().size() > 1) {
        const auto by_scans = finder.byScans(hypothesis.pose_map_robot);
        if (!by_scans) continue;
        way = finder.likeliest(*by_scans, found.wheel_scale, true).refined.poses;
      }
      Candidate candidate{m, hypothesis, evidence.at(way)};
      candidate.mean = evidence.mean(candidate.evidence);
      candidates.push_back(std::move(candidate));
    }
  }
  all.result.status =
      is_searched ? LocalizationStatus::no_match : LocalizationStatus::too_few_beams;
  if (candidates.empty()) return all;

  const auto best =
      std::min_element(candidates.begin(), candidates.end(),
                       [](const Candidate& a, const Candidate& b) { return a.mean < b.mean; });
  // Sectors and weights are of the scans alone: any map's predictor will do to compare.
  const SetEvidence comparison(localizers_.front().index().parts().predictor(), set, weights,
                               localizers_.front().params().cost, with.evidence);
  double sum = 0.0;
  for (Candidate& candidate : candidates) {
    Hypothesis& hypothesis = candidate.hypothesis;
    hypothesis.z_score = std::max(
        0.0, standardErrors(comparison.difference(best->evidence, candidate.evidence), map_error));
    hypothesis.weight = std::exp(-with.calibration.weight_decay * hypothesis.z_score);
    sum += hypothesis.weight;
  }
  std::vector<std::size_t> ranks(candidates.size());
  std::iota(ranks.begin(), ranks.end(), std::size_t{0});
  std::stable_sort(ranks.begin(), ranks.end(), [&](std::size_t a, std::size_t b) {
    return candidates[a].hypothesis.z_score < candidates[b].hypothesis.z_score;
  });
  for (const std::size_t i : ranks) {
    if (all.result.hypotheses.size() == options.max_hypotheses) break;
    candidates[i].hypothesis.weight /= sum;
    all.result.hypotheses.push_back(candidates[i].hypothesis);
    all.result.listed += candidates[i].hypothesis.weight;
    all.maps.push_back(candidates[i].map);
  }
  const LocalizationResult& of_first = all.of_map[all.maps.front()];
  all.result.match_probability = of_first.match_probability;
  all.result.features = of_first.features;
  const double first_is_right = all.result.match_probability * all.result.hypotheses.front().weight;
  const bool is_unique = first_is_right >= with.calibration.unique_probability && !is_cut_short;
  all.result.status = is_unique ? LocalizationStatus::unique : LocalizationStatus::ambiguous;
  return all;
}

}  // namespace mrpt_polyloc
