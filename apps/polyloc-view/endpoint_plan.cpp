#include "../polyloc-travel/DriveBelief.h"
#include "../polyloc-travel/next_waypoint.h"
#include "endpoints.h"
#include <mrpt_polyloc/io/result_json.h>

#include <nlohmann/json.hpp>

#include <utility>
#include <vector>

namespace mrpt_polyloc::apps {

Json answerPlan(const Services& services, const RequestField& request, Jobs::Ticket& ticket) {
  request.allowOnly({"looks", "robot", "prior", "max_range", "seed", "job"});
  std::vector<Look> looks;
  for (MovedScan& one : readMovedScans(request.member("looks"))) {
    looks.push_back({one.moved.value_or(mrpt::math::TPose2D(0, 0, 0)), std::move(one.scan)});
  }
  RobotRequest robot = readRobot(request);
  if (const auto range = request.find("max_range")) {
    robot.planner.max_range = range->number({0.01, 1e4});
  }
  NextWaypointParams params;
  params.odometry = robot.run.odometry;
  params.most_distance = robot.run.most_travel;
  params.prior = readSearch(request).prior;
  if (const auto seed = request.find("seed")) params.seed = seed->count(0, 1ULL << 53U);
  const MapIndex::Ptr index = services.session.index(ticket.cancelled());
  ticket.enter();
  Json json = nextWaypoint(*services.session.planner(index, robot.planner),
                           GlobalLocalizer(index, surerSearch()), looks, params);
  ticket.check();
  json["map_hash"] = hashText(services.session.hash());
  return json;
}

}  // namespace mrpt_polyloc::apps
