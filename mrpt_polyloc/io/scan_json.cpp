#include <mrpt_polyloc/io/scan_json.h>

#include <nlohmann/json.hpp>

#include <string>
#include <utility>

namespace mrpt_polyloc {

using nlohmann::ordered_json;

ordered_json toJson(const RangeScan& scan) {
  ordered_json bearings = ordered_json::array(), ranges = ordered_json::array();
  std::string kinds;
  for (const Beam& beam : scan.beams()) {
    const bool says_something = beam.kind != BeamKind::invalid;
    bearings.push_back(beam.bearing);
    ranges.push_back(says_something ? ordered_json(beam.range) : ordered_json(nullptr));
    kinds += beam.kind == BeamKind::hit ? 'h' : says_something ? 'n' : 'i';
  }
  return {{"bearings", std::move(bearings)},
          {"ranges", std::move(ranges)},
          {"kinds", std::move(kinds)},
          {"sensor", {{"x", scan.sensor().x}, {"y", scan.sensor().y}}},
          {"stamp", scan.stamp()},
          {"label", scan.label()}};
}

}  // namespace mrpt_polyloc
