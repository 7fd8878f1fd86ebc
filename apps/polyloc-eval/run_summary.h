#pragma once

#include "EvaluationRun.h"

#include <nlohmann/json.hpp>

namespace mrpt_polyloc::apps {

/// The content of summary.json: for each data set and method, and for each method over all sets,
/// the figures of one set, intervals over stretches of the drives, and why scans were missed.
/// \param about of the run, as it is written
nlohmann::ordered_json summaryOf(const EvaluationRun& run, nlohmann::ordered_json about);

}  // namespace mrpt_polyloc::apps
