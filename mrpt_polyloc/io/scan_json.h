#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <nlohmann/json_fwd.hpp>

namespace mrpt_polyloc {

/// A scan as scripts take it: {bearings, ranges, kinds, sensor: {x, y}, stamp, label}. Bearings in
/// the robot's frame [rad], 0 where nothing is known of a beam; ranges [m], null where nothing is
/// known; kinds: a character a beam, `h` hit, `n` no-return (its range is the maximum), `i`
/// invalid.
POLYLOC_EXPORT nlohmann::ordered_json toJson(const RangeScan& scan);

}  // namespace mrpt_polyloc
