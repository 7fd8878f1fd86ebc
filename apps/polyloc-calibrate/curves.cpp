#include "curves.h"

#include "../common/SvgCanvas.h"
#include <mrpt_polyloc/base/number_text.h>

#include <algorithm>
#include <functional>

namespace mrpt_polyloc::apps {
namespace {

constexpr const char* kFitted = "path";
constexpr const char* kCrossValidated = "best";

/// An empty chart of a square of percentages, with lines every `step`.
SvgCanvas chart(const BoundingBox& view, int step, const std::string& across,
                const std::string& up) {
  SvgCanvas canvas(view, "%");
  canvas.area({{view.min, {view.max.x, view.min.y}, view.max, {view.min.x, view.max.y}}}, "free");
  for (double x = view.min.x; x <= view.max.x; x += step) {
    canvas.lines({{{x, view.min.y}, {x, view.max.y}}}, "beyond");
    canvas.label({x, view.min.y}, 3, 5, std::to_string(static_cast<int>(x)) + " %", "note");
  }
  for (double y = view.min.y; y <= view.max.y; y += step) {
    canvas.lines({{{view.min.x, y}, {view.max.x, y}}}, "beyond");
    canvas.label({view.min.x, y}, 3, 18, std::to_string(static_cast<int>(y)) + " %", "note");
  }
  canvas.label({view.max.x, view.min.y}, -330, 24, across, "note");
  canvas.label({view.min.x, view.max.y}, 60, -20, up, "note");
  return canvas;
}

/// The curve as a step function, clipped to the view.
Polyline stepsOf(const std::vector<RocPoint>& curve, const BoundingBox& view) {
  Polyline steps;
  double refused = 0.0;
  const auto add = [&](double lost, double share) {
    if (100.0 * lost > view.max.x || 100.0 * share < view.min.y) return;
    steps.push_back({100.0 * lost, 100.0 * share});
  };
  for (const RocPoint& point : curve) {
    add(point.lost, refused);
    add(point.lost, point.refused);
    refused = point.refused;
  }
  return steps;
}

}  // namespace

std::string rocCsv(const RocCurves& curves) {
  std::string text = "kind,threshold,lost,refused\n";
  const auto add = [&](const char* kind, const std::vector<RocPoint>& curve) {
    for (const RocPoint& point : curve) {
      text += kind + formatted(",%.6g,%.6g,%.6g\n", point.threshold, point.lost, point.refused);
    }
  };
  add("fitted", curves.fitted);
  add("cross_validated", curves.cross_validated);
  return text;
}

std::string reliabilityCsv(const ReliabilityCurves& curves) {
  std::string text = "kind,from,to,count,stated,right\n";
  const auto add = [&](const char* kind, const std::vector<ReliabilityBin>& bins) {
    for (const ReliabilityBin& bin : bins) {
      text += kind + formatted(",%g,%g,%g", bin.from, bin.to, static_cast<double>(bin.count));
      text += bin.count == 0 ? ",," : formatted(",%.6g,%.6g", bin.stated, bin.true_share);
      text += "\n";
    }
  };
  add("fitted", curves.fitted);
  add("cross_validated", curves.cross_validated);
  return text;
}

std::string rocSvg(const RocCurves& curves) {
  const BoundingBox view{{0, 80}, {20, 100}};
  SvgCanvas canvas = chart(view, 5, "true scans lost", "scans of other buildings refused");
  canvas.lines({stepsOf(curves.fitted, view)}, kFitted);
  canvas.legend(SvgCanvas::Sample::line, kFitted, "fitted");
  if (!curves.cross_validated.empty()) {
    canvas.lines({stepsOf(curves.cross_validated, view)}, kCrossValidated);
    canvas.legend(SvgCanvas::Sample::line, kCrossValidated, "each map left out");
  }
  return canvas.text();
}

std::string reliabilitySvg(const ReliabilityCurves& curves) {
  SvgCanvas canvas = chart({{0, 0}, {100, 100}}, 20, "stated probability", "share that was right");
  canvas.lines({{{0, 0}, {100, 100}}}, "open");
  const auto draw = [&](const std::vector<ReliabilityBin>& bins, const char* style,
                        const char* dot) {
    Polyline curve;
    for (const ReliabilityBin& bin : bins) {
      if (bin.count > 0) curve.push_back({100.0 * bin.stated, 100.0 * bin.true_share});
    }
    canvas.lines({curve}, style);
    canvas.dots(curve, 5, dot);
  };
  draw(curves.fitted, kFitted, "stop");
  canvas.legend(SvgCanvas::Sample::line, "open", "as stated");
  canvas.legend(SvgCanvas::Sample::line, kFitted, "fitted");
  if (!curves.cross_validated.empty()) {
    draw(curves.cross_validated, kCrossValidated, "besttip");
    canvas.legend(SvgCanvas::Sample::line, kCrossValidated, "each map left out");
  }
  return canvas.text();
}

}  // namespace mrpt_polyloc::apps
