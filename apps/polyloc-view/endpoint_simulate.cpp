#include "ApiError.h"
#include "endpoint_json.h"
#include "endpoints.h"
#include "search_answer.h"
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/io/scan_json.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <cmath>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPose2D;

RangeScan simulated(const MapSession& session, const LaserRequest& laser, const TPose2D& pose) {
  const bool is_changed = !laser.changes.discs.empty() || !laser.changes.moved.empty();
  return toRangeScan(is_changed ? simulateScan(WallSegments(session.map(), laser.changes),
                                               laser.laser, pose, laser.seed)
                                : simulateScan(session.walls(), laser.laser, pose, laser.seed));
}

/// What is seen of free space, in the robot's frame.
std::vector<TPoint2D> seenPolygon(const MapSession& session, const TPose2D& pose) {
  const Triangulation& triangulation = session.triangulation();
  if (!triangulation.isFree({pose.x, pose.y})) {
    throw ApiError(422, "not_free", "pose", "pose: outside the free space of the map");
  }
  ViewExpander expander(triangulation, true);
  std::vector<TPoint2D> polygon =
      visibilityPolygon(triangulation, expander.expand({pose.x, pose.y}));
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  for (TPoint2D& p : polygon) {
    const TPoint2D d(p.x - pose.x, p.y - pose.y);
    p = {c * d.x + s * d.y, c * d.y - s * d.x};
  }
  return polygon;
}

}  // namespace

Json answerSimulate(const Services& services, const RequestField& request, Jobs::Ticket& ticket) {
  request.allowOnly({"pose", "laser", "changes", "search", "job"});
  const TPose2D pose = readPose(request.member("pose"));
  const LaserRequest laser = readLaser(request);
  const auto search_field = request.find("search");
  if (search_field) search_field->allowOnly({"prior", "options"});
  const SearchRequest search = search_field ? readSearch(*search_field) : SearchRequest{};
  const bool is_exact = search.method == Method::exact;
  // Who waits for the index must not keep others from computing.
  if (search_field && !is_exact) services.session.index(ticket.cancelled());
  ticket.enter();
  const RangeScan scan = simulated(services.session, laser, pose);
  Json json = {{"scan", toJson(scan)}};
  if (search_field && is_exact) {
    const std::vector<TPoint2D> view = seenPolygon(services.session, pose);
    json["polygon"] = flatPoints(view);
    json["result"] = searchAnswer(services, view, search);
  } else if (search_field) {
    json["result"] = searchAnswer(services, ScanSet(scan), search, ticket);
  }
  return json;
}

}  // namespace mrpt_polyloc::apps
