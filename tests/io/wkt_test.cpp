#include "tests/support/map_factories.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/wkt.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>

namespace mrpt_polyloc::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string wktErrorOf(const std::string& text) {
  return messageOf<FormatError>([&] { parseWkt(text, "plan.wkt"); });
}

TEST(Wkt, ReadsPolygonsAndMultipolygonsOneALine) {
  const RawMap map = parseWkt(
      "POLYGON ((0 0, 4 0, 4 4, 0 0), (1 1, 2 1, 2 2, 1 1))\r\n"
      "\n"
      "  multipolygon(((10 0,14 0,14 4)),((20 0,24 0,24 4),(21 1,22 1,22 2)))\n"
      "Polygon\n((-1.5e1 .5, +2 -3,\n 1 1))\n",
      "plan.wkt");
  ASSERT_EQ(map.polygons.size(), 4U);
  EXPECT_EQ(map.polygons[0].holes.size(), 1U);
  EXPECT_EQ(map.polygons[0].outer.size(), 4U);
  EXPECT_EQ(map.polygons[2].holes[0].vertices[1], TPoint2D(22, 1));
  EXPECT_EQ(map.polygons[3].outer.vertices[0], TPoint2D(-15, 0.5));
  EXPECT_EQ(map.polygons[3].outer.vertices[1], TPoint2D(2, -3));
  EXPECT_THAT(map.polygons[0].outer.kinds, testing::Each(EdgeKind::wall));
}

TEST(Wkt, EmptyGeometriesCountForNothing) {
  const RawMap map = parseWkt(
      "\xEF\xBB\xBFPOLYGON EMPTY\nmultipolygon empty\nMULTIPOLYGON (EMPTY, ((0 0, 1 0, 1 1)))",
      "plan.wkt");
  EXPECT_EQ(map.polygons.size(), 1U);
  EXPECT_TRUE(parseWkt("POLYGON EMPTY", "plan.wkt").polygons.empty());
}

TEST(Wkt, ErrorsNameFileLineAndColumn) {
  EXPECT_EQ(wktErrorOf("POLYGON ((0 0, 1 0, 1 1))\nPOINT (1 2)"),
            "plan.wkt: line 2, column 1: geometry type POINT: only POLYGON and MULTIPOLYGON can be "
            "a map, as POLYGON ((0 0, 10 0, 10 8, 0 8, 0 0)) in metres");
  EXPECT_EQ(wktErrorOf("POLYGON ((0 0, 1 0,\n  x 1))"),
            "plan.wkt: line 2, column 3: expected a number");
  EXPECT_EQ(wktErrorOf(""), "plan.wkt: line 1, column 1: the file is empty");
  EXPECT_THAT(wktErrorOf(" \n\t\n"), HasSubstr("the file is empty"));
}

TEST(Wkt, RefusesWhatIsNotAMap) {
  EXPECT_THAT(wktErrorOf("POLYGON ((0 0 0 0 0, 1 0, 1 1))"), HasSubstr("expected ',' or ')'"));
  EXPECT_THAT(wktErrorOf("POLYGON ((0 0, 1 0, 1 1));;"), HasSubstr("text after the end"));
  EXPECT_THAT(wktErrorOf("GEOMETRYCOLLECTION (POINT (1 2))"),
              HasSubstr("column 21: geometry type POINT"));
  EXPECT_THAT(wktErrorOf("POLYGON ((0 0, 1 0, nan 1))"), HasSubstr("not finite"));
  EXPECT_THAT(wktErrorOf("POLYGON ((0 0, 1 0, 1 -inf))"), HasSubstr("not finite"));
  EXPECT_THAT(wktErrorOf("POLYGON ((0 0, 1 0, 1 1e999))"), HasSubstr("out of range"));
  EXPECT_THAT(wktErrorOf("POLYGON ((0 0, 1 0, 1 1)) x"),
              HasSubstr("column 27: text after the end"));
  EXPECT_THAT(wktErrorOf("POLYGON ((0 0, 1 0, 1 1)) POLYGON EMPTY"),
              HasSubstr("text after the end"));
  EXPECT_THAT(wktErrorOf("POLYGON ((0 0, 1 0, 1 1)))"), HasSubstr("text after the end"));
  EXPECT_THAT(wktErrorOf("POLYGON ((0 0, 1 0, 1"), HasSubstr("the text ends"));
  EXPECT_THAT(wktErrorOf("POLYGON ((0 0, 1 0, 1 1)"), HasSubstr("the text ends"));
  EXPECT_THAT(wktErrorOf("POLYGON"), HasSubstr("the text ends"));
  EXPECT_THAT(wktErrorOf("POLYGON ()"), HasSubstr("expected '('"));
  EXPECT_THAT(wktErrorOf("POLYGON (())"), HasSubstr("expected a number"));
  EXPECT_THAT(wktErrorOf("POLYGON (EMPTY)"), HasSubstr("expected '('"));
  EXPECT_THAT(wktErrorOf("POLYGON EMPTYNESS"), HasSubstr("expected '(' or EMPTY"));
  EXPECT_THAT(wktErrorOf("POLYGON ((0,0, 1 0, 1 1))"), HasSubstr("expected a number"));
  EXPECT_THAT(wktErrorOf("POLYGON ((0 0; 1 0; 1 1))"), HasSubstr("expected ',' or ')'"));
  EXPECT_THAT(wktErrorOf("SRID=4326;POLYGON ((0 0, 1 0, 1 1))"),
              HasSubstr("column 1: SRID 4326 is degrees"));
  EXPECT_THAT(wktErrorOf("MULTIPOLYGON ((0 0, 1 0, 1 1))"), HasSubstr("expected '('"));
  EXPECT_THAT(wktErrorOf("{\"verts\": []}"), HasSubstr("expected POLYGON or MULTIPOLYGON"));
  EXPECT_THAT(wktErrorOf(std::string("POLYGON\0((0 0, 1 0, 1 1))", 25)), HasSubstr("expected '('"));
  EXPECT_THAT(wktErrorOf("POLYGON ((+-1 0, 1 0, 1 1))"), HasSubstr("expected a number"));
}

