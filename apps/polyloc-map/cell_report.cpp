#include "cell_report.h"

#include <mrpt_polyloc/base/number_text.h>

#include <vector>

namespace mrpt_polyloc::apps {
namespace {

double megabytes(const CellReport& report) {
  return static_cast<double>(report.cells.memory()) * 1e-6;
}

}  // namespace

nlohmann::ordered_json jsonReport(const CellReport& report) {
  return {{"cells", report.cells.size()},
          {"windows", report.cells.criticalSegments().segments.size()},
          {"cell_build_s", report.build_s},
          {"cell_mb", megabytes(report)}};
}

std::string textReport(const CellReport& report) {
  return formatted(
      "cells         %zu, from %zu windows\n"
      "cells took    %.3f s, keep %.2f MB\n",
      report.cells.size(), report.cells.criticalSegments().segments.size(), report.build_s,
      megabytes(report));
}

void drawCells(SvgCanvas& canvas, const CellReport& report) {
  const std::vector<TPoint2D>& vertices = report.cells.triangulation().vertices();
  std::vector<Polyline> lines;
  for (const CriticalSegment& segment : report.cells.criticalSegments().segments) {
    lines.push_back(
        {vertices[static_cast<std::size_t>(segment.blocker)], endOf(segment, vertices)});
  }
  canvas.lines(lines, "beam");
  canvas.legend(SvgCanvas::Sample::line, "beam", "critical segment");
}

}  // namespace mrpt_polyloc::apps
