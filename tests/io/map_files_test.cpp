#include "tests/support/bridge_files.h"
#include "tests/support/data_dir.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/bitmap_files.h>
#include <mrpt_polyloc/io/map_files.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace mrpt_polyloc {
namespace {

using test::formatErrorOf;
using testing::AllOf;
using testing::HasSubstr;

class MapFiles : public test::QuietTest {
 protected:
  std::string write(const std::string& name, const std::string& bytes) {
    test::writeFile(dir_.file(name), bytes);
    return dir_.file(name);
  }
};

TEST_F(MapFiles, TracesAGrid) {
  // A free room of 20 x 10 cells of 0.1 m inside one ring of walls, turned by 90 degrees.
  std::string pixels;
  for (int row = 0; row < 12; ++row) {
    for (int column = 0; column < 22; ++column) {
      const bool wall = row == 0 || row == 11 || column == 0 || column == 21;
      pixels += wall ? '\0' : '\xff';
    }
  }
  write("map.pgm", "P5 22 12 255\n" + pixels);
  const auto loaded = loadMap(
      write("map.yaml", "image: map.pgm\nresolution: 0.1\norigin: [5, 7, 1.5707963267948966]\n"));
  EXPECT_TRUE(loaded.defects.empty());
  EXPECT_NEAR(loaded.map.area(), 2.0, 1e-9);
  EXPECT_TRUE(loaded.map.contains({5 - 0.6, 7 + 1.1}));  // its middle
  EXPECT_TRUE(loaded.map.contains({5 - 1.05, 7 + 0.15}));
  EXPECT_FALSE(loaded.map.contains({5 + 0.6, 7 + 1.1}));
}

TEST_F(MapFiles, ReadsPolygons) {
  EXPECT_NEAR(loadMap(write("a.wkt", "POLYGON ((0 0, 4 0, 4 3, 0 3, 0 0))")).map.area(), 12, 1e-9);
  EXPECT_NEAR(loadMap(write("a.WKT", "POLYGON ((0 0, 4 0, 4 3, 0 3, 0 0))")).map.area(), 12, 1e-9);
  EXPECT_NEAR(loadMap(write("a.json", R"({"verts": [[0, 0], [4, 0], [4, 3], [0, 3]]})")).map.area(),
              12, 1e-9);
  EXPECT_NEAR(loadMap(write("a.geojson",
                            R"({"type": "FeatureCollection", "features": [{"type": "Feature",
                        "properties": {"kind": "free"}, "geometry": {"type": "Polygon",
                        "coordinates": [[[0, 0], [4, 0], [4, 3], [0, 3], [0, 0]]]}}]})"))
                  .map.area(),
              12, 1e-9);
}

TEST_F(MapFiles, RefusesUnknownExtensionsAndListsTheKnownOnes) {
  for (const std::string name : {"map.pgm", "map", "map.shp", ".yaml"}) {
    EXPECT_THAT(formatErrorOf([&] { loadMap(write(name, "x")); }),
                AllOf(HasSubstr("unknown extension"), HasSubstr(".geojson"), HasSubstr(".gridmap")))
        << name;
  }
}

TEST_F(MapFiles, RefusesMissingFiles) {
  for (const std::string name : {"a.yaml", "a.wkt", "a.geojson", "a.json", "a.simplemap.gz"}) {
    EXPECT_THAT(formatErrorOf([&] { loadMap(dir_.file(name)); }), HasSubstr(name)) << name;
  }
}

TEST_F(MapFiles, RefusesAGridWithoutFreeSpace) {
  write("map.pgm", "P5 3 1 255\n" + std::string(3, '\0'));
  EXPECT_THROW(loadMap(write("map.yaml", "image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n")),
               InvalidMapError);
}

TEST_F(MapFiles, AllEvaluationGridsAreTraced) {
  POLYLOC_DATA_OR_SKIP(data);
  for (const std::string& path : test::mapFolderFiles(data)) {
    const auto bitmap = loadBitmap(path);
    if (!bitmap) continue;
    const double free = bitmap->resolution * bitmap->resolution *
                        static_cast<double>(std::count(bitmap->cells.begin(), bitmap->cells.end(),
                                                       CellState::free));
    const auto loaded = loadMap(path);
    EXPECT_GT(loaded.map.area(), 0.9 * free) << path;
    EXPECT_LT(loaded.map.area(), 1.1 * free) << path;
  }
}

}  // namespace
}  // namespace mrpt_polyloc
