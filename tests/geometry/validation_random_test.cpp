// Random rings on a coarse grid, where everything degenerate happens often, against brute force.

#include "tests/support/map_factories.h"
#include "tests/support/ring_oracles.h"
#include <mrpt_polyloc/geometry/validation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <optional>

namespace mrpt_polyloc::test {
namespace {

constexpr int kCells = 6;        // of the grid
constexpr double kSpacing = 10;  // [m]: what is ambiguous is so by more than the tolerance

std::vector<TPoint2D> randomGridRing(std::mt19937& random, int max_vertices) {
  std::uniform_int_distribution<int> count(3, max_vertices), cell(0, kCells);
  std::vector<TPoint2D> ring(static_cast<std::size_t>(count(random)));
  for (TPoint2D& p : ring) p = {kSpacing * cell(random), kSpacing * cell(random)};
  return ring;
}

RawMap randomGridMap(std::mt19937& random, int max_holes) {
  RawMap raw;
  raw.polygons.push_back({wallRing(randomGridRing(random, 8)), {}});
  const int holes = std::uniform_int_distribution<int>(0, max_holes)(random);
  for (int i = 0; i < holes; ++i) {
    raw.polygons[0].holes.push_back(wallRing(randomGridRing(random, 4)));
  }
  return raw;
}

/// Whether no two edges share more than the vertex that joins them.
bool isSimple(const std::vector<TPoint2D>& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const bool is_adjacent = j == i + 1 || (i == 0 && j == n - 1);
      const Meeting meeting = meetingOf(ring[i], ring[i + 1], ring[j], ring[(j + 1) % n]);
      if (ring[i] == ring[i + 1] || ring[j] == ring[(j + 1) % n]) return false;
      if (meeting != Meeting::none && !(is_adjacent && meeting == Meeting::touch)) return false;
      if (is_adjacent && n > 3 && meeting == Meeting::overlap) return false;
    }
  }
  return true;
}

/// Of how many polygons a point is inside the outer ring and in no hole, all read even-odd.
int freeCount(const RawMap& raw, const TPoint2D& p) {
  const auto is_inside = [&](const Ring& ring) { return windingNumber(ring.vertices, p) % 2 != 0; };
  int count = 0;
  for (const RawPolygon& polygon : raw.polygons) {
    count += is_inside(polygon.outer) &&
             std::none_of(polygon.holes.begin(), polygon.holes.end(), is_inside);
  }
  return count;
}

/// The fraction of random points where a map is not what the even-odd reading of its rings says.
double disagreement(const RawMap& raw, const PolygonMap& map, std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(0.0, kCells * kSpacing);
  int wrong = 0;
  constexpr int kSamples = 300;
  for (int i = 0; i < kSamples; ++i) {
    const TPoint2D p(coordinate(random), coordinate(random));
    wrong += static_cast<int>(map.contains(p)) != freeCount(raw, p);
  }
  return static_cast<double>(wrong) / kSamples;
}

TEST(ValidationRandom, SimpleRingsAreLeftAloneAndNoOthers) {
  std::mt19937 random(1);
  int simple = 0, refused = 0, repaired = 0;
  for (int i = 0; i < 4000; ++i) {
    SCOPED_TRACE(i);
    RawMap raw;
    raw.polygons.push_back({wallRing(randomGridRing(random, 7)), {}});
    const std::vector<TPoint2D>& ring = raw.polygons[0].outer.vertices;
    const MapInspection inspection = inspectMap(raw);
    if (isSimple(ring)) {
      ++simple;
      ASSERT_TRUE(inspection.map) << toString(inspection.defects.front());
      ASSERT_TRUE(inspection.defects.empty()) << toString(inspection.defects.front());
      ASSERT_EQ(inspection.map->vertexCount(), ring.size());
      continue;
    }
    inspection.map ? ++repaired : ++refused;
    ASSERT_EQ(inspection.map.has_value(), inspection.unrepaired.empty());
    const std::vector<OracleEdge> edges = edgesOf(raw);
    if (countMeetings(edges, Meeting::cross) > 0) {
      ASSERT_FALSE(inspection.defects.empty());
    }
  }
  EXPECT_GT(simple, 300);
  EXPECT_GT(refused, 300);
  EXPECT_GT(repaired, 100);
  std::cout << simple << " simple, " << repaired << " repaired, " << refused << " refused\n";
}

