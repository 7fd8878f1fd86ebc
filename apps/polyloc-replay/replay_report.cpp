#include "replay_report.h"

#include "../common/SvgCanvas.h"
#include "../common/map_picture.h"
#include <mrpt_polyloc/base/number_text.h>

#include <vector>

namespace mrpt_polyloc::replay {
namespace {

using apps::SvgCanvas;

TPoint2D placeOf(const mrpt::math::TPose2D& pose) {
  return {pose.x, pose.y};
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
  return safe;
}

/// The true way through the steps of the run, in one chain.
void drawTruth(SvgCanvas& canvas, const RunRecord& run, const Truth& truth) {
  Polyline way;
  for (const StepRecord& step : run.steps) {
    if (step.step < truth.size() && truth[step.step]) way.push_back(placeOf(*truth[step.step]));
  }
  if (way.size() < 2) return;
  canvas.lines({way}, "truth");
  canvas.legend(SvgCanvas::Sample::line, "truth", "truth");
}

std::string wayPicture(const PolygonMap& map, const RunRecord& run, const Truth& truth) {
  SvgCanvas canvas(map.boundingBox());
  drawMap(canvas, map);
  std::vector<Polyline> way(1);
  for (std::size_t k = 0; k < run.steps.size(); ++k) {
    // Where the robot was carried there is no way.
    if (k > 0 && run.steps[k].step != run.steps[k - 1].step + 1) way.emplace_back();
    way.back().push_back(placeOf(run.steps[k].estimate));
  }
  canvas.lines(way, "path");
  canvas.legend(SvgCanvas::Sample::line, "path", "mean of the particles");
  drawTruth(canvas, run, truth);
  return canvas.text();
}

std::string cloudPicture(const PolygonMap& map, const StepRecord& step, const Truth& truth) {
  SvgCanvas canvas(map.boundingBox());
  drawMap(canvas, map);
  std::vector<Polyline> particles;  // as lines of no length with round ends
  constexpr std::size_t kMost = 10'000;
  const std::size_t every = step.cloud.size() / kMost + 1;
  for (std::size_t i = 0; i < step.cloud.size(); i += every) {
    particles.push_back({placeOf(step.cloud[i]), placeOf(step.cloud[i])});
  }
  canvas.lines(particles, "particle");
  canvas.legend(SvgCanvas::Sample::line, "particle", "particles");
  canvas.dots({placeOf(step.estimate)}, 5.0, "stop");
  canvas.legend(SvgCanvas::Sample::dot, "stop", "their mean");
  if (step.step < truth.size() && truth[step.step]) {
    const TPoint2D at = placeOf(*truth[step.step]);
    const double r = 12.0 * canvas.metresPerPixel();
    canvas.lines({{{at.x - r, at.y}, {at.x + r, at.y}}, {{at.x, at.y - r}, {at.x, at.y + r}}},
                 "truth");
    canvas.legend(SvgCanvas::Sample::line, "truth", "truth");
  }
  return canvas.text();
}

std::string caption(const StepRecord& step, const Truth& truth) {
  std::string line = formatted("Step %zu: %zu particles, mean (%.2f, %.2f)", step.step,
                               step.cloud.size(), step.estimate.x, step.estimate.y);
  if (const auto error = errorOf(step, truth)) line += formatted(", off by %.2f m", error->m);
  return line;
}

}  // namespace

std::string replayReport(const PolygonMap& map, const RunRecord& run, const Truth& truth,
                         const std::string& summary_text) {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<title>polyloc-replay</title>\n<style>\n"
      "body{font-family:DejaVu Sans,Arial,sans-serif;color:#1b2430;max-width:1240px;margin:1em "
      "auto}\nsvg{width:100%;height:auto}\n</style>\n</head>\n<body>\n<h1>polyloc-replay</h1>\n"
      "<pre>" +
      escaped(summary_text) + "</pre>\n<h2>Way of the run with seed " + std::to_string(run.seed) +
      "</h2>\n" + wayPicture(map, run, truth);
  for (const StepRecord& step : run.steps) {
    if (step.cloud.empty()) continue;
    page += "<h2>" + caption(step, truth) + "</h2>\n" + cloudPicture(map, step, truth);
  }
  return page + "</body>\n</html>\n";
}

}  // namespace mrpt_polyloc::replay
