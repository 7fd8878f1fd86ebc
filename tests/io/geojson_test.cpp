#include "tests/support/map_factories.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/geojson.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace mrpt_polyloc::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const char* const kRoom =
    R"({"type": "Feature", "properties": {"kind": "free"}, "geometry": {"type": "Polygon",
        "coordinates": [[[0, 0], [4, 0], [4, 3], [0, 3], [0, 0]], [[1, 1], [1, 2], [2, 1]]]}})";

std::string feature(const std::string& kind, const std::string& type,
                    const std::string& coordinates) {
  return R"({"type": "Feature", "properties": {"kind": ")" + kind +
         R"("}, "geometry": {"type": ")" + type + R"(", "coordinates": )" + coordinates + "}}";
}

std::string collection(const std::vector<std::string>& features) {
  std::string text = R"({"type": "FeatureCollection", "features": [)";
  for (std::size_t i = 0; i < features.size(); ++i) text += (i > 0 ? "," : "") + features[i];
  return text + "]}";
}

RawMap parse(const std::vector<std::string>& features) {
  return parseGeoJson(collection(features), "map.geojson");
}

std::string geoJsonErrorOf(const std::string& text) {
  return messageOf<FormatError>([&] { parseGeoJson(text, "map.geojson"); });
}

TEST(GeoJson, ReadsFreeSpaceOpenEdgesAndWallsBeyond) {
  const RawMap map =
      parse({feature("open", "LineString", "[[4, 0], [4, 3], [0, 3]]"), kRoom,
             feature("wall", "MultiLineString", "[[[9, 0], [9, 1]], [[8, 8], [7, 7]]]"),
             feature("wall", "LineString", "[[6, 0], [6, 1], [6, 2]]"),
             feature("free", "MultiPolygon", "[[[[10, 0], [11, 0], [11, 1]]]]")});
  ASSERT_EQ(map.polygons.size(), 2U);
  EXPECT_THAT(map.polygons[0].outer.kinds,
              testing::ElementsAre(EdgeKind::wall, EdgeKind::open, EdgeKind::open, EdgeKind::wall));
  EXPECT_EQ(map.polygons[0].holes.size(), 1U);
  EXPECT_EQ(map.walls_beyond.size(), 3U);
  EXPECT_EQ(map.walls_beyond[2].size(), 3U);
}

TEST(GeoJson, OpenLinesRunEitherWayAndSnap) {
  const RawMap map =
      parse({kRoom, feature("open", "MultiLineString",
                            "[[[0.0000005, 0], [0, 2.9999995]], [[1, 2], [1, 1]]]")});
  EXPECT_EQ(map.polygons[0].outer.kinds[3], EdgeKind::open);
  EXPECT_EQ(map.polygons[0].holes[0].kinds[0], EdgeKind::open);
  EXPECT_EQ(map.polygons[0].outer.vertices[0], TPoint2D(0, 0));  // the ring stays as it is
}

TEST(GeoJson, SnapsToTheExactVertexWhereSeveralAreNear) {
  const RawMap map =
      parse({feature("free", "Polygon", "[[[0, 0], [4, 0], [4, 3e-7], [4, 3], [0, 3]]]"),
             feature("open", "LineString", "[[4, 3e-7], [4, 3]]")});
  EXPECT_THAT(map.polygons[0].outer.kinds,
              testing::ElementsAre(EdgeKind::wall, EdgeKind::wall, EdgeKind::open, EdgeKind::wall,
                                   EdgeKind::wall));
}

TEST(GeoJson, OpenLinesOffTheBorderAreErrors) {
  const auto error = [](const std::string& line) {
    return geoJsonErrorOf(collection({kRoom, feature("open", "LineString", line)}));
  };
  EXPECT_THAT(error("[[4, 0], [4, 2.99999]]"),
              AllOf(HasSubstr("map.geojson: features[1].geometry.coordinates[1]: "),
                    HasSubstr("(4.000000, 2.999990) is no vertex")));
  EXPECT_THAT(error("[[4, 0], [0, 3]]"),
              AllOf(HasSubstr("features[1].geometry.coordinates[1]"),
                    HasSubstr("(4.000000, 0.000000) to (0.000000, 3.000000) is no edge")));
  EXPECT_THAT(error("[[4, 0]]"), HasSubstr("fewer than two positions"));
  EXPECT_THAT(error("[[4, 0], [1, 1]]"), HasSubstr("no edge"));  // vertices of two rings
  EXPECT_EQ(error("[[4, 0], [4, 3]]"), "");
}