TEST(ValidationRandom, EveryCrossingIsLocated) {
  std::mt19937 random(2);
  int located = 0;
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    RawMap raw;
    raw.polygons.push_back({wallRing(randomGridRing(random, 8)), {}});
    const MapInspection inspection = inspectMap(raw);
    bool has_spike = false;  // what is cut off with it is not looked at
    for (const Defect& defect : inspection.defects) {
      has_spike |= defect.what != "self-crossing ring" && defect.what != "ring overlapping itself";
    }
    if (has_spike) continue;
    const std::vector<OracleEdge> edges = edgesOf(raw);
    for (std::size_t a = 0; a < edges.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const OracleEdge &s = edges[a], &t = edges[b];
        if (meetingOf(s.a, s.b, t.a, t.b) != Meeting::cross) continue;
        const TPoint2D u = s.b - s.a, v = t.b - t.a, w = t.a - s.a;
        const double along = (w.x * v.y - w.y * v.x) / (u.x * v.y - u.y * v.x);
        const TPoint2D crossing(s.a.x + along * u.x, s.a.y + along * u.y);
        const auto is_there = [&](const Defect& d) {
          return std::hypot(d.where.x - crossing.x, d.where.y - crossing.y) < 1e-9;
        };
        ASSERT_TRUE(std::any_of(inspection.defects.begin(), inspection.defects.end(), is_there));
        ++located;
      }
    }
  }
  EXPECT_GT(located, 500);
}

TEST(ValidationRandom, RepairedMapsAreSoundAndMeanWhatTheirRingsSaid) {
  std::mt19937 random(3);
  int maps = 0, with_repairs = 0;
  for (int i = 0; i < 6000; ++i) {
    SCOPED_TRACE(i);
    const RawMap raw = randomGridMap(random, 3);
    const MapInspection inspection = inspectMap(raw);
    if (!inspection.map) {
      ASSERT_FALSE(inspection.unrepaired.empty());
      continue;
    }
    ++maps;
    with_repairs += !inspection.repairs.empty();
    const std::vector<OracleEdge> edges = edgesOf(*inspection.map);
    ASSERT_EQ(countMeetings(edges, Meeting::cross), 0U);
    ASSERT_EQ(countMeetings(edges, Meeting::overlap), 0U);
    ASSERT_EQ(disagreement(raw, *inspection.map, random), 0.0);
    // A repaired map has nothing left to repair.
    RawMap again;
    for (const FreePolygon& component : inspection.map->components()) {
      again.polygons.push_back({component.outer, component.holes});
    }
    const MapInspection second = inspectMap(again);
    ASSERT_TRUE(second.defects.empty()) << toString(second.defects.front());
    ASSERT_EQ(second.map->hash(), inspection.map->hash());
  }
  EXPECT_GT(maps, 500);
  EXPECT_GT(with_repairs, 200);
  std::cout << maps << " maps, " << with_repairs << " of them repaired\n";
}

TEST(ValidationRandom, SeveralPolygonsAreAcceptedOnlyWithoutOverlap) {
  std::mt19937 random(4);
  int accepted = 0, refused = 0;
  for (int i = 0; i < 6000; ++i) {
    SCOPED_TRACE(i);
    RawMap raw;
    for (int k = 0; k < 2; ++k) {
      raw.polygons.push_back({wallRing(randomGridRing(random, 4)), {}});
      if (random() % 3 == 0) {
        raw.polygons.back().holes.push_back(wallRing(randomGridRing(random, 4)));
      }
    }
    const MapInspection inspection = inspectMap(raw);
    if (!inspection.map) {
      ++refused;
      continue;
    }
    ++accepted;
    const std::vector<OracleEdge> edges = edgesOf(*inspection.map);
    ASSERT_EQ(countMeetings(edges, Meeting::cross), 0U);
    ASSERT_EQ(countMeetings(edges, Meeting::overlap), 0U);
    ASSERT_EQ(disagreement(raw, *inspection.map, random), 0.0);
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 100);
  std::cout << accepted << " accepted, " << refused << " refused\n";
}