TEST(Wkt, ReadsWhatOthersWrite) {
  for (const char* text :
       {"POLYGON Z ((0 0 5, 1 0 5, 1 1 5))", "POLYGONZ((0 0 5,1 0 5,1 1 5))",
        "POLYGON zm ((0 0 1 2, 1 0 1 2, 1 1 1 2))", "POLYGON M ((0 0 1, 1 0 1, 1 1 1))",
        "POLYGON ((0 0 5, 1 0 5, 1 1 5))", "POLYGON ((0 0, 1 0, 1 1));",
        "SRID=25832;POLYGON ((0 0, 1 0, 1 1))", "srid=0; polygon ((0 0, 1 0, 1 1)) ;",
        "GEOMETRYCOLLECTION (POLYGON ((0 0, 1 0, 1 1)), POLYGON EMPTY)",
        "GEOMETRYCOLLECTION Z (GEOMETRYCOLLECTION (MULTIPOLYGON (((0 0 1, 1 0 1, 1 1 1)))))"}) {
    const RawMap map = parseWkt(text, "plan.wkt");
    ASSERT_EQ(map.polygons.size(), 1U) << text;
    ASSERT_EQ(map.polygons[0].outer.size(), 3U) << text;
    EXPECT_EQ(map.polygons[0].outer.vertices[1], TPoint2D(1, 0)) << text;
  }
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "GEOMETRYCOLLECTION (";
  EXPECT_THAT(wktErrorOf(deep), HasSubstr("more than 100 collections"));
}

TEST(Wkt, RoundTripIsExact) {
  std::vector<std::pair<const char*, PolygonMap>> maps = namedMaps();
  maps.emplace_back("two components",
                    PolygonMap({freePolygon(rectangle(0, 0, 1.0 / 3, 1e-7)),
                                freePolygon(rectangle(5, 5, 9, 9), {rectangle(6, 6, 7, 7.1)})}));
  for (const auto& [name, map] : maps) {
    SCOPED_TRACE(name);
    const std::string text = toWkt(map);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
    const RepairedMap again = repairMap(parseWkt(text, "plan.wkt"));
    EXPECT_TRUE(again.defects.empty());
    EXPECT_EQ(again.map.hash(), map.hash());
  }
}

TEST(Wkt, WritesPlainText) {
  EXPECT_EQ(toWkt(mapOf({{0, 0}, {0.1, 0}, {-0.25, 1e6}})),
            "POLYGON ((0 0, 0.1 0, -0.25 1000000, 0 0))\n");
  EXPECT_THAT(
      toWkt(PolygonMap({freePolygon(rectangle(0, 0, 1, 1)), freePolygon(rectangle(2, 0, 3, 1))})),
      StartsWith("MULTIPOLYGON (((0 0, 1 0, 1 1, 0 1, 0 0)), ((2 0,"));
}

TEST(Wkt, RefusesToWriteWhatItCannotSay) {
  Ring ring = wallRing(rectangle(0, 0, 1, 1));
  ring.kinds[0] = EdgeKind::open;
  const PolygonMap open({{ring, {}}});
  EXPECT_THAT(messageOf<InvalidMapError>([&] { toWkt(open); }),
              testing::AllOf(HasSubstr("open edges"), HasSubstr("use .geojson")));
  const PolygonMap beyond(squareMap().components(), {{{20, 0}, {20, 1}}});
  EXPECT_THAT(messageOf<InvalidMapError>([&] { toWkt(beyond); }),
              testing::AllOf(HasSubstr("walls beyond"), HasSubstr("use .geojson")));
}

TEST(Wkt, DoesNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) std::setlocale(LC_ALL, name);
  EXPECT_EQ(toWkt(mapOf({{0, 0}, {1.5, 0}, {0, 1.5}})), "POLYGON ((0 0, 1.5 0, 0 1.5, 0 0))\n");
  EXPECT_EQ(parseWkt("POLYGON ((0 0, 1.5 0, 0 1.5))", "p").polygons[0].outer.vertices[1].x, 1.5);
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace
}  // namespace mrpt_polyloc::test
