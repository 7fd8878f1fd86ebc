#pragma once

#include <random>
#include <sstream>
#include <string>

namespace mrpt_polyloc::test {

/// A closed floor of n x n rooms of 5 m x 5 m with doors, a piece of furniture in each: WKT.
inline std::string floorOf(int n) {
  std::ostringstream wkt;
  const double side = 5.0 * n;
  std::mt19937 random(7);
  const auto share = [&] { return static_cast<double>(random() % 1000) / 1000; };
  const auto box = [&](double x0, double y0, double x1, double y1) {
    wkt << ", (" << x0 << ' ' << y0 << ", " << x0 << ' ' << y1 << ", " << x1 << ' ' << y1 << ", "
        << x1 << ' ' << y0 << ", " << x0 << ' ' << y0 << ')';
  };
  wkt << "POLYGON ((0 0, " << side << " 0, " << side << ' ' << side << ", 0 " << side << ", 0 0)";
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = 5.0 * i, y = 5.0 * j, w = 0.4 + share(), h = 0.4 + share();
      const double fx = x + 0.6 + 2.6 * share(), fy = y + 0.6 + 2.6 * share();
      box(fx, fy, fx + w, fy + h);
      if (i > 0) box(x - 0.05, y + 0.1, x + 0.05, y + 3.2 + share());
      if (j > 0) box(x + 0.1, y - 0.05, x + 3.2 + share(), y + 0.05);
    }
  }
  wkt << ")\n";
  return wkt.str();
}

}  // namespace mrpt_polyloc::test
