#include <mrpt_polyloc/geometry/vertex_bitmap.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace mrpt_polyloc {
namespace {

std::int64_t floorDivide(std::int64_t a, std::int64_t b) {
  const std::int64_t quotient = a / b;
  return quotient - (a % b != 0 && (a < 0) != (b < 0));
}

}  // namespace

bool VertexBitmap::hasOtherIn(const std::array<LatticePoint, 3>& triangle) {
  for (const LatticePoint& p : triangle) erase(p);
  const bool found = hasAnyIn(triangle);
  for (const LatticePoint& p : triangle) insert(p);
  return found;
}

bool VertexBitmap::hasAnyIn(const std::array<LatticePoint, 3>& triangle) const {
  const auto [low, high] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
  for (std::int32_t y = low; y <= high; ++y) {
    // Horizontal sides need no look: their ends belong to the other two.
    std::int64_t from = std::numeric_limits<std::int64_t>::max();
    std::int64_t to = std::numeric_limits<std::int64_t>::min();
    for (std::size_t i = 0; i < 3; ++i) {
      LatticePoint a = triangle[i];
      LatticePoint b = triangle[(i + 1) % 3];
      if (a.y > b.y) std::swap(a, b);
      if (a.y == b.y || y < a.y || y > b.y) continue;
      const std::int64_t rise = b.y - a.y;
      const std::int64_t run = static_cast<std::int64_t>(b.x - a.x) * (y - a.y);
      from = std::min(from, a.x - floorDivide(-run, rise));
      to = std::max(to, a.x + floorDivide(run, rise));
    }
    if (from <= to && hasAnyInRow(y, from, to)) return true;
  }
  return false;
}

bool VertexBitmap::hasAnyInRow(std::int32_t y, std::int64_t from, std::int64_t to) const {
  const std::uint64_t* const row = words_.data() + static_cast<std::size_t>(y) * words_per_row_;
  const std::int64_t first = from / 64;
  const std::int64_t last = to / 64;
  for (std::int64_t i = first; i <= last; ++i) {
    std::uint64_t bits = row[i];
    if (i == first) bits &= ~std::uint64_t{0} << (from % 64);
    if (i == last) bits &= ~std::uint64_t{0} >> (63 - to % 64);
    if (bits != 0) return true;
  }
  return false;
}

}  // namespace mrpt_polyloc
