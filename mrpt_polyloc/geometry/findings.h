#pragma once

#include <mrpt_polyloc/geometry/validation.h>

#include <string>
#include <vector>

namespace mrpt_polyloc {

/// What validation has found and done so far; used by its parts only.
struct Findings {
  std::vector<Defect> defects;     ///< all
  std::vector<Defect> unrepaired;  ///< those that forbid to use the map
  std::vector<Repair> repairs;

  void repaired(const std::string& defect, const std::string& repair, const TPoint2D& where) {
    defects.push_back({defect, where});
    repairs.push_back({repair, where});
  }
  void refused(const std::string& defect, const TPoint2D& where) {
    defects.push_back({defect, where});
    unrepaired.push_back({defect, where});
  }
};

}  // namespace mrpt_polyloc
