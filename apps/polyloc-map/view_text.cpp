#include "view_text.h"

#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/visibility/ViewExpander.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <vector>

namespace mrpt_polyloc::apps {
namespace {

void appendPoint(std::string& text, const TPoint2D& point) {
  appendNumber(text, point.x);
  text += ' ';
  appendNumber(text, point.y);
}

}  // namespace

std::string viewText(const PolygonMap& map, const TPoint2D& viewpoint) {
  const Triangulation triangulation(map);
  if (!triangulation.isFree(viewpoint)) {
    std::string text = "--view: (";
    appendPoint(text, viewpoint);
    throw InvalidParamsError(text + ") lies outside the free space of the map");
  }
  ViewExpander expander(triangulation, true);
  const std::vector<TPoint2D> polygon =
      visibilityPolygon(triangulation, expander.expand(viewpoint));
  std::string text = "POLYGON ((";
  for (std::size_t i = 0; i <= polygon.size(); ++i) {
    if (i > 0) text += ", ";
    appendPoint(text, polygon[i % polygon.size()] - viewpoint);
  }
  return text + "))\n";
}

}  // namespace mrpt_polyloc::apps
