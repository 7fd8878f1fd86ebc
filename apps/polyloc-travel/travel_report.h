#pragma once

#include "TravelRun.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// What is kept of a run.
struct TravelRecord {
  std::string map;  ///< as it was named
  mrpt::math::TPose2D start;
  TravelOutcome outcome = TravelOutcome::gave_up;
  bool is_ambiguous_at_start = false;
  bool is_rightly_indistinguishable = false;  ///< see isTrulyIndistinguishable()
  std::size_t hypotheses_at_start = 0;
  double travelled = 0.0;
  std::size_t scans = 0;
  std::size_t collisions = 0;
  double error_m = 0.0, error_rad = 0.0;
  std::optional<double> tour_m;  ///< see shortestTour()
  std::vector<double> planning_ms;
};

TravelRecord recordOf(const TravelRunResult& run, const std::string& map);

/// The counts and percentiles of design: summary.json.
nlohmann::ordered_json travelSummary(const std::vector<TravelRecord>& records);

/// One row a run.
std::string runsCsv(const std::vector<TravelRecord>& records);

}  // namespace mrpt_polyloc::apps
