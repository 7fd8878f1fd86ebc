#include "tracing_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <utility>

namespace mrpt_polyloc::test {
namespace {

double orient(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool same(const TPoint2D& a, const TPoint2D& b) {
  return a.x == b.x && a.y == b.y;
}

bool onEdge(const TPoint2D& p, const TracedEdge& e) {
  return orient(e.a, e.b, p) == 0.0 && std::min(e.a.x, e.b.x) <= p.x &&
         p.x <= std::max(e.a.x, e.b.x) && std::min(e.a.y, e.b.y) <= p.y &&
         p.y <= std::max(e.a.y, e.b.y);
}

bool isEnd(const TPoint2D& p, const TracedEdge& e) {
  return same(p, e.a) || same(p, e.b);
}

bool conflict(const TracedEdge& e, const TracedEdge& f) {
  for (const TPoint2D& p : {f.a, f.b}) {
    if (onEdge(p, e) && !isEnd(p, e)) return true;
  }
  for (const TPoint2D& p : {e.a, e.b}) {
    if (onEdge(p, f) && !isEnd(p, f)) return true;
  }
  if (isEnd(e.a, f) && isEnd(e.b, f)) return true;
  const auto sign = [](double v) { return (v > 0.0) - (v < 0.0); };
  return sign(orient(e.a, e.b, f.a)) * sign(orient(e.a, e.b, f.b)) < 0 &&
         sign(orient(f.a, f.b, e.a)) * sign(orient(f.a, f.b, e.b)) < 0;
}

std::string toText(const TPoint2D& p) {
  std::ostringstream text;
  text << "(" << p.x << ", " << p.y << ")";
  return text.str();
}

std::string describe(const TracedEdge& e, const TracedEdge& f) {
  return toText(e.a) + "-" + toText(e.b) + e.kind + " and " + toText(f.a) + "-" + toText(f.b) +
         f.kind;
}

/// Whether a ring's interior holds a point that is not on its border.
bool encloses(const Ring& ring, const TPoint2D& p) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const TPoint2D& a = ring.vertices[i];
    const TPoint2D& b = ring.vertices[(i + 1) % ring.size()];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

bool isVertex(const Ring& ring, const TPoint2D& p) {
  return std::any_of(ring.vertices.begin(), ring.vertices.end(),
                     [&p](const TPoint2D& v) { return same(v, p); });
}

}  // namespace

std::vector<TracedEdge> tracedEdges(const PolygonMap& map) {
  std::vector<TracedEdge> edges;
  for (const Ring* ring : map.rings()) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      edges.push_back({ring->vertices[i], ring->vertices[(i + 1) % ring->size()],
                       ring->kinds[i] == EdgeKind::wall ? '#' : '?'});
    }
  }
  for (const Polyline& wall : map.wallsBeyond()) {
    for (std::size_t i = 1; i < wall.size(); ++i) edges.push_back({wall[i - 1], wall[i], 'b'});
  }
  return edges;
}

double distance(const TPoint2D& p, const TracedEdge& edge) {
  const TPoint2D d{edge.b.x - edge.a.x, edge.b.y - edge.a.y};
  const double along = ((p.x - edge.a.x) * d.x + (p.y - edge.a.y) * d.y) / (d.x * d.x + d.y * d.y);
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(p.x - edge.a.x - t * d.x, p.y - edge.a.y - t * d.y);
}

double distance(const TPoint2D& p, const std::vector<TracedEdge>& edges) {
  double least = std::numeric_limits<double>::infinity();
  for (const TracedEdge& edge : edges) least = std::min(least, distance(p, edge));
  return least;
}

FloodedBitmap floodComponents(OccupancyBitmap bitmap, std::size_t min_cells) {
  FloodedBitmap result;
  std::vector<bool> seen(bitmap.cells.size(), false);
  const auto index = [&bitmap](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(bitmap.width) +
           static_cast<std::size_t>(x);
  };
  OccupancyBitmap kept = bitmap;
  for (int row = 0; row < bitmap.height; ++row) {
    for (int column = 0; column < bitmap.width; ++column) {
      std::vector<std::pair<int, int>> component;
      const auto reach = [&](int x, int y) {
        if (bitmap.at(x, y) != CellState::free || seen[index(x, y)]) return;
        seen[index(x, y)] = true;
        component.emplace_back(x, y);
      };
      reach(column, row);
      for (std::size_t i = 0; i < component.size(); ++i) {
        const auto [x, y] = component[i];
        reach(x + 1, y);
        reach(x - 1, y);
        reach(x, y + 1);
        reach(x, y - 1);
      }
      if (component.empty()) continue;
      if (component.size() >= min_cells) {
        ++result.component_count;
        result.free_cells += component.size();
        continue;
      }
      for (const auto& [x, y] : component) kept.cells[index(x, y)] = CellState::unknown;
    }
  }
  result.bitmap = std::move(kept);
  return result;
}

