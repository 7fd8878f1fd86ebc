#include "fixed_room.h"

#include "fuzz_target.h"
#include <mrpt_polyloc/geometry/validation.h>
#include <mrpt_polyloc/io/wkt.h>

#include <cmath>
#include <sstream>

namespace mrpt_polyloc::fuzz {

namespace {

MapIndexParams smallIndex() {
  MapIndexParams params;
  params.threads = 1;
  return params;
}

}  // namespace

PolygonMap fixedRoom() {
  static const PolygonMap room =
      repairMap(parseWkt("POLYGON ((0 0, 4 0, 4 2, 2 2, 2 4, 0 4))", "room")).map;
  return room;
}

const RangeScan& fixedScan() {
  static const RangeScan scan = [] {
    constexpr double kHeading = 1.0, kTurn = 6.283185307179586;
    const double sides[] = {-1.0, 3.0};  // the room's walls, seen from (1, 1), but for its corner
    std::vector<Beam> beams;
    for (int i = 0; i < 36; ++i) {
      const double bearing = kTurn * i / 36.0;
      const double c = std::cos(kHeading + bearing), s = std::sin(kHeading + bearing);
      double range = 1e9;
      for (const double side : sides) {
        if (side / c > 0.0) range = std::min(range, side / c);
        if (side / s > 0.0) range = std::min(range, side / s);
      }
      // The corner at (2, 2) takes away the square beyond it.
      if (range * c > 1.0 && range * s > 1.0) range = std::max(1.0 / c, 1.0 / s);
      beams.push_back({bearing, range, BeamKind::hit});
    }
    return RangeScan(std::move(beams));
  }();
  return scan;
}

std::string fixedIndex() {
  std::ostringstream out(std::ios::binary);
  MapIndex::build(fixedRoom(), smallIndex())->save(out);
  return out.str();
}

void askOnce(const GlobalLocalizer& localizer, const RangeScan& scan) {
  SearchOptions options;
  const LocalizationResult result = localizer.localize(scan, {}, options);
  must(result.match_probability >= 0.0 && result.match_probability <= 1.0,
       "the match is a probability");
  double sum = 0.0;
  for (const Hypothesis& hypothesis : result.hypotheses) {
    const auto& pose = hypothesis.pose_map_robot;
    must(std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.phi),
         "a pose is finite");
    must(hypothesis.weight >= 0.0 && std::isfinite(hypothesis.cost), "its weight and cost are");
    sum += hypothesis.weight;
  }
  must(sum <= 1.0 + 1e-9, "weights are of one posterior");
}

}  // namespace mrpt_polyloc::fuzz
