#include <mrpt_polyloc/localization/ranking/SetEvidence.h>

#include <cmath>
#include <utility>

namespace mrpt_polyloc {

SetEvidence::SetEvidence(const RangePredictor& predictor, const ScanSet& set,
                         const MomentWeights& weights, const RobustCostParams& cost,
                         const BeamEvidenceParams& evidence)
    : set_(&set), weights_(&weights) {
  for (const Moment& moment : set.moments()) {
    std::vector<ScanCost> costs;
    std::vector<Beam> beams;
    for (const RangeScan& scan : moment.scans) {
      costs.emplace_back(predictor, scan, cost);
      beams.insert(beams.end(), costs.back().beams().begin(), costs.back().beams().end());
    }
    evidence_.emplace_back();
    for (const ScanCost& of_scan : costs) evidence_.back().emplace_back(of_scan, evidence);
    costs_.push_back(std::move(costs));
    sectors_.emplace_back(beams);
  }
}

double SetEvidence::cost(std::size_t moment, const mrpt::math::TPose2D& pose_map_robot) const {
  double sum = 0.0;
  std::size_t beams = 0;
  for (std::size_t i = 0; i < costs_[moment].size(); ++i) {
    const ScanCost& cost = costs_[moment][i];
    const RangeScan& scan = set_->moments()[moment].scans[i];
    sum +=
        cost.mean(scan.beamFrameFromRobot(pose_map_robot)) * static_cast<double>(cost.beamCount());
    beams += cost.beamCount();
  }
  return beams > 0 ? sum / static_cast<double>(beams) : 0.0;
}

double SetEvidence::cost(const std::vector<mrpt::math::TPose2D>& way) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < way.size(); ++k) sum += weights_->weights[k] * cost(k, way[k]);
  return sum;
}

SetEvidence::Values SetEvidence::at(const std::vector<mrpt::math::TPose2D>& way) const {
  Values values(costs_.size());
  for (std::size_t k = 0; k < costs_.size(); ++k) {
    for (std::size_t i = 0; i < costs_[k].size(); ++i) {
      const std::vector<float> of_scan =
          evidence_[k][i].at(set_->moments()[k].scans[i].beamFrameFromRobot(way[k]));
      values[k].insert(values[k].end(), of_scan.begin(), of_scan.end());
    }
  }
  return values;
}

double SetEvidence::mean(const Values& values) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) sum += weights_->weights[k] * meanOf(values[k]);
  return sum;
}

PairedDifference SetEvidence::difference(const Values& a, const Values& b) const {
  std::vector<PairedDifference> of_moments;
  for (std::size_t k = 0; k < a.size(); ++k) {
    of_moments.push_back(sectors_[k].difference(a[k], b[k]));
  }
  PairedDifference result;
  double variance = 0.0;
  for (std::size_t k = 0; k < of_moments.size(); ++k) {
    const double weight = weights_->weights[k];
    result.mean += weight * of_moments[k].mean;
    for (std::size_t l = 0; l < of_moments.size(); ++l) {
      variance += weight * weights_->weights[l] * weights_->correlations[k][l] *
                  of_moments[k].standard_error * of_moments[l].standard_error;
    }
  }
  result.standard_error = std::sqrt(variance);
  return result;
}

PairedDifference SetEvidence::level(const Values& values) const {
  Values nothing;
  for (const std::vector<float>& of_moment : values) nothing.emplace_back(of_moment.size(), 0.0F);
  return difference(nothing, values);
}

double standardErrors(const PairedDifference& difference, double map_error) {
  return difference.mean / std::hypot(difference.standard_error, map_error);
}

}  // namespace mrpt_polyloc