SideCounts countSides(const OccupancyBitmap& bitmap) {
  SideCounts counts;
  const auto count = [&counts](CellState a, CellState b) {
    if (a == b) return;
    const auto isOneOf = [&](CellState s) { return a == s || b == s; };
    if (!isOneOf(CellState::free))
      ++counts.beyond;
    else if (isOneOf(CellState::occupied))
      ++counts.wall;
    else
      ++counts.open;
  };
  for (int row = -1; row < bitmap.height; ++row) {
    for (int column = -1; column < bitmap.width; ++column) {
      count(bitmap.at(column, row), bitmap.at(column + 1, row));
      count(bitmap.at(column, row), bitmap.at(column, row + 1));
    }
  }
  return counts;
}

std::string findCrossing(const PolygonMap& map) {
  const std::vector<TracedEdge> edges = tracedEdges(map);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      if (conflict(edges[i], edges[j])) return describe(edges[i], edges[j]);
    }
  }
  return "";
}

std::string findCrossingInSquares(const PolygonMap& map, double side) {
  const std::vector<TracedEdge> edges = tracedEdges(map);
  std::map<std::pair<int, int>, std::vector<std::size_t>> squares;
  const auto number = [side](double v) { return static_cast<int>(std::floor(v / side)); };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [left, right] = std::minmax({number(edges[i].a.x), number(edges[i].b.x)});
    const auto [low, high] = std::minmax({number(edges[i].a.y), number(edges[i].b.y)});
    for (int y = low; y <= high; ++y) {
      for (int x = left; x <= right; ++x) squares[{x, y}].push_back(i);
    }
  }
  for (const auto& [square, members] : squares) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (std::size_t j = i + 1; j < members.size(); ++j) {
        const TracedEdge& e = edges[members[i]];
        const TracedEdge& f = edges[members[j]];
        if (conflict(e, f)) return describe(e, f);
      }
    }
  }
  return "";
}

std::vector<bool> freeCentres(const PolygonMap& map, int width, int height) {
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(height));
  for (const TracedEdge& edge : tracedEdges(map)) {
    if (edge.kind == 'b') continue;
    const auto [low, high] = std::minmax({edge.a.y, edge.b.y});
    for (int row = std::max(0, static_cast<int>(low) - 1); row < height && row <= high; ++row) {
      const double y = row + 0.5;
      if ((low <= y) == (high <= y)) continue;
      crossings[static_cast<std::size_t>(row)].push_back(
          edge.a.x + (edge.b.x - edge.a.x) * (y - edge.a.y) / (edge.b.y - edge.a.y));
    }
  }
  std::vector<bool> free;
  for (std::vector<double>& row : crossings) {
    std::sort(row.begin(), row.end());
    std::size_t passed = 0;
    for (int column = 0; column < width; ++column) {
      while (passed < row.size() && row[passed] < column + 0.5) ++passed;
      free.push_back(passed % 2 == 1);
    }
  }
  return free;
}

std::string findBadRing(const PolygonMap& map) {
  for (const FreePolygon& polygon : map.components()) {
    std::vector<const Ring*> rings{&polygon.outer};
    for (const Ring& hole : polygon.holes) rings.push_back(&hole);
    for (const Ring* ring : rings) {
      const std::string where = " ring at " + toText(ring->vertices.front());
      std::set<std::pair<double, double>> unique;
      for (const TPoint2D& v : ring->vertices) unique.insert({v.x, v.y});
      if (unique.size() != ring->size()) return "repeated vertex:" + where;
      if (ring->size() < 3) return "too few vertices:" + where;
      const double area = signedArea(ring->vertices);
      if (ring == &polygon.outer ? area <= 0.0 : area >= 0.0) return "bad area:" + where;
      if (ring == &polygon.outer) continue;
      for (const TPoint2D& v : ring->vertices) {
        if (!encloses(polygon.outer, v) && !isVertex(polygon.outer, v)) return "outside:" + where;
      }
    }
  }
  return "";
}

}  // namespace mrpt_polyloc::test
