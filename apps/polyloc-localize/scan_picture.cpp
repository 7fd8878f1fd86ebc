#include "scan_picture.h"

#include "../common/map_picture.h"

#include <algorithm>

namespace mrpt_polyloc::apps {
namespace {

/// The map and all best poses: a robot may stand outside the traced map.
BoundingBox viewOf(const PolygonMap& map, const std::vector<mrpt::math::TPose2D>& path) {
  BoundingBox view = map.boundingBox();
  for (const auto& pose : path) {
    view.min = {std::min(view.min.x, pose.x), std::min(view.min.y, pose.y)};
    view.max = {std::max(view.max.x, pose.x), std::max(view.max.y, pose.y)};
  }
  return view;
}

}  // namespace

std::string scanPicture(const PolygonMap& map, const std::vector<RangeScan>& scans,
                        const std::vector<LocalizedScan>& localized) {
  std::vector<mrpt::math::TPose2D> path;
  const LocalizedScan* last = nullptr;
  for (const LocalizedScan& scan : localized) {
    if (scan.result.hypotheses.empty()) continue;
    path.push_back(scan.result.hypotheses.front().pose_map_robot);
    last = &scan;
  }
  SvgCanvas canvas(viewOf(map, path));
  drawMap(canvas, map);
  if (last != nullptr) {
    drawScan(canvas, scans[last->row], path.back());
    drawPath(canvas, path);
    drawHypotheses(canvas, last->result.hypotheses);
  }
  return canvas.text();
}

}  // namespace mrpt_polyloc::apps
