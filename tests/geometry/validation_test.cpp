#include "tests/support/map_factories.h"
#include "tests/support/ring_oracles.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/geometry/validation.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace mrpt_polyloc::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

using Points = std::vector<TPoint2D>;

/// A raw map of one polygon, rings as given.
RawMap rawMap(const Points& outer, const std::vector<Points>& holes = {}) {
  RawMap raw;
  raw.polygons.push_back({wallRing(outer), {}});
  for (const Points& hole : holes) raw.polygons[0].holes.push_back(wallRing(hole));
  return raw;
}

RawMap operator+(RawMap a, const RawMap& b) {
  a.polygons.insert(a.polygons.end(), b.polygons.begin(), b.polygons.end());
  return a;
}

std::vector<std::string> texts(const std::vector<Defect>& defects) {
  std::vector<std::string> all;
  for (const Defect& defect : defects) all.push_back(toString(defect));
  return all;
}

std::vector<std::string> refusals(const RawMap& raw) {
  return texts(inspectMap(raw).unrepaired);
}

void expectSound(const PolygonMap& map) {
  EXPECT_EQ(countMeetings(edgesOf(map), Meeting::cross), 0U);
  EXPECT_EQ(countMeetings(edgesOf(map), Meeting::overlap), 0U);
}

TEST(Validation, LeavesAValidMapAlone) {
  const RepairedMap repaired =
      repairMap(rawMap(rectangle(0, 0, 10, 10), {{{2, 2}, {2, 4}, {4, 2}}}));
  EXPECT_THAT(repaired.defects, IsEmpty());
  EXPECT_THAT(repaired.repairs, IsEmpty());
  EXPECT_DOUBLE_EQ(repaired.map.area(), 98.0);
}

TEST(Validation, OrientationAndClosingVertexAreConventions) {
  const RepairedMap repaired = repairMap(
      rawMap({{0, 0}, {0, 9}, {9, 9}, {9, 0}, {0, 0}}, {{{2, 2}, {4, 2}, {2, 4}, {2, 2}}}));
  EXPECT_THAT(repaired.defects, IsEmpty());
  EXPECT_EQ(repaired.map.vertexCount(), 7U);
  EXPECT_DOUBLE_EQ(repaired.map.area(), 79.0);
}

TEST(Validation, ReversedRingsKeepTheKindsOfTheirEdges) {
  RawMap raw = rawMap({{0, 0}, {0, 9}, {9, 9}, {9, 0}, {0, 0}});  // clockwise and closed
  raw.polygons[0].outer.kinds[1] = EdgeKind::open;                // (0, 9) to (9, 9)
  const PolygonMap map = repairMap(raw).map;
  const Ring& ring = map.components()[0].outer;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const bool is_top = ring.vertices[i].y == 9 && ring.vertices[(i + 1) % 4].y == 9;
    EXPECT_EQ(ring.kinds[i], is_top ? EdgeKind::open : EdgeKind::wall);
  }
}

TEST(Validation, CollinearVerticesAreNoDefect) {
  const RepairedMap repaired = repairMap(rawMap({{0, 0}, {5, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 1}}));
  EXPECT_THAT(repaired.defects, IsEmpty());
  EXPECT_EQ(repaired.map.vertexCount(), 6U);
}

TEST(Validation, RemovesRepeatedVertices) {
  RawMap raw = rawMap({{0, 0}, {9, 0}, {9, 0}, {9, 0}, {9, 9}, {0, 9}});
  raw.polygons[0].outer.kinds[3] = EdgeKind::open;  // the right side
  const RepairedMap repaired = repairMap(raw);
  EXPECT_THAT(texts(repaired.defects), ElementsAre("repeated vertex at (9.000, 0.000)",
                                                   "repeated vertex at (9.000, 0.000)"));
  EXPECT_THAT(repaired.repairs, testing::SizeIs(2));
  EXPECT_EQ(repaired.map.vertexCount(), 4U);
  EXPECT_DOUBLE_EQ(repaired.map.openPerimeter(), 9.0);
}

