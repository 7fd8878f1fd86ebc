#pragma once

#include "../common/SvgCanvas.h"
#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/visibility/VisibilityCells.h>

#include <nlohmann/json.hpp>

#include <string>

namespace mrpt_polyloc::apps {

/// The visibility cells of a map, in a range [m], and what they took. \throws CellBudgetError
struct CellReport {
  CellReport(const PolygonMap& map, double range) : CellReport(map, range, Stopwatch()) {}

  VisibilityCells cells;
  double build_s;  ///< wall time

 private:
  CellReport(const PolygonMap& map, double range, const Stopwatch& watch)
      : cells(map, {VisibilityCellsParams{}.max_cells, range}), build_s(watch.seconds()) {}
};

/// {cells, windows, cell_build_s, cell_mb}.
nlohmann::ordered_json jsonReport(const CellReport& report);

/// The same, one a line.
std::string textReport(const CellReport& report);

/// The critical segments, as thin lines.
void drawCells(SvgCanvas& canvas, const CellReport& report);

}  // namespace mrpt_polyloc::apps
