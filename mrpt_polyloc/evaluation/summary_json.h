#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <mrpt/math/TPose2D.h>
#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// Figures of a map: vertices, reflex_vertices, holes, components (counts), area_m2, perimeter_m,
/// open_perimeter_m, walls_beyond_m. What summary.json holds under "map".
POLYLOC_EXPORT nlohmann::ordered_json mapStatistics(const PolygonMap& map);

/// What the search index of a map took.
struct POLYLOC_EXPORT IndexFigures {
  double build_s = 0.0;  ///< wall time, tracing of the map and all [s]
  double mb = 0.0;       ///< memory [10^6 bytes]
  /// Wall time from the program's start to the first answer [s], where there is one.
  std::optional<double> cold_start_s = std::nullopt;
};

/// What summary.json says of one set, but for its map.
POLYLOC_EXPORT nlohmann::ordered_json summaryObject(const Summary& all, const Summary* good,
                                                    const IndexFigures& index);

/// The text of summary.json, indented, with a final newline.
///
/// Figures that do not exist are null: all fractions and times if there are no scans,
/// `unique_right` if no scan was called unique, the median errors if no first answer was right.
/// \param good the summary over the good rows, null if there are none given: no key "good" then
POLYLOC_EXPORT std::string summaryJson(const Summary& all, const Summary* good,
                                       const IndexFigures& index, const PolygonMap& map);

/// One line of scans.csv.
struct POLYLOC_EXPORT ScanRecord {
  std::size_t row = 0;  ///< 0-based index of the scan in its file
  double stamp = 0.0;   ///< [s]
  mrpt::math::TPose2D truth{0, 0, 0};
  ScanScore score;
  std::optional<Hypothesis> answer;  ///< the first hypothesis, if there is one
  std::size_t hypotheses = 0;        ///< how many there were
};

/// The text of scans.csv, one line per scan under the header
/// `row,stamp,status,right_rank,hypotheses,error_m,error_deg,cost,x,y,phi_deg,truth_x,truth_y,`
/// `truth_phi_deg,ms`; fields that do not exist are empty. Headings in (-180, 180].
POLYLOC_EXPORT std::string scansCsv(const std::vector<ScanRecord>& records);

}  // namespace mrpt_polyloc
