#pragma once

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/polar/PolarFunction.h>

#include <algorithm>
#include <cmath>
#include <tests/support/star_polygons.h>
#include <vector>

namespace mrpt_polyloc::test {

/// Integral over the circle of h(f(phi - rotation), g(phi)), by quadrature between the merged
/// breakpoints of both and the feet of f's and g's walls; directions that one does not see count
/// nothing.
template <class Function>
double integralOver(const PolarFunction& f, const PolarFunction& g, double rotation, Function h,
                    std::size_t parts = 30) {
  std::vector<double> breaks{0.0, kTwoPi};
  for (const double x : f.breakpoints()) breaks.push_back(wrapToTwoPi(x + rotation));
  for (const double x : g.breakpoints()) breaks.push_back(x);
  std::sort(breaks.begin(), breaks.end());
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    sum += gaussIntegral(breaks[i], breaks[i + 1], parts, [&](double phi) {
      const double value = h(f.value(phi - rotation), g.value(phi));
      return std::isnan(value) ? 0.0 : value;
    });
  return sum;
}

inline double quadratureDistance(const PolarFunction& f, const PolarFunction& g,
                                 double rotation = 0.0) {
  return std::sqrt(
      integralOver(f, g, rotation, [](double a, double b) { return (a - b) * (a - b); }));
}

/// The polar function of a random star-shaped polygon.
inline PolarFunction randomPolarFunction(std::mt19937& random) {
  const StarPolygon polygon = randomStarPolygon(random, 3 + random() % 25);
  return PolarFunction::fromPolygon(polygon.vertices, polygon.kernel);
}

/// A random view of any kind: a polygon, one cut off at a range, or a full turn of beams.
inline PolarFunction randomView(std::mt19937& random) {
  const StarPolygon polygon = randomStarPolygon(random, 3 + random() % 25);
  const auto kind = random() % 3;
  if (kind == 0) return PolarFunction::fromPolygon(polygon.vertices, polygon.kernel);
  if (kind == 1) return PolarFunction::fromPolygon(polygon.vertices, polygon.kernel, 4.0);
  std::vector<double> bearings, ranges;
  for (int i = 0; i < 60; ++i) {
    bearings.push_back(kTwoPi * (i + 0.5) / 60.0);
    ranges.push_back(rayToBorder(polygon, bearings.back()));
  }
  return PolarFunction::fromBeams(bearings, ranges);
}

}  // namespace mrpt_polyloc::test
