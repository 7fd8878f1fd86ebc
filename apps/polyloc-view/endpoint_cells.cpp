#include "endpoint_json.h"
#include "endpoints.h"

namespace mrpt_polyloc::apps {

Json answerCells(const Services& services, Jobs::Ticket& ticket) {
  ticket.enter();
  const VisibilityCells& cells = services.session.cells();
  const std::vector<TPoint2D>& vertices = cells.triangulation().vertices();
  Json polygons = Json::array(), segments = Json::array();
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    polygons.push_back(flatPoints(cells.polygon(cell)));
  }
  for (const CriticalSegment& segment : cells.criticalSegments().segments) {
    const TPoint2D from = vertices[static_cast<std::size_t>(segment.blocker)];
    segments.push_back(flatPoints(std::vector<TPoint2D>{from, endOf(segment, vertices)}));
  }
  return {{"range", finiteOrNull(cells.range())},
          {"count", cells.size()},
          {"cells", std::move(polygons)},
          {"segments", std::move(segments)}};
}

}  // namespace mrpt_polyloc::apps
