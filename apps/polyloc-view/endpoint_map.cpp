#include "endpoint_json.h"
#include "endpoints.h"
#include <mrpt_polyloc/geometry/outline.h>
#include <mrpt_polyloc/io/result_json.h>

namespace mrpt_polyloc::apps {

Json answerMap(const Services& services, double tolerance) {
  const PolygonMap& map = services.session.map();
  const BoundingBox& box = map.boundingBox();
  const MapOutline outline = outlineOf(map, tolerance);
  return {{"name", services.session.name()},
          {"map_hash", hashText(services.session.hash())},
          {"bounds", {box.min.x, box.min.y, box.max.x, box.max.y}},
          {"area_m2", map.area()},
          {"vertices", map.vertexCount()},
          {"reflex_vertices", map.reflexVertexCount()},
          {"holes", map.holeCount()},
          {"components", map.components().size()},
          {"tolerance", tolerance},
          {"free", flatChains(outline.free)},
          {"walls", flatChains(outline.walls)},
          {"open", flatChains(outline.open)},
          {"beyond", flatChains(outline.beyond)}};
}

}  // namespace mrpt_polyloc::apps
