#include "ApiError.h"
#include "DriveStore.h"
#include "endpoints.h"

#include <memory>
#include <string>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

/// What a drive depends on: equal requests give equal texts.
std::string keyOf(const RequestField& request) {
  std::string key;
  for (const char* name : {"pose", "laser", "changes", "prior", "robot"}) {
    const auto field = request.find(name);
    key += field ? field->asJson() : "";
    key += '\n';
  }
  return key;
}

}  // namespace

Json answerTravel(const Services& services, const RequestField& request, Jobs::Ticket& ticket) {
  request.allowOnly({"pose", "laser", "changes", "prior", "robot", "step", "job"});
  const mrpt::math::TPose2D start = readPose(request.member("pose"));
  const LaserRequest laser = readLaser(request);
  if (laser.laser.beams > kMostDrivenBeams) {
    request.member("laser").member("beams").fail("of a robot that drives at most " +
                                                 std::to_string(kMostDrivenBeams));
  }
  RobotRequest robot = readRobot(request);
  robot.planner.max_range = laser.laser.max_range;  // the robot knows its laser
  robot.run.prior = readSearch(request).prior;
  const auto step_field = request.find("step");
  const std::size_t step = step_field ? step_field->count(0, robot.run.most_scans) : 0;
  const MapIndex::Ptr index = services.session.index(ticket.cancelled());
  ticket.enter();
  const std::shared_ptr<Drive> drive = services.drives.get(keyOf(request), [&] {
    const double radius = robot.planner.safe.robot_radius;
    World world(services.session.map(), laser.laser, laser.changes, radius);
    const std::string why = world.whyNoRoom({start.x, start.y}, radius);
    if (!why.empty()) throw ApiError(422, "not_free", "pose", "pose: " + why);
    return std::make_shared<Drive>(services.session.planner(index, robot.planner),
                                   GlobalLocalizer(index, surerSearch()), std::move(world), start,
                                   robot.run, laser.seed);
  });
  return drive->step(step, ticket.cancelled());
}

}  // namespace mrpt_polyloc::apps