TEST(Validation, RemovesSpikes) {
  RawMap raw = rawMap({{0, 0}, {9, 0}, {9, 4}, {15, 4}, {9, 4}, {9, 9}, {0, 9}});
  raw.polygons[0].outer.kinds[4] = EdgeKind::open;  // (9, 4) to (9, 9)
  const RepairedMap repaired = repairMap(raw);
  EXPECT_THAT(texts(repaired.defects), ElementsAre("spike at (15.000, 4.000)"));
  EXPECT_DOUBLE_EQ(repaired.map.openPerimeter(), 5.0);
  EXPECT_DOUBLE_EQ(repaired.map.perimeter(), 36.0);
}

TEST(Validation, ASpikeOfSeveralEdgesIsOneDefect) {
  const RepairedMap repaired = repairMap(rawMap(
      {{0, 0}, {9, 0}, {9, 4}, {5, 4}, {3, 2}, {1, 2}, {3, 2}, {5, 4}, {9, 4}, {9, 9}, {0, 9}}));
  EXPECT_THAT(texts(repaired.defects), ElementsAre("spike at (1.000, 2.000)"));
  EXPECT_DOUBLE_EQ(repaired.map.area(), 81.0);
}

TEST(Validation, ASpikeThatOvershootsKeepsTheKindOfWhatIsLeft) {
  // From (9, 0) up to (9, 12) and back down to (9, 9): the edge (9, 0) to (9, 9) is left.
  RawMap raw = rawMap({{0, 0}, {9, 0}, {9, 12}, {9, 9}, {0, 9}});
  raw.polygons[0].outer.kinds[1] = EdgeKind::open;
  const RepairedMap repaired = repairMap(raw);
  EXPECT_THAT(texts(repaired.defects), ElementsAre("spike at (9.000, 12.000)"));
  EXPECT_DOUBLE_EQ(repaired.map.openPerimeter(), 9.0);
  // And the other way: past the start of the edge.
  raw = rawMap({{0, 0}, {9, 0}, {9, 9}, {12, 9}, {0, 9}});
  raw.polygons[0].outer.kinds[3] = EdgeKind::open;
  const RepairedMap other = repairMap(raw);
  EXPECT_THAT(texts(other.defects), ElementsAre("spike at (12.000, 9.000)"));
  EXPECT_DOUBLE_EQ(other.map.openPerimeter(), 9.0);
}

TEST(Validation, RefusesOuterRingsWithoutArea) {
  EXPECT_THAT(refusals(rawMap({{1, 2}, {3, 4}})),
              ElementsAre("outer ring with fewer than three vertices at (1.000, 2.000)"));
  EXPECT_THAT(refusals(rawMap({})), ElementsAre(HasSubstr("fewer than three vertices")));
  EXPECT_THAT(refusals(rawMap({{1, 2}, {3, 4}, {5, 6}})),
              ElementsAre("outer ring of zero area at (1.000, 2.000)"));
  EXPECT_THAT(refusals(rawMap(Points(5, {7, 7}))),
              ElementsAre("outer ring of zero area at (7.000, 7.000)"));
  EXPECT_THAT(refusals(rawMap({{0, 0}, {1e-300, 0}, {0, 1e-300}})),
              ElementsAre(HasSubstr("outer ring of zero area")));
}

TEST(Validation, DropsHolesWithoutArea) {
  const RepairedMap repaired =
      repairMap(rawMap(rectangle(0, 0, 9, 9), {{{1, 2}, {3, 4}, {5, 6}}, {{1, 1}, {2, 1}}, {}}));
  EXPECT_THAT(texts(repaired.defects),
              ElementsAre("hole of zero area at (1.000, 2.000)",
                          "hole with fewer than three vertices at (1.000, 1.000)",
                          HasSubstr("hole with fewer than three vertices")));
  EXPECT_EQ(repaired.map.holeCount(), 0U);
}

TEST(Validation, RefusesCoordinatesThatCannotBeUsed) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusals(rawMap({{0, 0}, {1, 0}, {nan, 1}})),
              ElementsAre(HasSubstr("not finite at (nan, 1.000)")));
  EXPECT_THAT(refusals(rawMap({{0, 0}, {1, 0}, {1, -inf}})), ElementsAre(HasSubstr("not finite")));
  EXPECT_THAT(refusals(rawMap({{0, 0}, {1e308, 0}, {0, 1e308}})),
              ElementsAre(HasSubstr("beyond 1e9 m")));
  RawMap raw = rawMap(rectangle(0, 0, 9, 9), {{{1, 1}, {nan, nan}, {2, 1}}});
  raw.walls_beyond = {{{0, 0}, {inf, 0}}};
  EXPECT_THAT(refusals(raw), UnorderedElementsAre(HasSubstr("not finite at (inf, 0.000)"),
                                                  HasSubstr("not finite at (nan, nan)")));
}