TEST(GeoJson, ErrorsNameThePath) {
  const auto error = [](const std::string& coordinates) {
    return geoJsonErrorOf(collection({kRoom, kRoom, feature("free", "Polygon", coordinates)}));
  };
  EXPECT_EQ(error("[[[0, 0], [1, 0], [1, 1], [\"0\", 1]]]"),
            "map.geojson: features[2].geometry.coordinates[0][3][0]: expected a finite number");
  EXPECT_EQ(error("[[[0, 0], [1, 0], [1, 1], [5]]]"),
            "map.geojson: features[2].geometry.coordinates[0][3]: a position of 1 coordinates, "
            "expected [x, y]");
  EXPECT_THAT(error("[[[0, 0], null]]"), HasSubstr("coordinates[0][1]: expected a position"));
  EXPECT_THAT(error("[[0, 0], [1, 0]]"), HasSubstr("coordinates[0][0]: expected a position"));
  EXPECT_THAT(error("[5]"), HasSubstr("coordinates[0]: expected an array"));
  EXPECT_THAT(error("7"), HasSubstr("features[2].geometry.coordinates: expected an array"));
  EXPECT_EQ(error("[]"), "");  // an empty geometry
}

TEST(GeoJson, ErrorsNameTheFeatureOfAnUnknownKind) {
  EXPECT_EQ(geoJsonErrorOf(collection({kRoom, feature("door", "LineString", "[[0, 0], [1, 1]]")})),
            "map.geojson: features[1].properties.kind: unknown kind \"door\", expected \"free\", "
            "\"open\" or \"wall\"");
  EXPECT_THAT(geoJsonErrorOf(collection({R"({"type": "Feature", "properties": {"kind": 1}})"})),
              HasSubstr("features[0].properties.kind: expected a string"));
  EXPECT_THAT(geoJsonErrorOf(collection({feature("free", "LineString", "[]")})),
              HasSubstr("features[0].geometry.type: \"LineString\", expected \"Polygon\" or"));
  EXPECT_THAT(geoJsonErrorOf(collection({feature("wall", "Polygon", "[]")})),
              HasSubstr("expected \"LineString\" or \"MultiLineString\""));
  EXPECT_THAT(geoJsonErrorOf(collection({R"({"type": "Polygon"})"})),
              HasSubstr("expected \"Feature\""));
}

TEST(GeoJson, ReadsWhatOthersWrite) {
  const std::string polygon =
      R"({"type": "Polygon", "coordinates": [[[0, 0, 7], [4, 0, 7], [4, 3, 7], [0, 0, 7]]]})";
  const std::string unsaid = R"({"type": "Feature", "properties": {"name": "a"}, "geometry": )";
  for (const std::string& text :
       {polygon, R"({"type": "GeometryCollection", "geometries": [)" + polygon + "]}",
        unsaid + polygon + "}", R"({"type": "Feature", "geometry": )" + polygon + "}",
        collection({unsaid + polygon + "}",
                    R"({"type": "Feature", "properties": {"kind": "wall"}, "geometry": null})"}),
        collection({R"({"type": "Feature", "properties": null, "geometry": )" + polygon + "}",
                    unsaid + R"({"type": "Point", "coordinates": [1, 1]}})"})}) {
    Notes notes;
    const RawMap map = parseGeoJson(text, "map.geojson", &notes);
    ASSERT_EQ(map.polygons.size(), 1U) << text;
    EXPECT_EQ(map.polygons[0].outer.size(), 3U) << text;
    EXPECT_THAT(notes, testing::ElementsAre(HasSubstr("1 polygons are taken for free space")))
        << text;
  }
  EXPECT_EQ(parse({kRoom}).polygons.size(), 1U);
}

TEST(GeoJson, ErrorsOfTheDocument) {
  EXPECT_EQ(geoJsonErrorOf(""), "map.geojson: the file is empty");
  EXPECT_EQ(geoJsonErrorOf(" \n"), "map.geojson: the file is empty");
  EXPECT_THAT(geoJsonErrorOf("{\n  \"type\": nan}"), HasSubstr("map.geojson: line 2, column 12: "));
  EXPECT_THAT(geoJsonErrorOf(collection({kRoom}).substr(0, 100)), HasSubstr("map.geojson: line "));
  EXPECT_THAT(geoJsonErrorOf("[1, 1e999]"), HasSubstr("1e999"));
  EXPECT_THAT(geoJsonErrorOf("[]"), HasSubstr("expected an object"));
  EXPECT_THAT(geoJsonErrorOf("{}"), HasSubstr("has no \"type\""));
  EXPECT_THAT(geoJsonErrorOf(R"({"type": "Feature"})"), HasSubstr("has no \"geometry\""));
  EXPECT_THAT(geoJsonErrorOf(R"({"type": "Topology"})"),
              AllOf(HasSubstr("type: \"Topology\" is not \"FeatureCollection\""),
                    HasSubstr("a map looks like {\"type\": \"Feature\"")));
  EXPECT_THAT(geoJsonErrorOf(R"({"type": "Feature", "geometry": {"type": "Point"}})"),
              AllOf(HasSubstr("holds no polygon"), HasSubstr("a map looks like")));
  EXPECT_THAT(geoJsonErrorOf(R"({"type": "FeatureCollection"})"), HasSubstr("has no \"features\""));
  EXPECT_THAT(geoJsonErrorOf(R"({"type": "FeatureCollection", "features": {}})"),
              HasSubstr("features: expected an array"));
  EXPECT_THAT(geoJsonErrorOf("{\"type\": \"\xff\"}"), HasSubstr("map.geojson: line 1"));
}

