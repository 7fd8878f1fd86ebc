#include "tests/support/map_factories.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/polygon_files.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace mrpt_polyloc::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string readError(const std::string& path) {
  return messageOf<FormatError>([&] { readRawMap(path); });
}

TEST(PolygonFiles, ReadsByExtensionInAnyCase) {
  const PolygonMap map = pillarMap();
  const TempFile wkt(".WKT", toText(map, ".wkt"));
  const TempFile geojson(".GeoJSON", toText(map, ".geojson"));
  const TempFile json(".json", toText(map, ".GEOJSON"));
  const TempFile home(".json", R"({"verts": [[0, 0], [3, 0], [3, 1]], "type": "a home"})");
  EXPECT_EQ(loadPolygonMap(wkt.path()).map.hash(), map.hash());
  EXPECT_EQ(loadPolygonMap(geojson.path()).map.hash(), map.hash());
  EXPECT_EQ(loadPolygonMap(json.path()).map.hash(), map.hash());
  EXPECT_DOUBLE_EQ(loadPolygonMap(home.path()).map.area(), 1.5);
}

TEST(PolygonFiles, RefusesUnknownExtensions) {
  EXPECT_THAT(readError("/no/such/map.poly"),
              AllOf(StartsWith("/no/such/map.poly: unknown extension .poly"), HasSubstr(".wkt")));
  EXPECT_THAT(readError("map"), StartsWith("map: no extension"));
}

TEST(PolygonFiles, NamesFilesThatAreMissingEmptyOrNoFiles) {
  EXPECT_EQ(readError("/no/such/map.wkt"), "/no/such/map.wkt: no such file");
  for (const char* extension : {".wkt", ".geojson", ".json"}) {
    const TempFile empty(extension, "");
    EXPECT_EQ(readError(empty.path()), empty.path() + ": empty file");
  }
  const std::string folder =
      (std::filesystem::temp_directory_path() / "polyloc_test_folder.wkt").string();
  std::filesystem::create_directory(folder);
  EXPECT_EQ(readError(folder), folder + ": is a directory, not a file");
  std::filesystem::remove(folder);
}

TEST(PolygonFiles, InvalidMapsNameTheFileAndThePlace) {
  const TempFile bow_tie(".wkt", "POLYGON ((0 0, 4 4, 4 0, 0 4))");
  EXPECT_EQ(
      messageOf<InvalidMapError>([&] { loadPolygonMap(bow_tie.path()); }),
      bow_tie.path() + ": the map cannot be used, 1 defect: self-crossing ring at (2.000, 2.000)");
  const TempFile nothing(".wkt", "POLYGON EMPTY");
  EXPECT_EQ(messageOf<InvalidMapError>([&] { loadPolygonMap(nothing.path()); }),
            nothing.path() + ": the map has no free space");
}

TEST(PolygonFiles, UnitesRoomsSideBySide) {
  const std::string left = "POLYGON((0 0, 5 0, 5 8, 0 8, 0 0))\n";
  const TempFile halves(".wkt", left + "POLYGON((5 0, 10 0, 10 8, 5 8, 5 0))\n");
  Notes notes;
  const RepairedMap map = loadPolygonMap(halves.path(), &notes);
  EXPECT_DOUBLE_EQ(map.map.area(), 80.0);
  EXPECT_EQ(map.map.components().size(), 1U);
  EXPECT_FALSE(map.defects.empty());
  EXPECT_THAT(notes,
              testing::ElementsAre(AllOf(HasSubstr("2 polygons"), HasSubstr("united to 1"))));

  // Rooms with a wall of 0.1 m between them, and a door of 1 m in it.
  const TempFile door(".wkt", left +
                                  "POLYGON((5.1 0, 10 0, 10 8, 5.1 8, 5.1 0))\n"
                                  "POLYGON((4.9 3, 5.2 3, 5.2 4, 4.9 4, 4.9 3))\n");
  EXPECT_NEAR(loadPolygonMap(door.path()).map.area(), 79.2 + 0.1, 1e-9);
  EXPECT_EQ(loadPolygonMap(door.path()).map.components().size(), 1U);
  // Rooms that do not touch stay apart, without a word.
  const TempFile apart(".wkt", left + "POLYGON((5.1 0, 10 0, 10 8, 5.1 8, 5.1 0))\n");
  notes.clear();
  EXPECT_EQ(loadPolygonMap(apart.path(), &notes).map.components().size(), 2U);
  EXPECT_TRUE(notes.empty());
}

