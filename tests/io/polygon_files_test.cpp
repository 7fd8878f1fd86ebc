#include "tests/support/map_factories.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/polygon_files.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
    EXPECT_EQ(readError(empty.path()), empty.path() + ": the file is empty");
  }
  const std::string folder =
      (std::filesystem::temp_directory_path() / "polyloc_test_folder.wkt").string();
  std::filesystem::create_directory(folder);
  EXPECT_EQ(readError(folder), folder + ": a directory, not a file");
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

TEST(PolygonFiles, WritesByExtensionOnly) {
  EXPECT_THAT(messageOf<FormatError>([] { toText(squareMap(), ".svg"); }),
              AllOf(HasSubstr(".svg"), HasSubstr(".geojson or .wkt")));
  EXPECT_THAT(messageOf<FormatError>([] { toText(squareMap(), ""); }), HasSubstr("extension"));
}

}  // namespace
}  // namespace mrpt_polyloc::test
