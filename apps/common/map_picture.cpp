#include "map_picture.h"

#include <mrpt_polyloc/base/number_text.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPose2D;

/// The maximal chains of edges of one kind.
std::vector<Polyline> chainsOfKind(const PolygonMap& map, EdgeKind kind) {
  std::vector<Polyline> chains;
  for (const Ring* ring : map.rings()) {
    bool running = false;
    for (std::size_t i = 0; i < ring->size(); ++i) {
      if (ring->kinds[i] == kind) {
        if (!running) chains.push_back({ring->vertices[i]});
        chains.back().push_back(ring->vertices[(i + 1) % ring->size()]);
      }
      running = ring->kinds[i] == kind;
    }
  }
  return chains;
}

TPoint2D along(const TPoint2D& from, double direction, double distance) {
  return {from.x + distance * std::cos(direction), from.y + distance * std::sin(direction)};
}

/// The curve of three standard deviations of the position.
Polyline ellipse(const Hypothesis& hypothesis) {
  constexpr int kCorners = 48;
  const double a = hypothesis.covariance(0, 0), b = hypothesis.covariance(0, 1),
               d = hypothesis.covariance(1, 1);
  const double mean = 0.5 * (a + d), spread = std::hypot(0.5 * (a - d), b);
  const double major = 3.0 * std::sqrt(std::max(0.0, mean + spread));
  const double minor = 3.0 * std::sqrt(std::max(0.0, mean - spread));
  const double turn = 0.5 * std::atan2(2.0 * b, a - d);
  const TPose2D& pose = hypothesis.pose_map_robot;
  Polyline curve;
  for (int i = 0; i <= kCorners; ++i) {
    const double t = 2.0 * M_PI * i / kCorners;
    curve.push_back(along(along({pose.x, pose.y}, turn, major * std::cos(t)), turn + M_PI / 2,
                          minor * std::sin(t)));
  }
  return curve;
}

/// An arrow from the robot's place along its heading.
void drawArrow(SvgCanvas& canvas, const TPose2D& pose, double length_px, const std::string& style) {
  const double px = canvas.metresPerPixel();
  const TPoint2D foot{pose.x, pose.y};
  const TPoint2D tip = along(foot, pose.phi, length_px * px);
  const double barb = 0.38 * length_px * px;
  const TPoint2D neck = along(tip, pose.phi + M_PI, 0.7 * barb);
  canvas.lines({{foot, neck}}, style);
  canvas.area({{tip, along(tip, pose.phi + M_PI - 0.45, barb), neck,
                along(tip, pose.phi + M_PI + 0.45, barb)}},
              style + "tip");
  canvas.dots({foot}, 0.16 * length_px, style + "tip");
}

std::string rankAndWeight(std::size_t rank, double weight) {
  if (weight < 0.0005) return std::to_string(rank) + ": <0.1 %";
  return formatted("%zu: %.*f %%", rank, weight < 0.0995 ? 1 : 0, 100.0 * weight);
}

}  // namespace

void drawMap(SvgCanvas& canvas, const PolygonMap& map) {
  std::vector<std::vector<TPoint2D>> rings;
  for (const Ring* ring : map.rings()) rings.push_back(ring->vertices);
  const std::vector<Polyline> open = chainsOfKind(map, EdgeKind::open);

  canvas.area(rings, "free");
  canvas.lines(map.wallsBeyond(), "beyond");
  canvas.lines(open, "open");
  canvas.lines(chainsOfKind(map, EdgeKind::wall), "wall");

  canvas.legend(SvgCanvas::Sample::line, "wall", "wall");
  if (!open.empty()) canvas.legend(SvgCanvas::Sample::line, "open", "open edge");
  if (!map.wallsBeyond().empty()) {
    canvas.legend(SvgCanvas::Sample::line, "beyond", "wall beyond");
  }
  canvas.legend(SvgCanvas::Sample::patch, "unknown", "unknown");
}

std::vector<TPoint2D> hitPoints(const RangeScan& scan, const TPose2D& pose_map_robot) {
  const TPose2D frame = scan.beamFrameFromRobot(pose_map_robot);
  std::vector<TPoint2D> hits;
  for (const Beam& beam : scan.beams()) {
    if (beam.kind != BeamKind::hit) continue;
    hits.push_back(along({frame.x, frame.y}, frame.phi + beam.bearing, beam.range));
  }
  return hits;
}

void drawScan(SvgCanvas& canvas, const RangeScan& scan, const TPose2D& pose_map_robot) {
  const TPose2D frame = scan.beamFrameFromRobot(pose_map_robot);
  const std::vector<TPoint2D> hits = hitPoints(scan, pose_map_robot);
  if (hits.empty()) return;
  std::vector<Polyline> beams;
  for (const TPoint2D& hit : hits) beams.push_back({{frame.x, frame.y}, hit});
  canvas.lines(beams, "beam");
  canvas.dots(hits, 2.4, "hit");
  canvas.legend(SvgCanvas::Sample::dot, "hit", "scan");
}

void drawFaintHits(SvgCanvas& canvas, const std::vector<TPoint2D>& hits) {
  constexpr std::size_t kMost = 30'000;  // more would tell no more, and make large files
  const std::size_t step = hits.size() / kMost + 1;
  std::vector<Polyline> points;  // as lines of no length with round ends: the shortest notation
  for (std::size_t i = 0; i < hits.size(); i += step) points.push_back({hits[i], hits[i]});
  canvas.lines(points, "faint");
}

void drawHypotheses(SvgCanvas& canvas, const std::vector<Hypothesis>& hypotheses) {
  if (hypotheses.empty()) return;
  constexpr std::size_t kLabelled = 5;                 // more would cover the map
  for (std::size_t i = hypotheses.size(); i-- > 0;) {  // the first last: on top
    const Hypothesis& hypothesis = hypotheses[i];
    const TPose2D& pose = hypothesis.pose_map_robot;
    const std::string style = i == 0 ? "best" : "rival";
    canvas.lines({ellipse(hypothesis)}, style);
    drawArrow(canvas, pose, i == 0 ? 44.0 : 26.0, style);
    if (i >= kLabelled) continue;
    // Behind the robot, where the label covers neither arrow nor most of the beams.
    const bool looks_right = std::cos(pose.phi) > 0.0;
    const double width_px = i == 0 ? 74.0 : 58.0;
    canvas.label({pose.x, pose.y}, looks_right ? -width_px - 8.0 : 10.0, i == 0 ? -26.0 : 10.0,
                 rankAndWeight(i + 1, hypothesis.weight), style + "label");
  }
  canvas.legend(SvgCanvas::Sample::line, "best", "best pose");
  if (hypotheses.size() > 1) canvas.legend(SvgCanvas::Sample::line, "rival", "rivals");
}

void drawPath(SvgCanvas& canvas, const std::vector<TPose2D>& poses) {
  if (poses.size() < 2) return;
  Polyline way;
  for (const TPose2D& pose : poses) way.push_back({pose.x, pose.y});
  canvas.lines({way}, "path");
  canvas.dots(way, 3.4, "stop");
  canvas.legend(SvgCanvas::Sample::line, "path", "scans before");
}

}  // namespace mrpt_polyloc::apps
