#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/geometry/validation.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// {valid, defects, repairs, vertices, ...}: `valid` says whether the file holds no defect.
nlohmann::ordered_json jsonReport(const RepairedMap& loaded);

/// {valid: false, defects, repairs: []} of a map that could not be repaired.
nlohmann::ordered_json jsonReport(const std::vector<Defect>& defects);

/// All defects of a polygon file; none for a grid.
std::vector<Defect> defectsOfFile(const std::string& path);

/// `defect: WHAT at (X, Y)` a line.
std::string defectList(const std::vector<Defect>& defects);

/// Sizes of the map, one a line.
std::string textReport(const PolygonMap& map);

}  // namespace mrpt_polyloc::apps
