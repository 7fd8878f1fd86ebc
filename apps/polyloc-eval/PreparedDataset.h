#pragma once

#include "EvaluationList.h"
#include <mrpt_polyloc/geometry/OccupancyBitmap.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// A data set of a list, read or simulated.
struct PreparedDataset {
  PolygonMap map;
  EvaluationInputs inputs;
  std::vector<std::size_t> rows;  ///< those that are evaluated, rising
  double map_s = 0.0;             ///< wall time of reading and tracing the map
  std::string inputs_hash;        ///< of scans, truth and good rows

  /// What is kept of it beside the results: {statistics, simulated, good, stretches,
  /// tolerance_m, tolerance_deg, outline: {x, y, rings, open, beyond}}; a stretch for each of
  /// `rows`, the outline in centimetres from (x, y).
  nlohmann::ordered_json description(const DatasetEntry& entry, const Tolerance& tolerance) const;
  /// The grid that baselines search in: the map's own, or the polygons drawn into cells.
  OccupancyBitmap bitmap(const DatasetEntry& entry, double cell) const;
};

/// \throws FormatError, InvalidMapError
PreparedDataset prepareDataset(const Program& program, const DatasetEntry& entry,
                               const EvaluationOptions& options);

}  // namespace mrpt_polyloc::apps