TEST(Validation, TakesTinyAndHugeButUsableCoordinates) {
  EXPECT_THAT(refusals(rawMap({{0, 0}, {1e9, 0}, {0, 1e9}, {1e-300, 5}})), IsEmpty());
  EXPECT_THAT(refusals(rawMap({{0, 0}, {9, 1e-300}, {9, 9}, {-1e-300, 9}, {1e-308, 4}})),
              IsEmpty());
}

TEST(Validation, RefusesAMapOfNothing) {
  EXPECT_EQ(messageOf<InvalidMapError>([] { repairMap({}); }), "the map has no free space");
  EXPECT_FALSE(inspectMap({}).map.has_value());
}

TEST(Validation, RefusesEdgeKindsThatDoNotMatch) {
  RawMap raw = rawMap(rectangle(0, 0, 9, 9));
  raw.polygons[0].outer.kinds.pop_back();
  EXPECT_THAT(refusals(raw), ElementsAre(HasSubstr("edge kinds do not match")));
}

TEST(Validation, RefusesALargeSelfCrossingWhereItIs) {
  EXPECT_THAT(refusals(rawMap({{0, 0}, {4, 4}, {4, 0}, {0, 4}})),
              ElementsAre("self-crossing ring at (2.000, 2.000)"));
  // The same with a vertex at the crossing.
  EXPECT_THAT(refusals(rawMap({{0, 0}, {2, 2}, {4, 4}, {4, 0}, {2, 2}, {0, 4}})),
              ElementsAre("self-crossing ring at (2.000, 2.000)"));
  EXPECT_EQ(messageOf<InvalidMapError>([] {
              repairMap(rawMap({{0, 0}, {4, 4}, {4, 0}, {0, 4}}));
            }),
            "the map cannot be used, 1 defect: self-crossing ring at (2.000, 2.000)");
}

TEST(Validation, ListsTheFirstTenOfManyDefects) {
  Points zigzag{{0, 1}, {0, -1}};  // crosses its way back between each two of its teeth
  for (int i = 1; i <= 40; ++i) zigzag.emplace_back(i, i % 2 == 0 ? -1.0 : 1.0);
  zigzag.emplace_back(41, 0.1);
  const std::string message = messageOf<InvalidMapError>([&] { repairMap(rawMap(zigzag)); });
  EXPECT_THAT(message, AllOf(HasSubstr("defects: self-crossing ring at ("), HasSubstr("more")));
  EXPECT_EQ(std::count(message.begin(), message.end(), '('), 10);
}

TEST(Validation, RefusesALoopRunThroughTwice) {
  EXPECT_THAT(refusals(rawMap({{0, 0}, {9, 0}, {0, 9}, {0, 0}, {4, 1}, {1, 4}})),
              ElementsAre("self-crossing ring at (0.000, 0.000)"));
}

TEST(Validation, RepairsATinySelfCrossing) {
  // Two vertices swapped: a loop of 0.01 m x 0.01 m the wrong way around.
  RawMap raw = rawMap({{0, 0}, {10, 0}, {10, 5.01}, {9.99, 5}, {10, 5}, {10, 10}, {0, 10}});
  raw.polygons[0].outer.vertices = {{0, 0},  {10, 0},  {10, 5.01}, {10.01, 5.01},
                                    {10, 5}, {10, 10}, {0, 10}};
  raw.polygons[0].outer.kinds[5] = EdgeKind::open;  // the top
  const RepairedMap repaired = repairMap(raw);
  EXPECT_FALSE(repaired.defects.empty());
  EXPECT_EQ(repaired.defects.size(), repaired.repairs.size());
  EXPECT_NEAR(repaired.map.area(), 100.0, 1e-3);
  EXPECT_DOUBLE_EQ(repaired.map.openPerimeter(), 10.0);
  expectSound(repaired.map);
}

