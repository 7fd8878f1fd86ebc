#pragma once

#include <mrpt/math/TPoint2D.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace mrpt_polyloc::test {

/// A polygon that is star-shaped around `kernel`, counterclockwise.
struct StarPolygon {
  std::vector<mrpt::math::TPoint2D> vertices;
  mrpt::math::TPoint2D kernel{0, 0};
};

/// A random star-shaped polygon as a robot sees one: radii of 0.5 to 8 m, about one vertex in four
/// the end of a window (two vertices in one direction). `directions` >= 3.
inline StarPolygon randomStarPolygon(std::mt19937& random, std::size_t directions) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  StarPolygon polygon;
  polygon.kernel = {40.0 * share(random) - 20.0, 40.0 * share(random) - 20.0};
  // Jittered equal spacings stay below pi, whatever the number of directions.
  const double spacing = 2.0 * M_PI / static_cast<double>(directions);
  const double offset = share(random);
  for (std::size_t i = 0; i < directions; ++i) {
    const double phi = spacing * (static_cast<double>(i) + offset + 0.4 * (share(random) - 0.5));
    const auto push = [&](double radius) {
      polygon.vertices.emplace_back(polygon.kernel.x + radius * std::cos(phi),
                                    polygon.kernel.y + radius * std::sin(phi));
    };
    push(0.5 + 7.5 * share(random));
    if (share(random) < 0.25) push(0.5 + 7.5 * share(random));
  }
  return polygon;
}

/// The polygon turned about its kernel.
inline StarPolygon turnedPolygon(StarPolygon polygon, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (auto& vertex : polygon.vertices) {
    const auto r = vertex - polygon.kernel;
    vertex = {polygon.kernel.x + c * r.x - s * r.y, polygon.kernel.y + s * r.x + c * r.y};
  }
  return polygon;
}

/// Shoelace formula [m2].
inline double polygonArea(const std::vector<mrpt::math::TPoint2D>& vertices) {
  double twice = 0.0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto& a = vertices[i];
    const auto& b = vertices[(i + 1) % vertices.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

/// How far a ray from the kernel runs until it meets an edge, by trying every edge.
inline double rayToBorder(const StarPolygon& polygon, double phi) {
  const double ux = std::cos(phi), uy = std::sin(phi);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const auto a = polygon.vertices[i] - polygon.kernel;
    const auto b = polygon.vertices[(i + 1) % polygon.vertices.size()] - polygon.kernel;
    const double side_a = ux * a.y - uy * a.x, side_b = ux * b.y - uy * b.x;
    if (!(side_a <= 0.0 && side_b > 0.0)) continue;
    const double share = side_a / (side_a - side_b);
    const double t = ux * (a.x + share * (b.x - a.x)) + uy * (a.y + share * (b.y - a.y));
    if (t > 0.0) nearest = std::min(nearest, t);
  }
  return nearest;
}

/// Integral of a function over [begin, end] that is smooth within (Gauss-Legendre, 5 points, on
/// `parts` equal parts).
template <class Function>
double gaussIntegral(double begin, double end, std::size_t parts, Function function) {
  constexpr double kNodes[] = {0.0, 0.538469310105683091, 0.906179845938663993};
  constexpr double kWeights[] = {0.568888888888888889, 0.478628670499366468, 0.236926885056189088};
  const double half = 0.5 * (end - begin) / static_cast<double>(parts);
  double sum = 0.0;
  for (std::size_t part = 0; part < parts; ++part) {
    const double middle = begin + (2.0 * static_cast<double>(part) + 1.0) * half;
    sum += kWeights[0] * function(middle);
    for (int i = 1; i < 3; ++i)
      sum +=
          kWeights[i] * (function(middle - half * kNodes[i]) + function(middle + half * kNodes[i]));
  }
  return half * sum;
}

}  // namespace mrpt_polyloc::test
