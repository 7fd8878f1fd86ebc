#include "ProgramTest.h"
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/io/map_files.h>
#include <mrpt_polyloc/io/scan_files.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace mrpt_polyloc::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A drive to and fro through a hall of 12 m x 5 m with a pillar.
class PolylocDataset : public ProgramTest {
 protected:
  static PolygonMap hall() {
    return PolygonMap(
        {{wallRing({{0, 0}, {12, 0}, {12, 5}, {8, 5}, {8, 4}, {6, 4}, {6, 5}, {0, 5}}),
          {wallRing({{3, 3}, {3, 3.6}, {3.8, 3.6}, {3.8, 3}})}}});
  }

  /// Lines of a corrected CARMEN log; the scans see `hall()` from their poses, moved by an offset.
  static std::string log(double laser_ahead = 0.0) {
    const WallSegments walls(hall());
    std::string text = "PARAM robot_frontlaser_offset " + std::to_string(laser_ahead) + " n 0\n";
    char field[80];
    for (int i = 0; i < 160; ++i) {
      const double along = i < 80 ? 1 + 0.125 * i : 1 + 0.125 * (160 - i);
      const double heading = i < 80 ? 0.2 : -2.9, y = i < 80 ? 1.5 : 2.0;
      text += "FLASER 181";
      for (int beam = 0; beam <= 180; ++beam) {
        const double range = walls.range({along, y}, heading + (beam - 90) * M_PI / 180);
        std::snprintf(field, sizeof field, " %.3f", range);
        text += field;
      }
      std::snprintf(field, sizeof field, " %.4f %.4f %.4f 0 0 0 %d.5 host 1\n", along, y, heading,
                    i);
      text += field;
    }
    return text;
  }

  Outcome make(const std::string& file, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"--log", file, "-o", path("set")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    if (std::count(more.begin(), more.end(), "--max-range") == 0) {
      arguments.insert(arguments.end(), {"--max-range", "20"});
    }
    return run("polyloc-dataset", arguments);
  }
};

