#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/travel/TravelPlannerParams.h>

namespace mrpt_polyloc {

const char* toString(TravelStrategy strategy) {
  switch (strategy) {
    case TravelStrategy::greedy:
      return "greedy";
    case TravelStrategy::nearest:
      return "nearest";
    case TravelStrategy::majority:
      return "majority";
    case TravelStrategy::random:
      break;
  }
  return "random";
}

std::optional<TravelStrategy> travelStrategyFrom(const std::string& name) {
  for (const TravelStrategy strategy : {TravelStrategy::greedy, TravelStrategy::nearest,
                                        TravelStrategy::majority, TravelStrategy::random}) {
    if (name == toString(strategy)) return strategy;
  }
  return std::nullopt;
}

void TravelPlannerParams::check() const {
  safe.check();
  readings.check();
  evidence.check();
  requireInRange("most_beams", static_cast<double>(most_beams), 1.0, 1e5);
  requireNotNegative("max_range", max_range);
  requireInRange("most_places", static_cast<double>(most_places), 1.0, 1e6);
  requireInRange("most_hypotheses", static_cast<double>(most_hypotheses), 2.0, 1e4);
  requireInRange("least_weight", least_weight, 0.0, 1.0);
  requireInRange("least_telling", least_telling, 1e-6, 1.0);
  requirePositive("stop_cost", stop_cost);
  requirePositive("longest_leg", longest_leg);
  requirePositive("longest_tight_leg", longest_tight_leg);
  requirePositive("most_turn", most_turn);
  requirePositive("dense_spacing", dense_spacing);
  requireInRange("most_dense_places", static_cast<double>(most_dense_places), 1.0, 1e7);
}

}  // namespace mrpt_polyloc
