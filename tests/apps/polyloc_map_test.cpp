#include "ProgramTest.h"
#include <mrpt_polyloc/io/mrpt_archive.h>
#include <mrpt_polyloc/io/mrpt_compat.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace mrpt_polyloc::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class PolylocMap : public ProgramTest {
 protected:
  Outcome map(const std::vector<std::string>& arguments) const {
    return run("polyloc-map", arguments);
  }

  /// A room with an unambiguous defect: a vertex given twice.
  std::string repairableFile() const {
    return write("repairable.wkt", "POLYGON ((0 0, 4 0, 4 0, 4 3, 0 3, 0 0))\n");
  }

  /// Two triangles of 4 m2 each that share a crossing: which of them is free?
  std::string bowTieFile() const {
    return write("bowtie.wkt", "POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))\n");
  }
};

TEST_F(PolylocMap, JsonHasExactlyTheKeysOfTheDesign) {
  const Outcome outcome = map({roomFile(), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  const json report = json::parse(outcome.out);
  std::vector<std::string> keys;
  const auto ordered = nlohmann::ordered_json::parse(outcome.out);
  for (const auto& item : ordered.items()) keys.push_back(item.key());
  EXPECT_THAT(keys, ElementsAre("valid", "defects", "repairs", "vertices", "reflex_vertices",
                                "holes", "components", "area_m2", "perimeter_m", "open_perimeter_m",
                                "walls_beyond_m"));
  EXPECT_EQ(report["valid"], true);
  EXPECT_EQ(report["vertices"], 13);
  EXPECT_EQ(report["reflex_vertices"], 3 + 3);  // of the outline, and all of the pillar
  EXPECT_EQ(report["holes"], 1);
  EXPECT_EQ(report["components"], 1);
  EXPECT_NEAR(report["area_m2"].get<double>(), 36 + 1.8 - 0.9, 1e-9);
  EXPECT_EQ(report["open_perimeter_m"], 0.0);
}

TEST_F(PolylocMap, NotesWhatWasAssumed) {
  write("map.pgm", "P2 3 3 255\n0 0 0 0 254 0 205 205 0\n");
  const std::string yaml = write("map.yaml", "image: map.pgm\nresolution: 1\norigin: [0, 0, 0]\n");
  const Outcome outcome = map({yaml});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("polyloc-map: "), HasSubstr("map.yaml: note: "),
                                 HasSubstr("'free_thresh'")));
  EXPECT_THAT(outcome.out, HasSubstr("components    1"));
}

TEST_F(PolylocMap, ScalesWhatIsNotInMetres) {
  const std::string input = write("mm.wkt", "POLYGON ((0 0, 4000 0, 4000 3000, 0 3000))");
  EXPECT_THAT(map({input}).err, HasSubstr("--scale 0.001"));
  EXPECT_EQ(map({input}).code, 1);
  EXPECT_EQ(json::parse(map({input, "--scale", "0.001", "--json"}).out)["area_m2"], 12.0);
  EXPECT_EQ(map({input, "--scale", "-1"}).code, 2);
}

TEST_F(PolylocMap, ConvertsToGeoJsonAndBack) {
  ASSERT_EQ(map({roomFile(), "-o", path("room.geojson")}).code, 0);
  const json collection = json::parse(readFile(path("room.geojson")));
  EXPECT_EQ(collection["type"], "FeatureCollection");
  ASSERT_EQ(map({path("room.geojson"), "-o", path("again.wkt")}).code, 0);
  const json before = json::parse(map({roomFile(), "--json"}).out);
  const json after = json::parse(map({path("again.wkt"), "--json"}).out);
  EXPECT_EQ(before, after);
  EXPECT_THAT(files(), ElementsAre("again.wkt", "room.geojson", "room.wkt"));
}

TEST_F(PolylocMap, SaysWhatWktCannotSayOfATracedMap) {
  ASSERT_EQ(map({roomFile(), "-o", path("room.geojson")}).code, 0);
  json traced = json::parse(readFile(path("room.geojson")));
  traced["cell_size"] = 0.05;
  write("traced.geojson", traced.dump());
  for (const char* name : {"room.geojson", "traced.geojson"}) {
    const bool is_traced = std::string(name) == "traced.geojson";
    EXPECT_EQ(map({path(name), "-o", path("again.geojson")}).err, "");
    EXPECT_EQ(json::parse(readFile(path("again.geojson"))).count("cell_size"), is_traced ? 1U : 0U);
    const Outcome lossy = map({path(name), "-o", path("out.wkt")});
    EXPECT_EQ(lossy.code, 0);
    EXPECT_EQ(lossy.err.find("--cell-size 0.05") != std::string::npos, is_traced) << lossy.err;
  }
}

