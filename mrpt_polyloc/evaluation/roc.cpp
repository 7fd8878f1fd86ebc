#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/roc.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_polyloc {
namespace {

void sortScores(std::vector<double>& scores, const char* name) {
  if (scores.empty()) throw InvalidParamsError(std::string(name) + ": no scores");
  for (const double score : scores) {
    if (std::isnan(score)) throw InvalidParamsError(std::string(name) + ": not a number");
  }
  std::sort(scores.begin(), scores.end());
}

/// Share of the sorted scores that lie below a threshold.
double shareBelow(const std::vector<double>& sorted, double threshold) {
  const auto below = std::lower_bound(sorted.begin(), sorted.end(), threshold) - sorted.begin();
  return static_cast<double>(below) / static_cast<double>(sorted.size());
}

}  // namespace

std::vector<RocPoint> rocCurve(std::vector<double> true_scores,
                               std::vector<double> foreign_scores) {
  sortScores(true_scores, "true_scores");
  sortScores(foreign_scores, "foreign_scores");
  std::vector<double> thresholds = true_scores;
  thresholds.insert(thresholds.end(), foreign_scores.begin(), foreign_scores.end());
  thresholds.push_back(std::numeric_limits<double>::infinity());
  std::sort(thresholds.begin(), thresholds.end());
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
  std::vector<RocPoint> curve;
  for (const double threshold : thresholds) {
    curve.push_back(
        {threshold, shareBelow(true_scores, threshold), shareBelow(foreign_scores, threshold)});
  }
  return curve;
}

double rocArea(const std::vector<RocPoint>& curve) {
  double area = 0.0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    area += (curve[i].lost - curve[i - 1].lost) * 0.5 * (curve[i].refused + curve[i - 1].refused);
  }
  return area;
}

RocPoint pointAtLoss(const std::vector<RocPoint>& curve, double share) {
  RocPoint point;
  for (const RocPoint& candidate : curve) {
    if (candidate.lost > share) break;
    point = candidate;
  }
  return point;
}

}  // namespace mrpt_polyloc
