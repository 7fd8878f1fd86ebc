#include <mrpt_polyloc/visibility/segment_crossings.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mrpt_polyloc {
namespace {

/// A segment by its left end, its direction and its extent.
struct Span {
  float x, y, dx, dy;
  float right, bottom, top;
};

Span spanOf(TPoint2D a, TPoint2D b, const TPoint2D& origin) {
  if (b.x < a.x) std::swap(a, b);
  const auto f = [](double d) { return static_cast<float>(d); };
  return {f(a.x - origin.x),
          f(a.y - origin.y),
          f(b.x - a.x),
          f(b.y - a.y),
          f(b.x - origin.x),
          f(std::min(a.y, b.y) - origin.y),
          f(std::max(a.y, b.y) - origin.y)};
}

/// Products of signed areas: negative where an end of one lies on either side of the other.
bool meetInside(const Span& s, const Span& t) {
  const float ex = t.x - s.x, ey = t.y - s.y;
  const float turn = s.dx * t.dy - s.dy * t.dx;
  const float t_from = s.dx * ey - s.dy * ex;
  const float s_from = t.dy * ex - t.dx * ey;
  return (t_from * (t_from + turn) < 0.0F) & (s_from * (s_from - turn) < 0.0F);
}

}  // namespace

std::size_t countCrossings(const std::vector<CriticalSegment>& segments,
                           const std::vector<std::pair<std::int32_t, std::int32_t>>& edges,
                           const std::vector<TPoint2D>& vertices, std::size_t enough) {
  if (segments.empty()) return 0;
  const TPoint2D origin = vertices.front();
  std::vector<Span> spans;
  spans.reserve(segments.size() + edges.size());
  for (const CriticalSegment& s : segments) {
    spans.push_back(
        spanOf(vertices[static_cast<std::size_t>(s.blocker)], endOf(s, vertices), origin));
  }
  for (const auto& [from, to] : edges) {
    spans.push_back(spanOf(vertices[static_cast<std::size_t>(from)],
                           vertices[static_cast<std::size_t>(to)], origin));
  }
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.x < b.x; });
  std::size_t count = 0;
  for (std::size_t i = 0; i < spans.size() && count < enough; ++i) {
    const Span s = spans[i];
    std::uint32_t crossings = 0;
    for (std::size_t j = i + 1; j < spans.size() && spans[j].x <= s.right; ++j) {
      const Span& t = spans[j];
      crossings += (t.bottom <= s.top) & (s.bottom <= t.top) & meetInside(s, t);
    }
    count += crossings;
  }
  return count;
}

}  // namespace mrpt_polyloc
