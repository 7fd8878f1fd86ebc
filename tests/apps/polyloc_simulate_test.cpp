#include "ProgramTest.h"
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/io/scan_files.h>

#include <gmock/gmock.h>

#include <filesystem>

namespace mrpt_polyloc::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class PolylocSimulate : public ProgramTest {};

TEST_F(PolylocSimulate, WritesScansAndTheirTruth) {
  simulate("out", {"--beams", "90", "--fov", "180", "--max-range", "3"});
  EXPECT_THAT(files("out"), ElementsAre("scans.rawlog", "truth.tum"));
  const auto scans = loadScans(path("out/scans.rawlog"));
  const auto truth = matchTruth(scans, loadTum(path("out/truth.tum")), path("out/truth.tum"));
  ASSERT_EQ(scans.size(), 12u);
  for (std::size_t row = 0; row < scans.size(); ++row) {
    EXPECT_EQ(scans[row].stamp(), 1e9 + static_cast<double>(row));
    ASSERT_EQ(scans[row].beams().size(), 90u);
    EXPECT_EQ(scans[row].hitCount() + scans[row].noReturnCount(), 90u);
    EXPECT_NEAR(scans[row].beams().front().bearing, -1.5707963, 1e-6);
    EXPECT_TRUE(truth[row].x > 0.3 && truth[row].x < 7.7);
  }
}

TEST_F(PolylocSimulate, TheSameSeedGivesTheSameFiles) {
  simulate("a", {"--occluders", "3", "--short", "0.2", "--dropout", "0.1"});
  simulate("b", {"--occluders", "3", "--short", "0.2", "--dropout", "0.1"});
  EXPECT_EQ(readFile(path("a/scans.rawlog")), readFile(path("b/scans.rawlog")));
  EXPECT_EQ(readFile(path("a/truth.tum")), readFile(path("b/truth.tum")));
  simulate("c", {"--max-range", "5"});
  EXPECT_EQ(readFile(path("a/truth.tum")), readFile(path("c/truth.tum")));
  EXPECT_NE(readFile(path("a/scans.rawlog")), readFile(path("c/scans.rawlog")));
}

TEST_F(PolylocSimulate, AChangedWorldKeepsThePoses) {
  simulate("map");
  for (const std::vector<std::string>& change : {std::vector<std::string>{"--boxes", "5"},
                                                 {"--gone", "1"},
                                                 {"--wall-shift", "0.05"},
                                                 {"--wing-scale", "0.02"},
                                                 {"--wing-turn", "1"},
                                                 {"--glass", "0.3"}}) {
    simulate("changed", change);
    EXPECT_EQ(readFile(path("map/truth.tum")), readFile(path("changed/truth.tum"))) << change[0];
    EXPECT_NE(readFile(path("map/scans.rawlog")), readFile(path("changed/scans.rawlog")))
        << change[0];
  }
  const Outcome outcome = run("polyloc-simulate", {"--map", roomFile(), "-n", "1", "--seed", "1",
                                                   "--glass", "1.1", "-o", path("out")});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--glass"));
}

TEST_F(PolylocSimulate, FailsWholeOrNotAtAll) {
  const std::string room = roomFile();
  std::vector<std::string> arguments = {"--map", room, "-n", "2", "--seed", "1", "-o", ""};
  arguments.back() = room;
  Outcome outcome = run("polyloc-simulate", arguments);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr(room));

  arguments.back() = path("out");
  std::filesystem::create_directories(path("out/truth.tum"));  // in the way of the second file
  outcome = run("polyloc-simulate", arguments);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("truth.tum"));
  EXPECT_THAT(files("out"), ElementsAre("truth.tum"));
}

TEST_F(PolylocSimulate, SaysThatThereIsNoRoomForTheRobot) {
  const Outcome outcome = run("polyloc-simulate", {"--map", roomFile(), "-n", "1", "--seed", "1",
                                                   "--clearance", "4", "-o", path("out")});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("polyloc-simulate: "), HasSubstr("m from all walls")));
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

}  // namespace
}  // namespace mrpt_polyloc::test
