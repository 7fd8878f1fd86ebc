#include "tests/support/map_factories.h"

#include <mrpt_polyloc/geometry/validation.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mrpt_polyloc::test {
namespace {

RawMap rawOf(const PolygonMap& map) {
  RawMap raw;
  for (const FreePolygon& component : map.components()) {
    raw.polygons.push_back({component.outer, component.holes});
  }
  raw.walls_beyond = map.wallsBeyond();
  return raw;
}

TEST(MapFactories, AllNamedMapsAreValidAndLeftAlone) {
  for (const auto& [name, map] : namedMaps()) {
    SCOPED_TRACE(name);
    const RepairedMap repaired = repairMap(rawOf(map));
    EXPECT_TRUE(repaired.defects.empty()) << toString(repaired.defects.front());
    EXPECT_TRUE(repaired.repairs.empty());
    EXPECT_EQ(repaired.map.hash(), map.hash());
  }
}

TEST(MapFactories, RandomMapsAreValid) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const PolygonMap map = withOpenEdges(randomMapWithHoles(40, 5, seed), 0.3, seed);
    const RepairedMap repaired = repairMap(rawOf(map));
    EXPECT_TRUE(repaired.defects.empty()) << toString(repaired.defects.front());
    EXPECT_EQ(repaired.map.hash(), map.hash());
  }
}

TEST(MapFactories, LargeMapOf35000VerticesAnd1600HolesIsValid) {
  const PolygonMap map = largeMap();
  EXPECT_GE(map.vertexCount(), 35000U);
  EXPECT_EQ(map.holeCount(), 1600U);
  const RepairedMap repaired = repairMap(rawOf(map));
  EXPECT_TRUE(repaired.defects.empty()) << toString(repaired.defects.front());
  EXPECT_EQ(repaired.map.hash(), map.hash());
}

}  // namespace
}  // namespace mrpt_polyloc::test
