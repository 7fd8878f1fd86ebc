#include "PolylocLocalizeTest.h"

#include <gmock/gmock.h>

#include <cmath>

namespace mrpt_polyloc::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::UnorderedElementsAre;

/// A corridor with two equal niches at its ends, and what is seen from the bottom of either: the
/// corridor's far wall through the niche's mouth.
TEST_F(PolylocLocalize, ExactlyTwoNichesCannotBeToldApart) {
  const std::string map =
      write("niches.wkt",
            "POLYGON ((0 0, 12 0, 12 2, 11 2, 11 5, 10 5, 10 2, 6 2, 6 2.7, 5 2.7, 5 2, 2 2, 2 5, "
            "1 5, 1 2, 0 2, 0 0))\n");
  // From (1.5, 4): the mouth's corners are 2 m below, the far wall 4 m.
  const std::string view =
      write("view.wkt", "\nPOLYGON ((-1 -4, 1 -4, 0.5 -2, 0.5 1, -0.5 1, -0.5 -2, -1 -4))\n");
  const auto posesOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--map", map, "--scans", view, "--method", "exact"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run("polyloc-localize", arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::vector<std::string> poses;
    const std::vector<std::string> lines = linesOf(outcome.out);
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const std::vector<std::string> fields = fieldsOf(lines[i]);
      EXPECT_EQ(fields[2], "ambiguous");
      poses.push_back(fields[4] + " " + fields[5] + " " + fields[6]);
    }
    return poses;
  };
  const auto both = ElementsAre("1.5000 4.0000 0.000", "10.5000 4.0000 0.000");
  EXPECT_THAT(posesOf({"--compass", "0"}), both);
  EXPECT_THAT(posesOf({}), both);

  write("truth.tum", "0 10.5 4 0 0 0 0 1\n");
  const Outcome outcome = run("polyloc-eval", {"--map", map, "--scans", view, "--method", "exact",
                                               "--truth", path("truth.tum"), "-o", path("out")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(readFile(path("out/summary.json")), HasSubstr("\"top5\": 1.0"));
}

TEST_F(PolylocLocalize, TheShippedNichesHaveTwoAnswersAndOnlyTwo) {
  const std::string datasets = POLYLOC_SOURCE_DIR "/datasets/";
  const std::string map = datasets + "niches.wkt";
  for (const bool has_compass : {true, false}) {
    std::vector<std::string> arguments = {
        "--map", map, "--scans", datasets + "niches_query.wkt", "--method", "exact"};
    if (has_compass) arguments.insert(arguments.end(), {"--compass", "0"});
    const Outcome outcome = run("polyloc-localize", arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::vector<std::string> lines = linesOf(outcome.out);
    ASSERT_EQ(lines.size(), 3U) << outcome.out;
    std::vector<std::string> places;
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const std::vector<std::string> fields = fieldsOf(lines[i]);
      EXPECT_EQ(fields[3], std::to_string(i));
      places.push_back(fields[4] + " " + fields[5]);
      EXPECT_NEAR(std::stod(fields[6]), 0.0, 1e-3);
    }
    EXPECT_THAT(places, UnorderedElementsAre("4.2500 -3.2500", "13.2500 -3.2500"));
  }
  // The query is what the map's own view from there is.
  const Outcome view = run("polyloc-map", {map, "--view", "4.25,-3.25", "-o", path("view.wkt")});
  EXPECT_EQ(view.code, 0) << view.err;
  EXPECT_EQ(readFile(path("view.wkt")), readFile(datasets + "niches_query.wkt"));
}

TEST_F(PolylocLocalize, ManyPolygonsAreAnsweredAsOneIs) {
  // So many that the map's skeletons are prepared for them.
  const std::string datasets = POLYLOC_SOURCE_DIR "/datasets/";
  const std::string query = readFile(datasets + "niches_query.wkt");
  std::string many;
  for (int i = 0; i < 1500; ++i) many += query;
  const std::vector<std::string> arguments = {
      "--map", datasets + "niches.wkt", "--scans", write("many.wkt", many), "--method", "exact"};
  const Outcome outcome = run("polyloc-localize", arguments);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<std::string> lines = linesOf(outcome.out);
  ASSERT_EQ(lines.size(), 3001U);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = fieldsOf(lines[i]);
    EXPECT_EQ(fields[2], "ambiguous");
    EXPECT_EQ(fields[4] + " " + fields[5], i % 2 == 1 ? "4.2500 -3.2500" : "13.2500 -3.2500");
  }
}

