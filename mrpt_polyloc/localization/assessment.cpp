#include <mrpt_polyloc/localization/assessment.h>

#include <algorithm>

namespace mrpt_polyloc {

void assess(const std::vector<RankedPose>& poses, const RangeScan& scan, const ScanCost& cost,
            const HypothesisParams& params, std::size_t max_hypotheses,
            LocalizationResult& result) {
  result.hypotheses.clear();
  if (poses.empty() || poses.front().cost > params.no_match_cost) {
    result.status = LocalizationStatus::no_match;
    return;
  }
  result.status =
      isUnique(poses, cost, params) ? LocalizationStatus::unique : LocalizationStatus::ambiguous;
  const auto count = static_cast<std::ptrdiff_t>(std::min(poses.size(), max_hypotheses));
  result.hypotheses = toHypotheses({poses.begin(), poses.begin() + count}, scan, params);
}

}  // namespace mrpt_polyloc