TEST(Validation, RepairsCrossingsWhoseRoundedPointsBendTheEdges) {
  // Edges nearly parallel, crossing far from representable points, at large coordinates.
  const double x = 1e6, y = 3e6;
  const RepairedMap repaired = repairMap(rawMap({{x, y},
                                                 {x + 100, y},
                                                 {x + 100, y + 33.1},
                                                 {x + 99.99, y + 70},
                                                 {x + 99.9903, y + 33.2},
                                                 {x + 99.99, y + 90},
                                                 {x, y + 90}}));
  EXPECT_THAT(texts(repaired.defects), testing::Each(HasSubstr("self-crossing ring")));
  EXPECT_FALSE(repaired.defects.empty());
  expectSound(repaired.map);
}

TEST(Validation, KeepsRingsThatTouchAtPoints) {
  const RepairedMap pinched =  // an outer ring that touches itself
      repairMap(rawMap({{0, 0}, {4, 4}, {8, 0}, {8, 8}, {4, 4}, {0, 8}}));
  EXPECT_THAT(pinched.defects, IsEmpty());
  EXPECT_EQ(pinched.map.vertexCount(), 6U);
  const RepairedMap touching = repairMap(
      rawMap(rectangle(0, 0, 9, 9), {{{0, 3}, {3, 2}, {3, 4}}, {{3, 3}, {5, 2}, {5, 4}}}));
  EXPECT_THAT(touching.defects, IsEmpty());
  const RepairedMap corner =
      repairMap(rawMap(rectangle(0, 0, 2, 2)) + rawMap(rectangle(2, 2, 4, 4)));
  EXPECT_THAT(corner.defects, IsEmpty());
  EXPECT_EQ(corner.map.components().size(), 2U);
}

TEST(Validation, DropsHolesWithoutEffect) {
  const RepairedMap repaired =
      repairMap(rawMap(rectangle(0, 0, 9, 9), {rectangle(20, 0, 21, 1), rectangle(2, 2, 6, 6),
                                               rectangle(3, 3, 4, 4), rectangle(2, 2, 6, 6)}));
  EXPECT_THAT(texts(repaired.defects),
              UnorderedElementsAre("hole outside its polygon at (20.000, 0.000)",
                                   "hole inside another hole at (3.000, 3.000)",
                                   "hole inside another hole at (2.000, 2.000)"));
  EXPECT_EQ(repaired.map.holeCount(), 1U);
  EXPECT_DOUBLE_EQ(repaired.map.area(), 81.0 - 16.0);
}

TEST(Validation, DropsAHoleOutsideThatCrossesAnotherComponent) {
  const RepairedMap repaired = repairMap(rawMap(rectangle(0, 0, 2, 2), {rectangle(5, 1, 7, 3)}) +
                                         rawMap(rectangle(4, 0, 6, 2)));
  EXPECT_THAT(texts(repaired.defects), ElementsAre("hole outside its polygon at (5.000, 1.000)"));
  EXPECT_DOUBLE_EQ(repaired.map.area(), 8.0);
}

TEST(Validation, UnitesOverlappingHoles) {
  RawMap raw = rawMap(rectangle(0, 0, 9, 9), {rectangle(1, 1, 4, 4), rectangle(3, 3, 6, 6)});
  raw.polygons[0].holes[1].kinds[2] = EdgeKind::open;  // (6, 6) to (3, 6)
  const RepairedMap repaired = repairMap(raw);
  EXPECT_THAT(texts(repaired.defects), UnorderedElementsAre("overlapping holes at (3.000, 4.000)",
                                                            "overlapping holes at (4.000, 3.000)"));
  EXPECT_EQ(repaired.map.holeCount(), 1U);
  EXPECT_DOUBLE_EQ(repaired.map.area(), 81.0 - 9.0 - 9.0 + 1.0);
  EXPECT_DOUBLE_EQ(repaired.map.openPerimeter(), 3.0);
  expectSound(repaired.map);
}

