#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/MapIndexParts.h>
#include <mrpt_polyloc/travel/TravelPlanner.h>
#include <mrpt_polyloc/travel/TravelPlanning.h>

#include <algorithm>
#include <utility>

namespace mrpt_polyloc {

TravelPlanner::TravelPlanner(MapIndex::Ptr index, TravelPlannerParams params)
    : index_(index != nullptr ? std::move(index)
                              : throw InvalidParamsError("TravelPlanner: there is no index")),
      params_((params.check(), params)),
      field_(index_->map(), params.safe.robot_radius + params.safe.margin +
                                params.safe.most_uncertainty + params.safe.comfort +
                                ClearanceField::kSquare) {
  params_.evidence = params_.evidence.of(index_->map());
  index_->parts().predictor();
}

TravelPlan TravelPlanner::plan(const TravelSituation& situation) const {
  if (situation.scans.empty()) throw InvalidParamsError("TravelSituation: there is no scan");
  const Stopwatch watch;
  const RangePredictor& predictor = index_->parts().predictor();
  TravelPlan plan = TravelPlanning(situation, params_, field_, predictor).run();
  if (plan.status != TravelStatus::decided && !(plan.value > 0.0)) {
    // Doubts of some centimetres must not close a door for good.
    TravelPlannerParams bold = params_;
    bold.safe.most_uncertainty = 0.0;
    TravelPlan other = TravelPlanning(situation, bold, field_, predictor).run();
    if (other.value > 0.0 || plan.status == TravelStatus::blocked) plan = std::move(other);
  }
  plan.planning_ms = 1e3 * watch.seconds();
  return plan;
}

TravelPlan TravelPlanner::explore(const TravelSituation& situation) const {
  if (situation.scans.empty()) throw InvalidParamsError("TravelSituation: there is no scan");
  const Stopwatch watch;
  TravelPlan plan =
      TravelPlanning(situation, params_, field_, index_->parts().predictor()).explore();
  plan.planning_ms = 1e3 * watch.seconds();
  return plan;
}

SafeSet TravelPlanner::safeSet(const TravelSituation& situation) const {
  const Sight sight(situation.scans, ownRadius(params_));
  SafeSetParams safe = params_.safe;
  safe.reach = std::max(safe.square, std::min(safe.reach, situation.most_distance));
  return SafeSet(field_, situation.hypotheses, sight, safe);
}

}  // namespace mrpt_polyloc