TEST_F(PolylocMap, DrawsTheMap) {
  ASSERT_EQ(map({roomFile(), "--svg", path("room.svg")}).code, 0);
  EXPECT_THAT(readFile(path("room.svg")), AllOf(HasSubstr("<svg xmlns"), HasSubstr("</svg>")));
}

TEST_F(PolylocMap, WritesASceneOfLinesThatMrptReads) {
  ASSERT_EQ(map({roomFile(), "--3dscene", path("room.3Dscene")}).code, 0);
  GzInputStream file(path("room.3Dscene"));
  const auto scene = std::dynamic_pointer_cast<Scene>(readObject(file, 0));
  ASSERT_TRUE(scene);
  const auto walls = scene->getByClass<drawn::CSetOfLines>(0);
  ASSERT_TRUE(walls);
  EXPECT_EQ(walls->size(), 13U);
  EXPECT_TRUE(file.atEnd());
}

TEST_F(PolylocMap, ARepairedMapIsDoneWithWarnings) {
  const Outcome outcome = map({repairableFile(), "-o", path("out.wkt")});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("polyloc-map: warning: "), HasSubstr("repairable.wkt"),
                                 HasSubstr("(4.000, 0.000)")));
  EXPECT_EQ(json::parse(map({path("out.wkt"), "--json"}).out)["vertices"], 4);
}

TEST_F(PolylocMap, CheckFailsOnRepairedDefectsAndListsThem) {
  EXPECT_EQ(map({roomFile(), "--check"}).code, 0);
  const Outcome outcome = map({repairableFile(), "--check"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("defect: "), HasSubstr("(4.000, 0.000)")));
  const json report = json::parse(map({repairableFile(), "--check", "--json"}).out);
  EXPECT_EQ(report["valid"], false);
  ASSERT_EQ(report["defects"].size(), 1u);
  EXPECT_EQ(report["defects"][0]["x"], 4.0);
  EXPECT_EQ(report["defects"][0]["y"], 0.0);
  EXPECT_EQ(report["repairs"].size(), 1u);
}

TEST_F(PolylocMap, AMapThatCannotBeRepairedIsRefusedWithItsDefects) {
  const Outcome outcome = map({bowTieFile(), "-o", path("out.wkt"), "--json"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("bowtie.wkt"), HasSubstr("(2.000, 2.000)")));
  const json report = json::parse(outcome.out);
  EXPECT_EQ(report["valid"], false);
  ASSERT_GE(report["defects"].size(), 1u);
  EXPECT_EQ(report["defects"][0]["x"], 2.0);
  EXPECT_THAT(report["repairs"], IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(path("out.wkt")));
  EXPECT_THAT(map({bowTieFile(), "--check"}).out, HasSubstr("(2.000, 2.000)"));
}

/// Bad input: exit code 1, the message names the file and says what is wrong, nothing is written.
TEST_F(PolylocMap, BadInputFailsWithAMessage) {
  const auto expectFailure = [&](const std::string& input, const std::string& reason) {
    const Outcome outcome = map({input, "-o", path("out.geojson")});
    EXPECT_EQ(outcome.code, 1) << input;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(input), HasSubstr(reason)));
    EXPECT_FALSE(std::filesystem::exists(path("out.geojson")));
  };
  expectFailure("missing.wkt", "no such file");
  expectFailure("missing.geojson", "no such file");
  expectFailure("missing.yaml", "no such file");
  expectFailure("missing.simplemap.gz", "no such file");
  write("map.dxf", "x");
  expectFailure("map.dxf", ".dxf");
  for (const char* name : {"empty.wkt", "empty.geojson", "empty.json", "empty.yaml",
                           "empty.gridmap", "empty.simplemap"}) {
    write(name, "");
    expectFailure(name, "");
  }
  write("lonely.yaml",
        "image: gone.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
        "free_thresh: 0.196\n");
  expectFailure("lonely.yaml", "gone.pgm");
  write("broken.wkt", "POLYGON ((0 0, 1 0, 1 x, 0 0))\n");
  expectFailure("broken.wkt", "line 1");
  write("none.wkt", "POLYGON EMPTY\n");
  expectFailure("none.wkt", "");
}

TEST_F(PolylocMap, AGridWithoutFreeSpaceFails) {
  write("black.yaml",
        "image: black.pgm\nresolution: 1.0\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
        "free_thresh: 0.196\n");
  write("black.pgm", std::string("P5\n4 4\n255\n") + std::string(16, '\0'));
  const Outcome outcome = map({"black.yaml"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("black.yaml"), HasSubstr("free")));
}