TEST(PolygonFiles, OpensDoorsThatAreDrawnAsLines) {
  // Two rooms with a wall of `gap` between them, in units of 1 / scale metres, and a line in it.
  const auto plan = [](double gap, const std::string& properties, double unit = 1.0) {
    const auto ring = [unit](double x0, double x1) {
      const auto at = [unit](double x, double y) {
        return "[" + std::to_string(x / unit) + "," + std::to_string(y / unit) + "]";
      };
      return R"({"type":"Feature","properties":null,"geometry":{"type":"Polygon","coordinates":[[)" +
             at(x0, 0) + "," + at(x1, 0) + "," + at(x1, 8) + "," + at(x0, 8) + "," + at(x0, 0) +
             "]]}},";
    };
    const std::string x = std::to_string((5.0 + 0.5 * gap) / unit);
    return R"({"type":"FeatureCollection","features":[)" + ring(0, 5) + ring(5 + gap, 10 + gap) +
           R"({"type":"Feature","properties":)" + properties +
           R"(,"geometry":{"type":"LineString","coordinates":[[)" + x + "," +
           std::to_string(3.0 / unit) + "],[" + x + "," + std::to_string(3.9 / unit) + "]]}}]}";
  };
  for (const char* says : {R"({"type": "Door"})", R"({"door": "yes"})", R"({"door": true})"}) {
    const TempFile file(".geojson", plan(0.2, says));
    Notes notes;
    const PolygonMap map = loadPolygonMap(file.path(), &notes).map;
    EXPECT_EQ(map.components().size(), 1U) << says;
    EXPECT_NEAR(map.area(), 80.0 + 0.9 * 0.2, 1e-5);  // the union is rounded
    EXPECT_TRUE(map.contains({5.1, 3.5}));
    EXPECT_FALSE(map.contains({5.1, 2.9}));
    EXPECT_THAT(notes, testing::Contains(HasSubstr("1 passages are opened")));
  }
  const TempFile small(".geojson", plan(0.2, R"({"door": true})", 0.001));
  EXPECT_EQ(loadPolygonMap(small.path(), nullptr, 0.001).map.components().size(), 1U);
  // A wall that is too thick, and lines of which nothing says that they are doors.
  for (const auto& [gap, says] : {std::pair{0.6, R"({"door": true})"},
                                  {0.2, R"({"door": "no"})"},
                                  {0.2, R"({"layer": "walls"})"},
                                  {0.2, "null"}}) {
    const TempFile file(".geojson", plan(gap, says));
    EXPECT_EQ(loadPolygonMap(file.path()).map.components().size(), 2U) << gap << says;
  }
}

TEST(PolygonFiles, RefusesWhatIsNotInMetres) {
  const auto error = [](const TempFile& file, double scale = 1.0) {
    try {
      loadPolygonMap(file.path(), nullptr, scale);
    } catch (const FormatError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const TempFile millimetres(".wkt", "POLYGON ((0 0, 11000 0, 11000 8500, 0 8500))");
  EXPECT_THAT(error(millimetres), AllOf(HasSubstr("93.5 square kilometres"),
                                        HasSubstr("millimetres? Then use --scale 0.001")));
  EXPECT_EQ(error(millimetres, 0.001), "");
  EXPECT_NEAR(loadPolygonMap(millimetres.path(), nullptr, 0.001).map.area(), 93.5, 1e-9);
  const TempFile degrees(".wkt", "POLYGON ((7 43, 7.0001 43, 7.0001 43.0001, 7 43.0001))");
  EXPECT_THAT(error(degrees), AllOf(HasSubstr("degrees"), HasSubstr("ogr2ogr")));
  const TempFile hall(".wkt", "POLYGON ((0 0, 1900 0, 1900 1900, 0 1900))");
  EXPECT_EQ(error(hall), "");
  EXPECT_THROW(loadPolygonMap(hall.path(), nullptr, 0.0), InvalidParamsError);
  EXPECT_THAT(messageOf<FormatError>([] { loadPolygonMap("plan.dxf"); }), HasSubstr("ogr2ogr"));
}

TEST(PolygonFiles, WritesByExtensionOnly) {
  EXPECT_THAT(messageOf<FormatError>([] { toText(squareMap(), ".svg"); }),
              AllOf(HasSubstr(".svg"), HasSubstr(".geojson or .wkt")));
  EXPECT_THAT(messageOf<FormatError>([] { toText(squareMap(), ""); }), HasSubstr("extension"));
}

}  // namespace
}  // namespace mrpt_polyloc::test
