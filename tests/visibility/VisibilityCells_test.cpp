#include "tests/support/map_factories.h"
#include "tests/support/polygon_width.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/geometry/orientation.h>
#include <mrpt_polyloc/visibility/ViewExpander.h>
#include <mrpt_polyloc/visibility/VisibilityCells.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

using test::widthOf;

/// The pieces of edges seen from a point, each with the vertices that limit it.
using Seen = std::set<std::array<std::int32_t, 4>>;

Seen seenFrom(ViewExpander& expander, const TPoint2D& point) {
  Seen seen;
  for (const VisibleEdge& e : expander.expand(point).ends) {
    seen.insert({e.right, e.left, e.right_limit, e.left_limit});
  }
  return seen;
}

std::set<std::int32_t> verticesOf(const Seen& seen) {
  std::set<std::int32_t> vertices;
  for (const auto& piece : seen) vertices.insert({piece[2], piece[3]});
  return vertices;
}

/// An inner point, by random weights of the vertices that leave out none.
TPoint2D randomInside(const std::vector<TPoint2D>& polygon, std::mt19937& random) {
  std::uniform_real_distribution<double> weight(0.1, 1.0);
  TPoint2D sum{0, 0};
  double total = 0.0;
  for (const TPoint2D& p : polygon) {
    const double w = weight(random);
    sum = sum + p * w;
    total += w;
  }
  return sum * (1.0 / total);
}

/// Maps in line with themselves: rooms on a grid, parallel walls, vertices on straight walls.
std::vector<std::pair<std::string, PolygonMap>> alignedMaps() {
  std::vector<std::pair<std::string, PolygonMap>> all;
  for (auto& [name, map] : test::namedMaps()) all.emplace_back(name, map);
  all.emplace_back("open edges", test::withOpenEdges(test::pillarMap(), 0.3, 5));
  std::mt19937 random(71);
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    test::FloorPlanParams params = test::randomParams(random);
    params.corridors = 1;
    params.rooms_per_side = std::min(params.rooms_per_side, 2);
    params.crossing_walls = 0;
    params.edge_length = 0.0;
    if (seed % 2 == 0) params.rotation = params.jitter = 0.0;
    all.emplace_back("plan " + std::to_string(seed), test::floorPlan(params, seed));
  }
  return all;
}

/// Cells narrower than this are not sampled: points in them are no better than their corners, which
/// are rounded. Lines that would meet but for rounding make such cells.
constexpr double kThin = 1e-11;

TEST(VisibilityCells, AreConvexAndFillFreeSpace) {
  for (const auto& [name, map] : alignedMaps()) {
    SCOPED_TRACE(name);
    for (const double range : {kUnlimitedRange, 2.5}) {
      const VisibilityCells cells(map, {1'000'000, range});
      double area = 0.0;
      for (std::size_t c = 0; c < cells.size(); ++c) {
        const std::vector<TPoint2D> p = cells.polygon(c);
        area += cells.area(c);
        if (widthOf(p) < kThin) continue;
        for (std::size_t i = 0; i < p.size(); ++i) {
          const TPoint2D a = p[i], b = p[(i + 1) % p.size()], d = p[(i + 2) % p.size()];
          const double cross = (b.x - a.x) * (d.y - b.y) - (b.y - a.y) * (d.x - b.x);
          EXPECT_GT(cross, -1e-8) << "cell " << c;
        }
      }
      EXPECT_NEAR(area, map.area(), 1e-7 * map.area());
    }
  }
}

TEST(VisibilityCells, SeeTheSameThroughout) {
  std::mt19937 random(72);
  for (const auto& [name, map] : alignedMaps()) {
    SCOPED_TRACE(name);
    const VisibilityCells cells(map);
    ViewExpander expander(cells.triangulation(), true);
    for (int k = 0; k < 400; ++k) {
      const std::size_t c = random() % cells.size();
      const std::vector<TPoint2D> polygon = cells.polygon(c);
      if (widthOf(polygon) < kThin) continue;
      const Seen expected = seenFrom(expander, cells.representative(c));
      EXPECT_EQ(seenFrom(expander, randomInside(polygon, random)), expected) << "cell " << c;
    }
  }
}