TEST_F(PolylocMap, UnwritableOutputFails) {
  const std::string room = roomFile();
  for (const char* option : {"-o", "--svg", "--3dscene"}) {
    const std::string inside_a_file = room + "/out.geojson";
    Outcome outcome = map({room, option, inside_a_file});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(inside_a_file), HasSubstr("Not a directory")));
    outcome = map({room, option, path("none/out.geojson")});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("none/out.geojson"));
  }
  const Outcome outcome = map({room, "-o", path("out.png")});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("out.png"), HasSubstr(".geojson")));
  EXPECT_THAT(files(), ElementsAre("room.wkt"));
}

TEST_F(PolylocMap, OpenEdgesDoNotGoIntoWkt) {
  write("open.geojson", R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"kind": "free"}, "geometry": {"type": "Polygon",
     "coordinates": [[[0, 0], [4, 0], [4, 3], [0, 3], [0, 0]]]}},
    {"type": "Feature", "properties": {"kind": "open"}, "geometry": {"type": "LineString",
     "coordinates": [[4, 0], [4, 3]]}}]})");
  EXPECT_EQ(json::parse(map({"open.geojson", "--json"}).out)["open_perimeter_m"], 3.0);
  const Outcome outcome = map({"open.geojson", "-o", path("out.wkt")});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("out.wkt"), HasSubstr("open")));
  EXPECT_FALSE(std::filesystem::exists(path("out.wkt")));
}

TEST_F(PolylocMap, CountsAndDrawsTheCells) {
  // An L: its reflex vertex hides four vertices, each behind a segment of its own.
  const std::string file = write("l.wkt", "POLYGON ((0 0, 12 0, 12 4, 5 4, 5 10, 0 10, 0 0))\n");
  const Outcome outcome = map({file, "--cells", "--json", "--svg", path("l.svg")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json report = json::parse(outcome.out);
  EXPECT_EQ(report["cells"], 5);
  EXPECT_EQ(report["windows"], 4);
  EXPECT_GE(report["cell_build_s"], 0.0);
  EXPECT_GT(report["cell_mb"], 0.0);
  EXPECT_THAT(readFile(path("l.svg")), HasSubstr("critical segment"));
}

TEST_F(PolylocMap, RefusesTooManyVisibilityCellsWithTheirCount) {
  std::string text = "POLYGON ((0 0, 27 0, 27 27, 0 27, 0 0)";
  for (int x = 1; x < 9; ++x) {
    for (int y = 1; y < 9; ++y) {  // pillars, none in line with others
      const double a = 3.0 * x + 0.13 * y, b = 3.0 * y + 0.17 * x;
      const auto corner = [](double u, double v) {
        return std::to_string(u) + " " + std::to_string(v);
      };
      text += ", (" + corner(a, b) + ", " + corner(a, b + 0.5) + ", " + corner(a + 0.5, b + 0.5) +
              ", " + corner(a + 0.5, b) + ", " + corner(a, b) + ")";
    }
  }
  const std::string hall = write("hall.wkt", text + ")\n");
  const Outcome outcome = map({hall, "--cells", "--svg", path("cells.svg")});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("visibility cells, more than the budget of 1000000"));
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(path("cells.svg")));

  const Outcome limited = map({hall, "--cells", "--range", "4", "--json"});
  ASSERT_EQ(limited.code, 0) << limited.err;
  const json report = json::parse(limited.out);
  EXPECT_GT(report["cells"], 1000);
  EXPECT_LT(report["cells"], 100000);
}

TEST_F(PolylocMap, WritesWhatIsSeenFromAPoint) {
  const std::string square = write("square.wkt", "POLYGON ((1 1, 5 1, 5 4, 1 4, 1 1))\n");
  const Outcome outcome = map({square, "--view", "2,2", "-o", path("view.wkt")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  // The room itself, relative to the point, from any of its corners on.
  const std::string corners = "-1 -1, 3 -1, 3 2, -1 2, -1 -1, 3 -1, 3 2, -1 2";
  const std::string text = readFile(path("view.wkt"));
  ASSERT_GT(text.size(), 16U);
  EXPECT_EQ(text.substr(0, 10), "POLYGON ((");
  EXPECT_THAT(corners, HasSubstr(text.substr(10, 23)));

  const Outcome outside = map({square, "--view", "0,0", "-o", path("none.wkt")});
  EXPECT_EQ(outside.code, 1);
  EXPECT_THAT(outside.err, HasSubstr("(0 0) lies outside the free space"));
  EXPECT_FALSE(std::filesystem::exists(path("none.wkt")));
  EXPECT_EQ(map({square, "--view", "2", "-o", path("none.wkt")}).code, 2);
  EXPECT_EQ(map({square, "--view", "2,2"}).code, 2);
  EXPECT_EQ(map({square, "--view", "2,2", "-o", path("none.geojson")}).code, 2);
}

}  // namespace
}  // namespace mrpt_polyloc::test
