#include <mrpt_polyloc/mrpt_bridge/map_lines.h>

#include <cstdint>

namespace mrpt_polyloc {
namespace {

using drawn::CSetOfLines;

CSetOfLines::Ptr linesOf(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  const auto lines = CSetOfLines::Create();
  lines->setColor_u8(red, green, blue);
  return lines;
}

void append(CSetOfLines& lines, const TPoint2D& a, const TPoint2D& b) {
  lines.appendLine(a.x, a.y, 0.0, b.x, b.y, 0.0);
}

}  // namespace

void addMapLines(const PolygonMap& map, drawn::CSetOfObjects& out) {
  const auto walls = linesOf(20, 30, 90);
  const auto open = linesOf(255, 140, 0);
  const auto beyond = linesOf(130, 130, 130);
  for (const Ring* ring : map.rings()) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      append(ring->kinds[i] == EdgeKind::open ? *open : *walls, ring->vertices[i],
             ring->vertices[(i + 1) % ring->size()]);
    }
  }
  for (const Polyline& line : map.wallsBeyond()) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) append(*beyond, line[i], line[i + 1]);
  }
  for (const auto& lines : {walls, open, beyond}) out.insert(lines);
}

}  // namespace mrpt_polyloc
