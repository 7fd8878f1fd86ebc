#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/ranking/hypotheses.h>
#include <mrpt_polyloc/localization/ranking/pose_covariance.h>
#include <mrpt_polyloc/localization/scan/BeamEvidence.h>
#include <mrpt_polyloc/localization/scan/BeamSectors.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mrpt_polyloc {
namespace {

bool isNear(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b,
            const HypothesisParams& params) {
  return std::hypot(a.x - b.x, a.y - b.y) < params.merge_distance &&
         angleBetween(a.phi, b.phi) < params.merge_angle;
}

/// By how much a map's cells are larger than usual ones, in quadrature [m]: with those, what walls
/// are off by is lost among the errors of lasers and poses, and in what was fitted on such maps.
double beyondUsualCells(double cell_size) {
  constexpr double kUsual = 0.05;  // [m]
  return std::sqrt(std::max(0.0, cell_size * cell_size - kUsual * kUsual));
}

/// By how many standard errors the evidence `other` falls behind `best`.
double zScore(const std::vector<float>& best, const std::vector<float>& other,
              const BeamSectors& sectors, double map_error) {
  const PairedDifference difference = sectors.difference(best, other);
  // The best is the best up to rounding.
  return std::max(0.0, difference.mean) / std::hypot(difference.standard_error, map_error);
}

}  // namespace

void HypothesisParams::check() const {
  requirePositive("merge_distance", merge_distance);
  requirePositive("merge_angle", merge_angle);
  requirePositive("indifference", indifference);
  requireNotNegative("cell_share", cell_share);
  requireNotNegative("tolerance_share", tolerance_share);
  requireNotNegative("position_share", position_share);
  requireNotNegative("heading_share", heading_share);
  requireNotNegative("cell_size", cell_size);
  evidence.check();
  calibration.check();
}

HypothesisParams HypothesisParams::of(const PolygonMap& map) const {
  HypothesisParams filled = *this;
  if (filled.cell_size == 0.0) filled.cell_size = map.cellSize();
  if (filled.evidence.tolerance == 0.0) {
    filled.evidence.tolerance = filled.tolerance_share * beyondUsualCells(filled.cell_size);
  }
  return filled;
}

double HypothesisParams::mapError() const {
  return std::hypot(indifference, cell_share * cell_size);
}

mrpt::math::CMatrixDouble33 HypothesisParams::withMapError(
    const mrpt::math::CMatrixDouble33& covariance) const {
  const double more = std::pow(beyondUsualCells(cell_size), 2);
  mrpt::math::CMatrixDouble33 widened = covariance;
  widened(0, 0) += position_share * position_share * more;
  widened(1, 1) += position_share * position_share * more;
  widened(2, 2) += heading_share * heading_share * more;
  return widened;
}

std::vector<ScoredPose> mergeNearPoses(std::vector<ScoredPose> poses,
                                       const HypothesisParams& params) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const ScoredPose& a, const ScoredPose& b) { return a.cost < b.cost; });
  std::vector<ScoredPose> merged;
  for (const ScoredPose& pose : poses) {
    const bool is_new = std::none_of(merged.begin(), merged.end(), [&](const ScoredPose& other) {
      return isNear(pose.refined.pose_map_beams, other.refined.pose_map_beams, params);
    });
    if (is_new) merged.push_back(pose);
  }
  return merged;
}

std::vector<Hypothesis> toHypotheses(const std::vector<ScoredPose>& poses, const RangeScan& scan,
                                     const ScanCost& cost, const HypothesisParams& params,
                                     std::vector<std::size_t>* order) {
  if (poses.empty()) return {};
  std::vector<std::vector<float>> evidence;
  std::vector<double> means;
  const BeamEvidence against(cost, params.evidence);
  for (const ScoredPose& pose : poses) {
    evidence.push_back(against.at(pose.refined.pose_map_beams));
    means.push_back(meanOf(evidence.back()));
  }
  const std::size_t best =
      static_cast<std::size_t>(std::min_element(means.begin(), means.end()) - means.begin());

  const BeamSectors sectors(cost.beams());
  std::vector<double> z_scores;
  for (const std::vector<float>& other : evidence) {
    z_scores.push_back(zScore(evidence[best], other, sectors, params.mapError()));
  }
  std::vector<std::size_t> ranks(poses.size());
  std::iota(ranks.begin(), ranks.end(), std::size_t{0});
  // By weight, so that a list cut short holds the likeliest; the first is the best by both.
  std::stable_sort(ranks.begin(), ranks.end(),
                   [&](std::size_t a, std::size_t b) { return z_scores[a] < z_scores[b]; });

  std::vector<Hypothesis> hypotheses;
  double sum = 0.0;
  for (const std::size_t i : ranks) {
    Hypothesis hypothesis;
    hypothesis.pose_map_robot = scan.robotFromBeamFrame(poses[i].refined.pose_map_beams);
    hypothesis.covariance = params.withMapError(
        covarianceOfRobot(poses[i].refined, scan, sectors.count(), params.calibration));
    hypothesis.cost = poses[i].cost;
    hypothesis.z_score = z_scores[i];
    hypothesis.weight = std::exp(-params.calibration.weight_decay * z_scores[i]);
    sum += hypothesis.weight;
    hypotheses.push_back(hypothesis);
  }
  for (Hypothesis& hypothesis : hypotheses) hypothesis.weight /= sum;
  if (order != nullptr) *order = ranks;
  return hypotheses;
}

}  // namespace mrpt_polyloc
