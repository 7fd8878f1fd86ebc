#include "scan_picture.h"

#include "../common/map_picture.h"

#include <algorithm>

namespace mrpt_polyloc::apps {
namespace {

/// The map and these points, but a stray reading far outside must not shrink the map: at most a
/// fifth of its size is added on each side.
BoundingBox viewOf(const PolygonMap& map, const std::vector<TPoint2D>& points) {
  BoundingBox view = map.boundingBox();
  const double most = 0.2 * std::max(view.width(), view.height());
  const BoundingBox limit{{view.min.x - most, view.min.y - most},
                          {view.max.x + most, view.max.y + most}};
  for (const TPoint2D& point : points) {
    view.include({std::clamp(point.x, limit.min.x, limit.max.x),
                  std::clamp(point.y, limit.min.y, limit.max.y)});
  }
  return view;
}

}  // namespace

std::string scanPicture(const PolygonMap& map, const std::vector<RangeScan>& scans,
                        const std::vector<LocalizedScan>& localized) {
  std::vector<mrpt::math::TPose2D> path;
  std::vector<TPoint2D> hits;  // of all scans but the last
  std::vector<TPoint2D> seen;  // from the last
  const LocalizedScan* last = nullptr;
  for (const LocalizedScan& scan : localized) {
    if (scan.result.hypotheses.empty()) continue;
    hits.insert(hits.end(), seen.begin(), seen.end());
    path.push_back(scan.result.hypotheses.front().pose_map_robot);
    seen = hitPoints(scans[scan.row], path.back());
    last = &scan;
  }
  std::vector<TPoint2D> shown = seen;
  for (const auto& pose : path) shown.push_back({pose.x, pose.y});
  SvgCanvas canvas(viewOf(map, shown));
  drawMap(canvas, map);
  if (last != nullptr) {
    drawFaintHits(canvas, hits);
    drawScan(canvas, scans[last->row], path.back());
    drawPath(canvas, path);
    drawHypotheses(canvas, last->result.hypotheses);
  }
  return canvas.text();
}

}  // namespace mrpt_polyloc::apps
