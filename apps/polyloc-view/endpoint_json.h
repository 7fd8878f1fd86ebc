#pragma once

#include <mrpt/math/TPoint2D.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <vector>

namespace mrpt_polyloc::apps {

/// Points as [x, y, x, y, ...], rounded to 0.1 mm: half the text of pairs.
template <class Points>
nlohmann::ordered_json flatPoints(const Points& points) {
  constexpr double kSteps = 1e4;
  nlohmann::ordered_json flat = nlohmann::ordered_json::array();
  for (const mrpt::math::TPoint2D& p : points) {
    flat.push_back(std::round(p.x * kSteps) / kSteps);
    flat.push_back(std::round(p.y * kSteps) / kSteps);
  }
  return flat;
}

/// The same of many chains.
inline nlohmann::ordered_json flatChains(
    const std::vector<std::vector<mrpt::math::TPoint2D>>& chains) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& chain : chains) list.push_back(flatPoints(chain));
  return list;
}

/// A number that may be infinite, which JSON has not: null then.
inline nlohmann::ordered_json finiteOrNull(double x) {
  return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
}

}  // namespace mrpt_polyloc::apps