TEST(VisibilityCells, DifferFromTheirNeighborsByWhatIsSaid) {
  std::mt19937 random(73);
  for (const auto& [name, map] : alignedMaps()) {
    SCOPED_TRACE(name);
    const VisibilityCells cells(map);
    ViewExpander expander(cells.triangulation(), true);
    for (int k = 0; k < 300; ++k) {
      const std::size_t c = random() % cells.size();
      if (widthOf(cells.polygon(c)) < kThin) continue;
      const auto here = verticesOf(seenFrom(expander, cells.representative(c)));
      for (std::size_t e = 0; e < cells.edgeCount(c); ++e) {
        const std::int32_t next = cells.neighbor(c, e);
        if (next == VisibilityCells::kNone) {
          EXPECT_TRUE(cells.changesAcross(c, e).empty());
          continue;
        }
        const auto other = static_cast<std::size_t>(next);
        if (widthOf(cells.polygon(other)) < kThin) continue;
        std::set<std::int32_t> expected = here;
        EXPECT_FALSE(cells.changesAcross(c, e).empty());
        for (const auto& change : cells.changesAcross(c, e)) {
          if (change.appears) {
            EXPECT_TRUE(expected.insert(change.vertex).second) << "cell " << c;
          } else {
            EXPECT_EQ(expected.erase(change.vertex), 1U) << "cell " << c;
          }
        }
        EXPECT_EQ(verticesOf(seenFrom(expander, cells.representative(other))), expected)
            << "cells " << c << " " << other;
      }
    }
  }
}

TEST(VisibilityCells, AreNeighborsOfTheirNeighbors) {
  for (const auto& [name, map] : alignedMaps()) {
    SCOPED_TRACE(name);
    const VisibilityCells cells(map);
    std::multiset<std::pair<std::int32_t, std::int32_t>> links;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      for (std::size_t e = 0; e < cells.edgeCount(c); ++e) {
        const std::int32_t next = cells.neighbor(c, e);
        if (next != VisibilityCells::kNone) links.insert({static_cast<std::int32_t>(c), next});
      }
    }
    for (const auto& [from, to] : links) {
      EXPECT_EQ(links.count({from, to}), links.count({to, from}));
    }
  }
}

TEST(VisibilityCells, AreFoundAsByBruteForce) {
  std::mt19937 random(74);
  for (const auto& [name, map] : alignedMaps()) {
    SCOPED_TRACE(name);
    const VisibilityCells cells(map);
    const auto holds = [&](std::size_t c, const TPoint2D& p) {
      const std::vector<TPoint2D> v = cells.polygon(c);
      for (std::size_t i = 0; i < v.size(); ++i) {
        if (orientation(v[i], v[(i + 1) % v.size()], p) <= 0) return false;
      }
      return true;
    };
    for (const TPoint2D& p : test::randomPoints(map, 0.5, 60, random)) {
      const std::int32_t found = cells.locate(p);
      EXPECT_EQ(found != VisibilityCells::kNone, map.contains(p));
      for (std::size_t c = 0; c < cells.size(); ++c) {
        if (!holds(c, p)) continue;
        EXPECT_EQ(found, static_cast<std::int32_t>(c));
      }
    }
    const double nan = std::nan("");
    EXPECT_EQ(cells.locate({nan, 0}), VisibilityCells::kNone);
  }
}

TEST(VisibilityCells, TellHowFarOutsideOfThemAPointIs) {
  const VisibilityCells square(test::squareMap(4.0));
  EXPECT_EQ(square.distanceOutside(0, {1, 2}), 0.0);
  EXPECT_EQ(square.distanceOutside(0, {4, 2}), 0.0);
  EXPECT_DOUBLE_EQ(square.distanceOutside(0, {4.5, 2}), 0.5);
  EXPECT_DOUBLE_EQ(square.distanceOutside(0, {5, -2}), 2.0);
}

TEST(VisibilityCells, HaveTiedPointsWhereThreeCriticalLinesMeet) {
  // Against all pairs of critical segments: crossings inside that a third one passes.
  for (const PolygonMap& map : {test::pillarMap(), test::tJunctionMap(), test::lRoomMap()}) {
    const VisibilityCells cells(map);
    const auto& vertices = cells.triangulation().vertices();
    std::vector<std::pair<TPoint2D, TPoint2D>> segments;
    for (const CriticalSegment& s : cells.criticalSegments().segments) {
      segments.emplace_back(vertices[static_cast<std::size_t>(s.blocker)], endOf(s, vertices));
    }
    const auto through = [&](const TPoint2D& p, const std::pair<TPoint2D, TPoint2D>& s) {
      const TPoint2D d = s.second - s.first, e = p - s.first;
      const double share = (e.x * d.x + e.y * d.y) / (d.x * d.x + d.y * d.y);
      return share > 1e-9 && share < 1 - 1e-9 && (e - d * share).norm() < 1e-9;
    };
    const std::vector<TPoint2D> tied = cells.tiedPoints(0.0);
    const auto isTied = [&](const TPoint2D& p) {
      return std::any_of(tied.begin(), tied.end(),
                         [&](const TPoint2D& t) { return (t - p).norm() < 1e-9; });
    };
    std::size_t meetings = 0;
    for (const auto& s : segments) {
      for (const auto& t : segments) {
        const TPoint2D d = s.second - s.first, e = t.second - t.first, o = t.first - s.first;
        const double turn = d.x * e.y - d.y * e.x;
        if (std::abs(turn) < 1e-9 * d.norm() * e.norm()) continue;
        const TPoint2D p = s.first + d * ((o.x * e.y - o.y * e.x) / turn);
        if (!through(p, s) || !through(p, t)) continue;
        std::set<long> slopes;  // of the lines through the point
        for (const auto& other : segments) {
          if (!through(p, other)) continue;
          const TPoint2D along = other.second - other.first;
          const double angle = std::atan2(along.y, along.x);
          const long slope = std::lround(std::remainder(angle, M_PI) * 1e6);
          slopes.insert(slope == -1570796 ? 1570796 : slope);  // upwards as downwards
        }
        if (slopes.size() < 3) continue;
        ++meetings;
        EXPECT_TRUE(isTied(p)) << p.x << " " << p.y;
      }
    }
    for (const TPoint2D& p : tied) {
      const auto lines = std::count_if(segments.begin(), segments.end(),
                                       [&](const auto& s) { return through(p, s); });
      EXPECT_GE(lines, 2) << p.x << " " << p.y;
    }
    if (map.holeCount() == 6) {
      EXPECT_GT(meetings, 0U);
    }
  }
}

