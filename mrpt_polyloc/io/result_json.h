#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/ranking/Hypothesis.h>

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <string>

namespace mrpt_polyloc {

/// {x, y, phi, weight, cost, covariance: 3 x 3} [m, rad].
POLYLOC_EXPORT nlohmann::ordered_json toJson(const Hypothesis& hypothesis);

/// {status, match, listed, hypotheses, certificate, statistics}: certificate {cost, complete,
/// regions, least, at_least, and what became of them (SettledRegions)} or null; statistics
/// {evaluated, refined, search_ms, refinement_ms}. If regions were kept also `regions`, the
/// `most_regions` of least bound: {polygon: [[x, y], ...], first_heading, last_heading, bound}.
POLYLOC_EXPORT nlohmann::ordered_json toJson(const LocalizationResult& result,
                                             std::size_t most_regions = 5000);

/// A map's hash as 16 hexadecimal digits: a JSON number cannot hold 64 bits everywhere.
POLYLOC_EXPORT std::string hashText(std::uint64_t hash);

}  // namespace mrpt_polyloc