TEST_F(PolylocDataset, ALogBecomesAMapAndScansThatAreFoundInIt) {
  const Outcome outcome = make(write("drive.log", log()), {"--block", "2.5"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(files("set"),
              ElementsAre("good.txt", "map.pgm", "map.yaml", "scans.rawlog", "truth.tum"));
  const auto scans = loadScans(path("set/scans.rawlog"));
  const auto truth = loadTum(path("set/truth.tum"));
  EXPECT_EQ(scans.size(), truth.size());
  // Ranges seen from the truths are those of the hall: nothing was shifted or turned.
  const WallSegments walls(hall());
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const auto& pose = truth[i].pose_map_robot;
    for (const Beam& beam : scans[i].beams()) {
      if (beam.kind != BeamKind::hit) continue;
      ASSERT_NEAR(beam.range, walls.range({pose.x, pose.y}, pose.phi + beam.bearing),
                  0.02 + 0.02 * beam.range)
          << i;
    }
    if (i > 3) break;
  }
  // The map is that of the hall, seen in parts.
  const PolygonMap map = loadMap(path("set/map.yaml")).map;
  EXPECT_NEAR(map.area(), hall().area(), 0.1 * hall().area());
  const Outcome found =
      run("polyloc-eval",
          {"--map", path("set/map.yaml"), "--scans", path("set/scans.rawlog"), "--truth",
           path("set/truth.tum"), "--good", path("set/good.txt"), "-o", path("out")});
  ASSERT_EQ(found.code, 0) << found.err;
  const auto summary = nlohmann::json::parse(readFile(path("out/summary.json")));
  // Half a circle of a hall that is nearly a rectangle: its turned twin is often as good.
  EXPECT_GE(summary["top20"], 0.95);
  EXPECT_GE(summary["top1"], 0.7);
  EXPECT_GE(summary["good"]["scans"], static_cast<int>(scans.size() * 8 / 10));
}

TEST_F(PolylocDataset, StretchesTakeTurns) {
  // 20 m of way in stretches of 5 m: the second and the fourth are scans, 40 of 160 scans each.
  ASSERT_EQ(make(write("drive.log", log()), {"--block", "5"}).code, 0);
  const auto truth = loadTum(path("set/truth.tum"));
  ASSERT_NEAR(static_cast<double>(truth.size()), 80.0, 3.0);
  EXPECT_NEAR(truth.front().pose_map_robot.x, 6.0, 0.2);
  EXPECT_EQ(truth[0].stamp, 1e9);
  EXPECT_EQ(truth[1].stamp, 1e9 + 1);
}

TEST_F(PolylocDataset, PosesOfTheLaserAreMadeThoseOfTheRobot) {
  ASSERT_EQ(make(write("drive.log", log(0.5)), {"--block", "5"}).code, 0);
  const auto scans = loadScans(path("set/scans.rawlog"));
  const auto truth = loadTum(path("set/truth.tum"));
  EXPECT_NEAR(scans.front().sensor().x, 0.5, 1e-6);
  const auto laser = scans.front().beamFrameFromRobot(truth.front().pose_map_robot);
  EXPECT_NEAR(laser.x, 6.0, 0.2);
  EXPECT_NEAR(laser.y, 1.5, 1e-3);
}

TEST_F(PolylocDataset, RefusesWhatIsNoDrive) {
  const auto expectFailure = [&](const std::string& file, const std::vector<std::string>& more,
                                 const std::string& message) {
    const Outcome outcome = make(file, more);
    EXPECT_EQ(outcome.code, 1) << message;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("polyloc-dataset: "), HasSubstr(message)));
    EXPECT_FALSE(std::filesystem::exists(path("set"))) << message;
  };
  const std::string whole = log();
  std::string still = whole, jump = whole;
  // Every pose replaced: none moves; one replaced: a jump.
  for (std::size_t at = 0; (at = still.find(" 0 0 0 ", at)) != std::string::npos; ++at) {
    std::size_t begin = at;
    for (int k = 0; k < 3; ++k) begin = still.rfind(' ', begin - 1);
    still.replace(begin, at - begin, " 1 1 0");
    at = begin + 6;
  }
  const std::size_t at = jump.find(" 0 0 0 ", jump.size() / 2);
  jump.replace(jump.rfind(' ', jump.rfind(' ', jump.rfind(' ', at - 1) - 1) - 1), 3, " 90");
  expectFailure(write("still.log", still), {}, "never move");
  expectFailure(write("jump.log", jump), {}, "a jump of");
  const std::string file = write("drive.log", whole);
  expectFailure(file, {"--block", "500"}, "shorter than --block");
  std::string blind;  // readings of 0 say nothing: nothing makes a cell free
  for (int i = 0; i < 8; ++i) {
    blind += "FLASER 181";
    for (int beam = 0; beam <= 180; ++beam) blind += " 0.0";
    blind += " " + std::to_string(i) + ".0 1 0 0 0 0 " + std::to_string(i) + ".5 host 1\n";
  }
  expectFailure(write("blind.log", blind), {"--block", "2"}, "comes out free");
  expectFailure(path("gone.log"), {}, "gone.log");
  simulate("sim");
  expectFailure(path("sim/scans.rawlog"), {}, "--poses TRUTH.tum is needed");
  EXPECT_EQ(make(file, {"--block", "0"}).code, 2);
}

TEST_F(PolylocDataset, TakesTheKeyframesOfASimplemap) {
  const std::string file = "/usr/share/mrpt/datasets/localization_demo.simplemap.gz";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "mrpt-common is not installed";
  const Outcome outcome = make(file, {"--max-range", "80", "--max-jump", "100", "--block", "3"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto scans = loadScans(path("set/scans.rawlog"));
  const auto truth = loadTum(path("set/truth.tum"));
  ASSERT_GT(scans.size(), 10u);
  EXPECT_NEAR(scans.front().sensor().x, 0.78, 0.01);  // as all of these sets have it
  // Hits lie on walls of the map that MRPT makes of the whole simplemap.
  const WallSegments walls(loadMap(file).map);
  std::size_t near = 0, all = 0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const auto eye = scans[i].beamFrameFromRobot(truth[i].pose_map_robot);
    for (std::size_t k = 0; k < scans[i].beams().size(); k += 20) {
      const Beam& beam = scans[i].beams()[k];
      if (beam.kind != BeamKind::hit || beam.range > 8.0) continue;
      const double direction = eye.phi + beam.bearing;
      near += walls.distance({eye.x + beam.range * std::cos(direction),
                              eye.y + beam.range * std::sin(direction)}) < 0.15;
      ++all;
    }
  }
  EXPECT_GT(near, all * 9 / 10) << all;
}

TEST_F(PolylocDataset, TakesPosesOfAFile) {
  simulate("sim");
  const Outcome outcome = make(path("sim/scans.rawlog"), {"--poses", path("sim/truth.tum"),
                                                          "--max-jump", "20", "--block", "3"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(loadScans(path("set/scans.rawlog")).size(), loadTum(path("set/truth.tum")).size());
}

}  // namespace
}  // namespace mrpt_polyloc::test