/// Whether p lies on the segment ab, but for rounding.
bool isOn(const TPoint2D& a, const TPoint2D& b, const TPoint2D& p) {
  return std::hypot(p.x - a.x, p.y - a.y) + std::hypot(p.x - b.x, p.y - b.y) <
         std::hypot(b.x - a.x, b.y - a.y) + 1e-9;
}

TEST(ValidationRandom, EdgesKeepTheirKinds) {
  std::mt19937 random(5);
  int open_edges = 0, rebuilt = 0;
  for (int i = 0; i < 6000; ++i) {
    SCOPED_TRACE(i);
    RawMap raw = randomGridMap(random, 4);
    if (i % 2 == 0) {  // holes in a hall: most are united, or joined to its walls
      raw.polygons[0].outer = wallRing(rectangle(0, 0, kCells * kSpacing, kCells * kSpacing));
    }
    const auto shuffle = [&](Ring& ring) {
      for (EdgeKind& kind : ring.kinds) kind = random() % 2 == 0 ? EdgeKind::open : EdgeKind::wall;
    };
    shuffle(raw.polygons[0].outer);
    for (Ring& hole : raw.polygons[0].holes) shuffle(hole);
    const MapInspection inspection = inspectMap(raw);
    if (!inspection.map) continue;
    // What is removed or dropped on the way has no say in the kind of what it lay on.
    const auto is_removal = [](const Repair& repair) {
      return repair.what.find("removed") == 0 || repair.what.find("dropped") == 0;
    };
    if (std::any_of(inspection.repairs.begin(), inspection.repairs.end(), is_removal)) continue;
    rebuilt += !inspection.repairs.empty();
    for (const Ring* ring : inspection.map->rings()) {
      for (std::size_t k = 0; k < ring->size(); ++k) {
        const TPoint2D& a = ring->vertices[k];
        const TPoint2D& b = ring->vertices[(k + 1) % ring->size()];
        bool is_wall = false, is_found = false;
        const std::vector<OracleEdge> edges = edgesOf(raw);
        for (const OracleEdge& edge : edges) {
          if (!isOn(edge.a, edge.b, a) || !isOn(edge.a, edge.b, b)) continue;
          is_found = true;
          is_wall |= edge.kind == EdgeKind::wall;
        }
        ASSERT_TRUE(is_found);
        ASSERT_EQ(ring->kinds[k], is_wall ? EdgeKind::wall : EdgeKind::open);
        open_edges += !is_wall;
      }
    }
  }
  EXPECT_GT(open_edges, 300);
  EXPECT_GT(rebuilt, 30);
}

TEST(ValidationRandom, ShakenStaircasesAreRepaired) {
  // Vertices moved past each other by a few millimetres, as digitised plans have them.
  int repaired = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 0.003);
    std::vector<TPoint2D> ring{{10, 0}, {10, 10}, {0, 10}};
    for (int i = 0; i < 200; ++i) {
      ring.emplace_back(0.05 * i, 0.01 * (i % 2));
      ring.back() += TPoint2D(noise(random), noise(random));
      ring.emplace_back(ring.back().x + 0.002 + noise(random), ring.back().y + noise(random));
    }
    RawMap raw;
    raw.polygons.push_back({wallRing(ring), {}});
    for (EdgeKind& kind : raw.polygons[0].outer.kinds) kind = EdgeKind::open;
    const MapInspection inspection = inspectMap(raw);
    ASSERT_TRUE(inspection.map) << toString(inspection.unrepaired.front());
    repaired += !inspection.repairs.empty();
    EXPECT_EQ(countMeetings(edgesOf(*inspection.map), Meeting::cross), 0U);
    EXPECT_NEAR(inspection.map->area(), 100.0, 0.5);
    EXPECT_DOUBLE_EQ(inspection.map->openPerimeter(), inspection.map->perimeter());
  }
  EXPECT_GT(repaired, 50);
}

}  // namespace
}  // namespace mrpt_polyloc::test