TEST(Validation, UnitesHolesThatCrossOnlyAtVertices) {
  const RepairedMap repaired =  // a square and a diamond through the middle of two of its sides
      repairMap(rawMap(rectangle(0, 0, 9, 9), {{{2, 2}, {4, 2}, {4, 3}, {4, 4}, {2, 4}},
                                               {{3, 3}, {4, 2}, {6, 3}, {4, 4}}}));
  EXPECT_THAT(texts(repaired.defects), ElementsAre(HasSubstr("overlapping holes at (4.000, ")));
  EXPECT_DOUBLE_EQ(repaired.map.area(), 81.0 - 4.0 - 2.0);
  expectSound(repaired.map);
}

TEST(Validation, JoinsRingsThatShareAnEdge) {
  const RepairedMap holes =
      repairMap(rawMap(rectangle(0, 0, 9, 9), {rectangle(1, 1, 3, 3), rectangle(3, 2, 5, 4)}));
  EXPECT_THAT(texts(holes.defects), ElementsAre("holes sharing an edge at (3.000, 2.500)"));
  EXPECT_EQ(holes.map.holeCount(), 1U);
  EXPECT_DOUBLE_EQ(holes.map.area(), 81.0 - 8.0);
  const RepairedMap notch = repairMap(rawMap(rectangle(0, 0, 9, 9), {rectangle(0, 3, 2, 5)}));
  EXPECT_THAT(texts(notch.defects),
              ElementsAre("hole sharing an edge with the outer ring at (0.000, 4.000)"));
  EXPECT_EQ(notch.map.holeCount(), 0U);
  EXPECT_DOUBLE_EQ(notch.map.area(), 77.0);
  EXPECT_EQ(notch.map.vertexCount(), 8U);
}

TEST(Validation, AHoleFromWallToWallLeavesTwoComponents) {
  const RepairedMap cut = repairMap(rawMap(rectangle(0, 0, 9, 9), {rectangle(3, 0, 4, 9)}));
  EXPECT_EQ(cut.map.components().size(), 2U);
  EXPECT_DOUBLE_EQ(cut.map.area(), 72.0);
}

TEST(Validation, OpensAKeyholeIntoAHole) {
  const RepairedMap repaired = repairMap(rawMap(
      {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 3}, {3, 3}, {3, 5}, {5, 5}, {5, 3}, {3, 3}, {0, 3}}));
  EXPECT_THAT(texts(repaired.defects), ElementsAre("ring overlapping itself at (1.500, 3.000)"));
  EXPECT_EQ(repaired.map.holeCount(), 1U);
  EXPECT_DOUBLE_EQ(repaired.map.area(), 77.0);
  expectSound(repaired.map);
}

TEST(Validation, WhereWallAndOpenEdgeCoincideTheWallStands) {
  RawMap raw = rawMap(rectangle(0, 0, 9, 9), {rectangle(0, 3, 2, 5), rectangle(4, 4, 6, 6)});
  for (EdgeKind& kind : raw.polygons[0].outer.kinds) kind = EdgeKind::open;
  const RepairedMap repaired = repairMap(raw);
  EXPECT_DOUBLE_EQ(repaired.map.openPerimeter(), 36.0 - 2.0);
  EXPECT_DOUBLE_EQ(repaired.map.perimeter(), 36.0 - 2.0 + 6.0 + 8.0);
}

TEST(Validation, RefusesAHoleAcrossTheOuterRing) {
  EXPECT_THAT(refusals(rawMap(rectangle(0, 0, 9, 9), {rectangle(8, 3, 11, 5)})),
              UnorderedElementsAre("hole crossing the outer ring at (9.000, 3.000)",
                                   "hole crossing the outer ring at (9.000, 5.000)"));
}

TEST(Validation, CutsAHoleThatBarelyCrossesTheOuterRing) {
  const RepairedMap repaired =
      repairMap(rawMap(rectangle(0, 0, 9, 9), {rectangle(8, 3, 9.001, 5)}));
  EXPECT_THAT(repaired.defects, testing::SizeIs(2));
  EXPECT_DOUBLE_EQ(repaired.map.area(), 79.0);
  EXPECT_EQ(repaired.map.holeCount(), 0U);
}

TEST(Validation, RefusesHolesThatLeaveNothing) {
  EXPECT_THAT(refusals(rawMap(rectangle(0, 0, 9, 9), {rectangle(0, 0, 9, 9)})),
              testing::Contains(HasSubstr("no free space")));
}