TEST(VisibilityCells, WithALimitTellTheVerticesWithinItApart) {
  std::mt19937 random(75);
  constexpr double kRange = 2.5;
  for (const auto& [name, map] : alignedMaps()) {
    SCOPED_TRACE(name);
    const VisibilityCells cells(map, {1'000'000, kRange});
    ViewExpander expander(cells.triangulation(), true);
    const auto& vertices = cells.triangulation().vertices();
    for (int k = 0; k < 300; ++k) {
      const std::size_t c = random() % cells.size();
      const std::vector<TPoint2D> polygon = cells.polygon(c);
      if (widthOf(polygon) < kThin) continue;
      const TPoint2D p = randomInside(polygon, random), q = randomInside(polygon, random);
      const auto from_p = verticesOf(seenFrom(expander, p));
      const auto from_q = verticesOf(seenFrom(expander, q));
      for (std::size_t v = 0; v < vertices.size(); ++v) {
        const TPoint2D a = vertices[v] - p, b = vertices[v] - q;
        if (std::hypot(a.x, a.y) > kRange || std::hypot(b.x, b.y) > kRange) continue;
        const auto id = static_cast<std::int32_t>(v);
        EXPECT_EQ(from_p.count(id), from_q.count(id)) << "cell " << c << " vertex " << v;
      }
    }
  }
}

TEST(VisibilityCells, AreRefusedOverBudget) {
  const PolygonMap map = test::pillarMap();
  const CellEstimate estimate = VisibilityCells::estimate(map);
  const VisibilityCells cells(map);
  EXPECT_GE(estimate.cells(), cells.size());
  try {
    const VisibilityCells refused(map, {100, kUnlimitedRange});
    FAIL() << "not refused";
  } catch (const CellBudgetError& e) {
    EXPECT_EQ(e.estimate.crossings, estimate.crossings);
    const std::string text = e.what();
    EXPECT_NE(text.find(std::to_string(estimate.crossings) + " crossings"), std::string::npos);
    EXPECT_NE(text.find("range"), std::string::npos);
    EXPECT_NE(text.find("certified"), std::string::npos);
  }
  EXPECT_THROW(VisibilityCells(map, {100, -1.0}), InvalidParamsError);
  EXPECT_THROW(VisibilityCells(map, {100, std::nan("")}), InvalidParamsError);
}

TEST(VisibilityCells, FitTheirBudgetInTheGreatestRange) {
  const PolygonMap map = test::pillarMap(4, 3);
  EXPECT_TRUE(std::isinf(VisibilityCells::greatestRange(map, 1'000'000)));
  double previous = std::numeric_limits<double>::infinity();
  for (const std::size_t budget : {3000U, 1000U, 300U}) {
    const double range = VisibilityCells::greatestRange(map, budget);
    EXPECT_LE(range, previous);
    EXPECT_LE(VisibilityCells(map, {budget, range}).size(), budget);
    // The next one is too much, by the count or because it is all there is.
    const double next = 1.4142136 * range;
    EXPECT_GT(VisibilityCells::estimate(map, next).cells(), budget);
    previous = range;
  }
  EXPECT_THROW(VisibilityCells::greatestRange(map, 3), CellBudgetError);
}

TEST(VisibilityCells, AreNeverMoreThanEstimated) {
  for (const auto& [name, map] : alignedMaps()) {
    SCOPED_TRACE(name);
    for (const double range : {kUnlimitedRange, 2.5, 0.7}) {
      EXPECT_GE(VisibilityCells::estimate(map, range).cells(),
                VisibilityCells(map, {1'000'000, range}).size())
          << "range " << range;
    }
  }
}

TEST(VisibilityCells, OfAConvexRoomAreOne) {
  const VisibilityCells cells(test::squareMap());
  EXPECT_EQ(cells.size(), 1U);
  EXPECT_TRUE(cells.criticalSegments().segments.empty());
}

}  // namespace
}  // namespace mrpt_polyloc
