#include "ApiError.h"
#include "endpoint_json.h"
#include "endpoints.h"
#include <mrpt_polyloc/visibility/VisibilitySkeleton.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <cmath>
#include <optional>

namespace mrpt_polyloc::apps {
namespace {

constexpr double kFlat = 1e-6;  ///< [m], as the exact methods take it

/// The skeleton of a view; none from where two vertices are in line, which belongs to no cell.
std::optional<VisibilitySkeleton> skeletonAt(const Triangulation& triangulation, const View& view) {
  try {
    return skeletonOf(triangulation, view, kFlat);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

}  // namespace

Json answerView(const Services& services, const RequestField& request, Jobs::Ticket& ticket) {
  request.allowOnly({"x", "y", "job"});
  const TPoint2D point = readPoint(request);
  ticket.enter();
  const Triangulation& triangulation = services.session.triangulation();
  if (!triangulation.isFree(point)) {
    throw ApiError(422, "not_free", "", "the point lies outside the free space of the map");
  }
  ViewExpander expander(triangulation, true);
  const View& view = expander.expand(point);
  Json json = {{"polygon", flatPoints(visibilityPolygon(triangulation, view))},
               {"skeleton", nullptr}};
  if (const auto skeleton = skeletonAt(triangulation, view)) {
    std::vector<TPoint2D> vertices;
    Json edges = Json::array();
    for (const VisibilitySkeleton::Gap& gap : skeleton->gaps()) {
      vertices.push_back(gap.vertex);
      edges.push_back({{"line", flatPoints(std::vector<TPoint2D>{gap.a, gap.b})},
                       {"begins", gap.begins},
                       {"ends", gap.ends}});
    }
    json["skeleton"] = {{"vertices", flatPoints(vertices)}, {"edges", std::move(edges)}};
  }
  return json;
}

}  // namespace mrpt_polyloc::apps