TEST(Validation, RefusesOverlappingComponents) {
  EXPECT_THAT(refusals(rawMap(rectangle(0, 0, 4, 4)) + rawMap(rectangle(3, 3, 6, 6))),
              UnorderedElementsAre("overlapping components at (3.000, 4.000)",
                                   "overlapping components at (4.000, 3.000)"));
  EXPECT_THAT(refusals(rawMap(rectangle(0, 0, 9, 9)) + rawMap(rectangle(3, 3, 6, 6))),
              ElementsAre("overlapping components at (3.000, 3.000)"));
  EXPECT_THAT(refusals(rawMap(rectangle(0, 0, 4, 4)) + rawMap(rectangle(4, 1, 6, 3))),
              ElementsAre("components sharing an edge at (4.000, 2.000)"));
}

TEST(Validation, AComponentInsideAHoleOfAnotherIsLegal) {
  const RepairedMap repaired = repairMap(rawMap(rectangle(0, 0, 9, 9), {rectangle(2, 2, 7, 7)}) +
                                         rawMap(rectangle(3, 3, 6, 6), {rectangle(4, 4, 5, 5)}));
  EXPECT_THAT(repaired.defects, IsEmpty());
  EXPECT_DOUBLE_EQ(repaired.map.area(), 81.0 - 25.0 + 9.0 - 1.0);
}

TEST(Validation, CleansWallsBeyond) {
  RawMap raw = rawMap(rectangle(0, 0, 9, 9));
  raw.walls_beyond = {{{10, 0}, {10, 0}, {10, 5}}, {{11, 1}, {11, 1}}, {}, {{12, 0}, {12, 1}}};
  const RepairedMap repaired = repairMap(raw);
  EXPECT_EQ(repaired.map.wallsBeyond().size(), 2U);
  EXPECT_THAT(texts(repaired.defects), testing::Contains(HasSubstr("of no length at (11.000, ")));
  EXPECT_EQ(repaired.defects.size(), repaired.repairs.size());
}

TEST(Validation, StopsAtTooManyCrossings) {
  Points star;  // all chords cross
  const int n = 401;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * M_PI * ((i * (n / 2)) % n) / n;
    star.emplace_back(std::cos(angle), std::sin(angle));
  }
  const MapInspection inspection = inspectMap(rawMap(star));
  EXPECT_FALSE(inspection.map.has_value());
  EXPECT_GT(inspection.defects.size(), 10000U);
  EXPECT_THAT(inspection.unrepaired.back().what, HasSubstr("more than 10000 crossings"));
}

TEST(Validation, ManySpokesThroughOnePointEndWell) {
  Points spokes;
  for (int i = 0; i < 300; ++i) {
    spokes.emplace_back(0, 0);
    spokes.emplace_back(std::cos(0.02 * i), std::sin(0.02 * i));
    spokes.emplace_back(std::cos(0.02 * i + 0.01), std::sin(0.02 * i + 0.01));
  }
  const RepairedMap repaired = repairMap(rawMap(spokes));
  EXPECT_THAT(repaired.defects, IsEmpty());
  EXPECT_NEAR(repaired.map.area(), 300 * 0.5 * std::sin(0.01), 1e-12);
}

TEST(Validation, ManyNestedHolesEndWell) {
  std::vector<Points> holes;
  for (int i = 1; i < 400; ++i) holes.push_back(rectangle(i, i, 1000 - i, 1000 - i));
  const RepairedMap repaired = repairMap(rawMap(rectangle(0, 0, 1000, 1000), holes));
  EXPECT_EQ(repaired.map.holeCount(), 1U);
  EXPECT_EQ(repaired.defects.size(), 398U);
}

TEST(Validation, ManyNestedComponentsEndWell) {
  RawMap raw;
  for (int i = 0; i < 400; ++i) raw = raw + rawMap(rectangle(i, i, 1000 - i, 1000 - i));
  EXPECT_THAT(refusals(raw), testing::SizeIs(399));  // one for each region of several
}

TEST(Validation, NamesPlacesToTheMillimetre) {
  EXPECT_EQ(toString(Defect{"spike", {1.23456, -0.5}}), "spike at (1.235, -0.500)");
  EXPECT_THAT(toString(Defect{"spike", {1e308, 0}}), HasSubstr("spike at (1000"));
}

}  // namespace
}  // namespace mrpt_polyloc::test
