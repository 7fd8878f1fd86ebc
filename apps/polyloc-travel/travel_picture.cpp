#include "travel_picture.h"

#include "../common/SvgCanvas.h"
#include "../common/map_picture.h"
#include "safe_set_outline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPose2D;

/// The safe set where the robot truly was.
void drawSafeSet(SvgCanvas& canvas, const SafeSet& safe, const TPose2D& truth, double square) {
  std::vector<std::vector<TPoint2D>> rings = safeSetOutline(safe, square);
  for (std::vector<TPoint2D>& ring : rings) {
    for (TPoint2D& corner : ring) corner = truth.composePoint(corner);
  }
  canvas.area(rings, "safe");
  canvas.legend(SvgCanvas::Sample::patch, "safe", "safe at the start");
}

void drawCross(SvgCanvas& canvas, const TPoint2D& at) {
  const double arm = 7.0 * canvas.metresPerPixel();
  canvas.lines({{{at.x - arm, at.y - arm}, {at.x + arm, at.y + arm}},
                {{at.x - arm, at.y + arm}, {at.x + arm, at.y - arm}}},
               "fallen");
}

/// Where each hypothesis has the robot, step by step; a cross where it fell.
void drawHypothesisWays(SvgCanvas& canvas, const TravelRunResult& run) {
  std::map<std::uint64_t, Polyline> ways;
  std::map<std::uint64_t, std::size_t> last_step;
  for (std::size_t step = 0; step < run.steps.size(); ++step) {
    const TravelStep& at = run.steps[step];
    for (const TrackedHypothesis& hypothesis : at.hypotheses) {
      const TPose2D& pose = hypothesis.pose_map_robot;
      if (std::hypot(pose.x - at.truth.x, pose.y - at.truth.y) < 0.5) continue;  // the robot itself
      ways[hypothesis.id].push_back({pose.x, pose.y});
      last_step[hypothesis.id] = step;
    }
  }
  std::vector<Polyline> lines;
  std::vector<TPoint2D> starts;
  for (const auto& [id, way] : ways) {
    lines.push_back(way);
    starts.push_back(way.front());
  }
  canvas.lines(lines, "rival");
  canvas.dots(starts, 4.0, "rivaltip");
  bool has_fallen = false;
  for (const auto& [id, way] : ways) {
    if (last_step[id] + 1 >= run.steps.size()) continue;
    has_fallen = true;
    drawCross(canvas, way.back());
  }
  if (!ways.empty()) canvas.legend(SvgCanvas::Sample::line, "rival", "hypothesis");
  if (has_fallen) canvas.legend(SvgCanvas::Sample::line, "fallen", "where it fell");
}

}  // namespace

std::string travelPicture(const TravelPlanner& planner, const World& world,
                          const TravelRunResult& run) {
  SvgCanvas canvas(world.map().boundingBox());
  drawMap(canvas, world.map());
  if (!run.steps.empty()) {
    const TravelStep& first = run.steps.front();
    TravelSituation situation;
    for (const TrackedHypothesis& tracked : first.hypotheses) {
      situation.hypotheses.push_back(tracked.toHypothesis());
    }
    situation.scans = {{run.first_scan, {0, 0, 0}}};
    if (run.is_ambiguous_at_start) {
      drawSafeSet(canvas, planner.safeSet(situation), first.truth, planner.params().safe.square);
    }
  }
  canvas.lines(world.boxes(), "wall");
  drawHypothesisWays(canvas, run);
  canvas.lines({run.way}, "path");
  std::vector<TPoint2D> stops;
  for (const TravelStep& step : run.steps) stops.push_back({step.truth.x, step.truth.y});
  canvas.dots(stops, 4.0, "stop");
  canvas.dots({{run.start.x, run.start.y}}, 8.0, "besttip");
  canvas.legend(SvgCanvas::Sample::line, "path", "robot, with its scans");
  canvas.legend(SvgCanvas::Sample::dot, "besttip", "start");
  return canvas.text();
}

}  // namespace mrpt_polyloc::apps
