#include <mrpt_polyloc/evaluation/baselines/squared_distances.h>

#include <cstddef>
#include <limits>

namespace mrpt_polyloc {

namespace {

/// For one row or column: the squared distance transform of Felzenszwalb and Huttenlocher (2012).
void transformLine(std::vector<float>& f, std::vector<float>& out, std::vector<int>& v,
                   std::vector<float>& z) {
  const int n = static_cast<int>(f.size());
  const float infinity = std::numeric_limits<float>::infinity();
  int k = -1;
  for (int q = 0; q < n; ++q) {
    const auto at = [&](int i) { return f[static_cast<std::size_t>(i)]; };
    if (at(q) == infinity) continue;
    float s = -infinity;
    while (k >= 0) {
      const int p = v[static_cast<std::size_t>(k)];
      s = ((at(q) + static_cast<float>(q) * static_cast<float>(q)) -
           (at(p) + static_cast<float>(p) * static_cast<float>(p))) /
          static_cast<float>(2 * q - 2 * p);
      if (s > z[static_cast<std::size_t>(k)]) break;
      --k;
    }
    ++k;
    v[static_cast<std::size_t>(k)] = q;
    z[static_cast<std::size_t>(k)] = k == 0 ? -infinity : s;
    z[static_cast<std::size_t>(k) + 1] = infinity;
  }
  if (k < 0) {
    out = f;
    return;
  }
  int j = 0;
  for (int q = 0; q < n; ++q) {
    while (z[static_cast<std::size_t>(j) + 1] < static_cast<float>(q)) ++j;
    const int p = v[static_cast<std::size_t>(j)];
    const float d = static_cast<float>(q - p);
    out[static_cast<std::size_t>(q)] = d * d + f[static_cast<std::size_t>(p)];
  }
}

}  // namespace

std::vector<float> squaredDistances(const OccupancyBitmap& bitmap, CellState state) {
  const auto width = static_cast<std::size_t>(bitmap.width);
  const auto height = static_cast<std::size_t>(bitmap.height);
  std::vector<float> d(width * height);
  for (std::size_t i = 0; i < d.size(); ++i) {
    d[i] = bitmap.cells[i] == state ? 0.0F : std::numeric_limits<float>::infinity();
  }
  const auto pass = [&](std::size_t lines, std::size_t length, std::size_t line_step,
                        std::size_t step) {
    std::vector<float> f(length), out(length), z(length + 1);
    std::vector<int> v(length);
    for (std::size_t line = 0; line < lines; ++line) {
      for (std::size_t i = 0; i < length; ++i) f[i] = d[line * line_step + i * step];
      transformLine(f, out, v, z);
      for (std::size_t i = 0; i < length; ++i) d[line * line_step + i * step] = out[i];
    }
  };
  pass(width, height, 1, width);
  pass(height, width, width, 1);
  return d;
}

}  // namespace mrpt_polyloc
