#pragma once

#include "replay_statistics.h"
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <string>

namespace mrpt_polyloc::replay {

/// A page by itself, without scripts or references: what summary.json says for people, the way of
/// one run in the map beside the truth, and the particles at each step that kept them.
std::string replayReport(const PolygonMap& map, const RunRecord& run, const Truth& truth,
                         const std::string& summary_text);

}  // namespace mrpt_polyloc::replay
