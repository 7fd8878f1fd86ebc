#pragma once

#include "EvaluationRun.h"

#include <nlohmann/json.hpp>

namespace mrpt_polyloc::apps {

/// What the report's page draws: the summary, scans as columns of whole numbers, outlines of the
/// maps, and pictures of chosen misses.
nlohmann::ordered_json pageData(const EvaluationRun& run, const nlohmann::ordered_json& summary);

}  // namespace mrpt_polyloc::apps