TEST_F(PolylocLocalize, PolygonsThatCannotBeSeenFail) {
  const auto expectFailure = [&](const std::string& text, const std::string& reason) {
    const std::string view = write("view.wkt", text);
    const Outcome outcome =
        run("polyloc-localize", {"--map", roomFile(), "--scans", view, "--method", "exact"});
    EXPECT_EQ(outcome.code, 1) << text;
    EXPECT_THAT(outcome.err, HasSubstr(reason));
    EXPECT_THAT(outcome.out, IsEmpty());
  };
  expectFailure("", "empty file");
  expectFailure("\n\n", "holds no polygon");
  expectFailure("\nPOLYGON ((1 1, 2 1, 2 2, 1 x))\n", "line 2");
  expectFailure("\nPOLYGON EMPTY\n", "line 2: expected one POLYGON");
  expectFailure("POLYGON ((-3 -3, 3 -3, 3 3, -3 3), (1 1, 1 2, 2 2))", "with holes");
  expectFailure("POLYGON ((0 0, 3 0, 3 3))", "at the robot itself");
  expectFailure("POLYGON ((1 1, 3 1, 3 3, 1 3))", "line 1: ");
}

TEST_F(PolylocLocalize, AViewOfLimitedRangeSaysLess) {
  const std::string hall = write("hall.wkt", "POLYGON ((0 0, 20 0, 20 20, 0 20))\n");
  // All of it, as seen from (3, 4).
  const std::string view = write("view.wkt", "POLYGON ((-3 -4, 17 -4, 17 16, -3 16))\n");
  const auto answers = [&](const std::string& range) {
    const Outcome outcome =
        run("polyloc-localize", {"--map", hall, "--scans", view, "--method", "exact", "--compass",
                                 "0", "--view-range", range});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::vector<std::vector<std::string>> rows;
    for (const std::string& line : linesOf(outcome.out)) rows.push_back(fieldsOf(line));
    rows.erase(rows.begin());
    return rows;
  };
  constexpr std::size_t kStatus = 2, kX = 4, kY = 5, kStdX = 9, kStdY = 10, kStdPhi = 11;
  for (const char* range : {"6", "1000"}) {  // up to a corner, and beyond all
    const auto rows = answers(range);
    ASSERT_THAT(rows, SizeIs(1)) << range;
    EXPECT_EQ(rows[0][kStatus], "unique");
    EXPECT_EQ(rows[0][kX] + " " + rows[0][kY], "3.0000 4.0000");
  }
  // One wall: anywhere along it, but for 3.5 m at its ends.
  const auto wall = answers("3.5");
  ASSERT_THAT(wall, SizeIs(1));
  EXPECT_EQ(wall[0][kStatus], "ambiguous");
  EXPECT_EQ(wall[0][kX] + " " + wall[0][kY], "3.0000 10.0000");
  EXPECT_NEAR(std::stod(wall[0][kStdX]), 0.0, 0.001);
  EXPECT_NEAR(std::stod(wall[0][kStdY]), 13.0 / std::sqrt(12.0), 0.005);
  // Nothing: anywhere far enough from all walls, at any heading.
  const auto nothing = answers("2");
  ASSERT_THAT(nothing, SizeIs(1));
  EXPECT_EQ(nothing[0][kStatus], "ambiguous");
  EXPECT_NEAR(std::stod(nothing[0][kX]), 10.0, 0.01);
  EXPECT_NEAR(std::stod(nothing[0][kStdPhi]), 360.0 / std::sqrt(12.0), 0.01);
}

TEST_F(PolylocLocalize, ViewRangeIsOfExactPolygonsAlone) {
  const std::string view = write("view.wkt", "POLYGON ((-1 -1, 1 -1, 1 1, -1 1))\n");
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--view-range", "2"},
        {"--method", "exact", "--view-range", "0"},
        {"--method", "exact", "--view-range", "2", "--near", "1,1,1"}}) {
    std::vector<std::string> arguments = {"--map", roomFile(), "--scans", view};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run("polyloc-localize", arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--view-range"));
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
