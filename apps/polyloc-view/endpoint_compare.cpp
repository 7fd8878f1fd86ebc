#include "endpoint_json.h"
#include "endpoints.h"
#include <mrpt_polyloc/localization/inspection/scan_comparison.h>

namespace mrpt_polyloc::apps {

Json answerCompare(const Services& services, const RequestField& request, Jobs::Ticket& ticket) {
  request.allowOnly({"pose", "ranges", "start_angle", "angle_step", "max_range", "min_range",
                     "bearings", "kinds", "sensor", "stamp", "label", "job"});
  const mrpt::math::TPose2D pose = readPose(request.member("pose"));
  const RangeScan scan = readScan(request);
  const MapIndex::Ptr index = services.session.index(ticket.cancelled());
  ticket.enter();
  const ScanComparison comparison = compareWithMap(*index, scan, pose);
  Json walls = Json::array(), open = Json::array();
  for (std::size_t i = 0; i < comparison.wall.size(); ++i) {
    walls.push_back(finiteOrNull(comparison.wall[i]));
    open.push_back(finiteOrNull(comparison.open[i]));
  }
  Json json = {{"wall", std::move(walls)},
               {"open", std::move(open)},
               {"cost", comparison.cost},
               {"mean_cost", comparison.mean_cost},
               {"polar", nullptr}};
  if (comparison.polar) {
    json["polar"] = {{"distance", comparison.polar->distance},
                     {"best_distance", comparison.polar->best_distance},
                     {"rotation", comparison.polar->rotation}};
  }
  return json;
}

}  // namespace mrpt_polyloc::apps
