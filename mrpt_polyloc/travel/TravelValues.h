#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/ranking/Hypothesis.h>
#include <mrpt_polyloc/travel/ClearanceField.h>
#include <mrpt_polyloc/travel/PairEvidence.h>
#include <mrpt_polyloc/travel/TravelPlannerParams.h>

#include <mrpt/math/TPose2D.h>

#include <vector>

namespace mrpt_polyloc {

/// What a scan at a place is expected to tell about hypotheses.
class POLYLOC_EXPORT TravelValues {
 public:
  struct Value {
    double told = 0.0;  ///< share of the pairs, by weight, that is told apart
    mrpt::math::TPose2D pose;
    /// For each hypothesis the weight of those told from it, each by how well.
    std::vector<double> falls;
  };

  /// Keeps references to the predictor, the field and the hypotheses.
  TravelValues(const RangePredictor& predictor, const ClearanceField& field,
               const std::vector<Hypothesis>& hypotheses, const LaserModel& laser,
               const TravelPlannerParams& params);

  /// Whether there are two hypotheses to compare.
  bool hasPairs() const { return compared_.size() > 1; }

  /// At a place, with the heading of those tried that tells most: that of arriving, and, for a
  /// laser that does not see all around, three more.
  Value at(const TPoint2D& place, double heading) const;
  Value at(const mrpt::math::TPose2D& pose) const;

  /// Whether no hypothesis of some weight is left out of the comparison.
  bool comparesAll() const { return compares_all_; }

  bool seesAllAround() const { return sees_all_around_; }

 private:
  const ClearanceField* field_;
  const std::vector<Hypothesis>* hypotheses_;
  TravelPlannerParams params_;
  ReadingExpectation expectation_;
  PairEvidence evidence_;
  std::vector<std::size_t> compared_;  ///< of the hypotheses
  double all_pairs_ = 0.0;             ///< their products of weights, summed
  bool compares_all_ = true;
  bool sees_all_around_ = true;
};

}  // namespace mrpt_polyloc
