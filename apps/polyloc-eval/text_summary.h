#pragma once

#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/evaluation/summary_json.h>

#include <optional>
#include <string>

namespace mrpt_polyloc::apps {

/// The summaries as a table for people: a column for all rows and, if given, one for the good ones.
std::string textSummary(const Summary& all, const std::optional<Summary>& good,
                        const IndexFigures& index);

}  // namespace mrpt_polyloc::apps