TEST(GeoJson, ManyBracketsAreAnErrorNotACrash) {
  EXPECT_THAT(geoJsonErrorOf(std::string(1000000, '[')), HasSubstr("map.geojson: line 1"));
  EXPECT_NE(geoJsonErrorOf(std::string(200000, '[') + std::string(200000, ']')), "");
}

PolygonMap roundTrip(const PolygonMap& map) {
  const RepairedMap again = repairMap(parseGeoJson(toGeoJson(map), "map.geojson"));
  EXPECT_TRUE(again.defects.empty());
  return again.map;
}

TEST(GeoJson, RoundTripIsExactWithKindsAndWallsBeyond) {
  for (const auto& [name, plain] : namedMaps()) {
    for (const double fraction : {0.0, 0.3, 0.9, 1.0}) {
      SCOPED_TRACE(name);
      const PolygonMap open = withOpenEdges(plain, fraction, 5);
      EXPECT_EQ(roundTrip(open).hash(), open.hash());
      const PolygonMap map(open.components(),
                           {{{100, 1.0 / 3}, {101, 2}}, {{7, 7}, {8, 8}, {9, 7}}});
      EXPECT_EQ(roundTrip(map).hash(), map.hash());
    }
  }
  const PolygonMap two({freePolygon(rectangle(0, 0, 1, 1)), freePolygon(rectangle(2, 0, 3, 1))});
  EXPECT_EQ(roundTrip(two).hash(), two.hash());
}

TEST(GeoJson, TheCellSizeComesBackAndNonsenseIsRefused) {
  const PolygonMap drawn = squareMap(4.0);
  EXPECT_EQ(roundTrip(drawn).cellSize(), 0.0);
  const PolygonMap traced(drawn.components(), {}, 0.05);
  EXPECT_EQ(roundTrip(traced).cellSize(), 0.05);
  EXPECT_EQ(traced.hash(), drawn.hash());
  EXPECT_THROW(PolygonMap(drawn.components(), {}, -0.05), InvalidMapError);
  EXPECT_THROW(PolygonMap(drawn.components(), {}, std::nan("")), InvalidMapError);
  const std::string text = toGeoJson(traced);
  for (const char* bad : {"0", "-0.05", "\"5 cm\"", "null", "1e999"}) {
    std::string changed = text;
    changed.replace(changed.find("0.05"), 4, bad);
    EXPECT_THROW(parseGeoJson(changed, "x.geojson"), FormatError) << bad;
  }
}

TEST(GeoJson, RoundTripOfAMapWithManyOpenEdges) {
  const PolygonMap map = withOpenEdges(largeMap(), 0.5, 1);
  EXPECT_EQ(roundTrip(map).hash(), map.hash());
}

TEST(GeoJson, OpenEdgesAreWrittenAsMaximalRuns) {
  Ring ring = wallRing(rectangle(0, 0, 3, 2));
  ring.kinds = {EdgeKind::open, EdgeKind::open, EdgeKind::wall, EdgeKind::open};
  const nlohmann::json document = nlohmann::json::parse(toGeoJson(PolygonMap({{ring, {}}})));
  ASSERT_EQ(document["features"].size(), 2U);  // no walls beyond, no feature for them
  const nlohmann::json& open = document["features"][1];
  EXPECT_EQ(open["properties"]["kind"], "open");
  EXPECT_EQ(open["geometry"]["type"], "MultiLineString");
  EXPECT_EQ(open["geometry"]["coordinates"],
            nlohmann::json::parse("[[[0, 2], [0, 0], [3, 0], [3, 2]]]"));
  const nlohmann::json& free = document["features"][0]["geometry"];
  EXPECT_EQ(free["type"], "MultiPolygon");
  EXPECT_EQ(free["coordinates"][0][0].size(), 5U);  // closed, as RFC 7946 wants it
}

}  // namespace
}  // namespace mrpt_polyloc::test
