#include "ProgramTest.h"
#include "apps/polyloc-travel/TravelRun.h"
#include "apps/polyloc-travel/travel_oracles.h"
#include "apps/polyloc-travel/travel_report.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <limits>
#include <tests/support/map_factories.h>

namespace mrpt_polyloc::test {
namespace {

using apps::TravelOutcome;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kNicheCorridor =
    "POLYGON ((0 0, 24 0, 24 2, 20 2, 20 3, 18.5 3, 18.5 2, 0 2, 0 0))\n";
constexpr const char* kCorridor = "POLYGON ((0 0, 12 0, 12 2, 0 2, 0 0))\n";

class PolylocTravel : public ProgramTest {
 protected:
  /// Runs with a map; the summary.
  json travel(const std::string& map, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--map", map, "-o", path("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run("polyloc-travel", arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return json::parse(readFile(path("out/summary.json")));
  }

  void expectFailure(const std::vector<std::string>& arguments, int code,
                     const std::string& message) {
    const Outcome outcome = run("polyloc-travel", arguments);
    EXPECT_EQ(outcome.code, code);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("polyloc-travel: "), HasSubstr(message)));
  }
};

TEST_F(PolylocTravel, DrivesUntilItKnows) {
  const json summary =
      travel(write("map.wkt", kNicheCorridor),
             {"-n", "4", "--seed", "1", "--max-range", "4", "--svg", path("run.svg")});
  EXPECT_EQ(summary["runs"], 4);
  EXPECT_EQ(summary["localized"], 4);
  EXPECT_EQ(summary["wrong"], 0);
  EXPECT_EQ(summary["collisions"], 0);
  EXPECT_GE(summary["ambiguous_at_start"], 2);
  EXPECT_GT(summary["ambiguous"]["travel_m"]["median"], 0.5);
  EXPECT_GT(summary["planning_ms"]["max"], 0.0);
  EXPECT_THAT(files("out"), ElementsAre("runs.csv", "summary.json"));
  const std::vector<std::string> lines = linesOf(readFile(path("out/runs.csv")));
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(fieldsOf(lines[1]).size(), fieldsOf(lines[0]).size());
  EXPECT_THAT(readFile(path("run.svg")), AllOf(HasSubstr("</svg>"), HasSubstr("class=\"path\"")));
}

TEST_F(PolylocTravel, ALaserOfHalfACircleMayBeginBeforeAWall) {
  const std::string map = write("map.wkt", kNicheCorridor);
  for (const char* start : {"12,0.35,-90", "23.6,1,0"}) {
    const json summary =
        travel(map, {"--start", start, "--max-range", "4", "--fov", "180", "--beams", "181"});
    EXPECT_EQ(summary["localized"], 1) << start;
    EXPECT_EQ(summary["collisions"], 0) << start;
  }
}

TEST_F(PolylocTravel, SaysRightlyThatASymmetricMapCannotBeTold) {
  const json summary =
      travel(write("map.wkt", kCorridor), {"-n", "3", "--seed", "2", "--max-range", "15"});
  EXPECT_EQ(summary["indistinguishable"], 3);
  EXPECT_EQ(summary["indistinguishable_right"], 3);
  EXPECT_TRUE(summary["travel_m"].is_null());
  EXPECT_EQ(summary["collisions"], 0);
}

TEST_F(PolylocTravel, TheSameSeedGivesTheSameRuns) {
  const std::string map = write("map.wkt", kNicheCorridor);
  const std::vector<std::string> options = {
      "-n",        "1", "--seed",     "3",      "--max-range",  "4", "--occluders", "2",
      "--clutter", "0", "--strategy", "random", "--max-travel", "20"};
  travel(map, options);
  const std::vector<std::string> first = linesOf(readFile(path("out/runs.csv")));
  travel(map, options);
  const std::vector<std::string> again = linesOf(readFile(path("out/runs.csv")));
  ASSERT_EQ(first.size(), again.size());
  // All but the last field, which is a time.
  EXPECT_EQ(first[1].substr(0, first[1].rfind(',')), again[1].substr(0, again[1].rfind(',')));
}

TEST_F(PolylocTravel, PlansForARealRobot) {
  const std::string map = roomFile();
  simulate("scans");
  const Outcome outcome =
      run("polyloc-travel", {"--plan", "--map", map, "--scans", path("scans/scans.rawlog")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json plan = json::parse(outcome.out);
  EXPECT_EQ(plan["status"], "unique") << "every place in this room looks different";
  EXPECT_TRUE(plan["waypoint"].is_null());
  EXPECT_EQ(plan["hypotheses"].size(), 1u);

  // A room that a turn by half a circle leaves as it is, but for an alcove out of the laser's
  // reach.
  const std::string hall = write("hall.wkt", kNicheCorridor);
  ASSERT_EQ(run("polyloc-simulate",
                {"--map", hall, "-n", "1", "--seed", "4", "--max-range", "5", "-o", path("hall")})
                .code,
            0);
  const Outcome far =
      run("polyloc-travel", {"--plan", "--map", hall, "--scans", path("hall/scans.rawlog")});
  ASSERT_EQ(far.code, 0) << far.err;
  const json go = json::parse(far.out);
  EXPECT_EQ(go["status"], "go");
  EXPECT_TRUE(go["waypoint"].contains("x"));
  EXPECT_GE(go["hypotheses"].size(), 2u);
}

TEST_F(PolylocTravel, RefusesADriveWhoseClockRunsBack) {
  const std::string map = roomFile();
  simulate("scans");
  const std::string log = readFile(path("scans/scans.rawlog"));
  const std::string twice = write("twice.rawlog", log + log);
  const Outcome outcome = run("polyloc-travel", {"--plan", "--map", map, "--scans", twice});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("twice.rawlog: scan "), HasSubstr("by its stamp")));
}

TEST_F(PolylocTravel, NamesWhatIsWrong) {
  const std::string map = write("map.wkt", kCorridor);
  const std::string out = path("out");
  expectFailure({"--map", map, "-o", out}, 2, "either --start or -n");
  expectFailure({"--map", map, "-n", "1", "--start", "1,1,0", "-o", out}, 2,
                "either --start or -n");
  expectFailure({"--map", map, "-n", "1"}, 2, "-o is needed");
  expectFailure({"--map", map, "--start", "1,1", "-o", out}, 2, "--start: '1,1' is not X,Y,DEG");
  expectFailure({"--map", map, "-n", "1", "-o", out, "--strategy", "best"}, 2, "none of greedy");
  expectFailure({"--map", map, "-n", "1", "-o", out, "--odometry-noise", "1,a,2"}, 2, "A,B,C");
  expectFailure({"--map", map, "-n", "1", "-o", out, "--odometry-noise", "-1,0,0"}, 2,
                "--odometry-noise");
  expectFailure({"--map", map, "--plan"}, 2, "--plan needs --scans");
  expectFailure({"--map", map, "--plan", "--scans", "x.rawlog", "-n", "1"}, 2, "real robot");
  expectFailure({"--map", map, "-n", "1", "-o", out, "--scans", "x.rawlog"}, 2, "--plan alone");
  expectFailure({"--map", path("none.wkt"), "-n", "1", "-o", out}, 1, "none.wkt");
  expectFailure({"--map", map, "--plan", "--scans", path("none.rawlog")}, 1, "none.rawlog");
  expectFailure({"--map", map, "--start", "1,0.1,0", "-o", out}, 1, "would touch a wall");
  expectFailure({"--map", map, "--start", "50,50,0", "-o", out}, 1, "not in the free space");
  expectFailure({"--map", map, "-n", "1", "-o", out, "--clutter", "50"}, 1, "no room for 50 boxes");
  expectFailure({"--map", map, "-n", "1", "-o", out, "--robot-radius", "1.2"}, 1, "from all walls");
  EXPECT_FALSE(std::filesystem::exists(out));
}

PolygonMap nicheCorridor() {
  return mapOf({{0, 0}, {24, 0}, {24, 2}, {20, 2}, {20, 3}, {18.5, 3}, {18.5, 2}, {0, 2}});
}

TEST(World, BoxesStopBeamsAndRobots) {
  const PolygonMap map = squareMap(12.0);
  SimulatorParams laser;
  laser.sigma = 0.0;
  const apps::World empty(map, laser, 0, 0.25, 7), cluttered(map, laser, 5, 0.25, 7);
  ASSERT_EQ(cluttered.boxes().size(), 5u);
  for (const Polyline& box : cluttered.boxes()) {
    for (const TPoint2D& corner : box) {
      EXPECT_NEAR(cluttered.clearance(corner), 0.0, 1e-9);
      EXPECT_GT(empty.clearance(corner), 0.5);
    }
  }
  Random random(1);
  const RangeScan bare = empty.scan({6, 6, 0}, random), seen = cluttered.scan({6, 6, 0}, random);
  int nearer = 0;
  for (std::size_t i = 0; i < bare.beams().size(); ++i) {
    EXPECT_LE(seen.beams()[i].range, bare.beams()[i].range + 1e-9);
    nearer += seen.beams()[i].range < bare.beams()[i].range - 0.1;
  }
  EXPECT_GT(nearer, 5);
}

/// Two runs of a robot that drives: how far it says it went is how far it went.
TEST(TravelRun, KeepsAccountOfWhatItDoes) {
  SimulatorParams laser;
  laser.max_range = 4.0;
  laser.sigma = 0.02;
  MapIndexParams one_thread;
  one_thread.threads = 1;
  const MapIndex::Ptr index = MapIndex::build(nicheCorridor(), one_thread);
  const GlobalLocalizer localizer(index, apps::surerSearch());
  TravelPlannerParams params;
  params.max_range = 4.0;
  const TravelPlanner planner(index, params);
  const apps::World world(nicheCorridor(), laser, 0, 0.25, 1);
  const apps::TravelRunResult run =
      apps::travel(planner, localizer, world, {10.0, 1.0, 0.3}, {}, 5);
  EXPECT_EQ(run.outcome, TravelOutcome::localized);
  EXPECT_TRUE(run.is_ambiguous_at_start);
  EXPECT_EQ(run.collisions, 0u);
  EXPECT_EQ(run.steps.size(), run.scans);
  EXPECT_LT(run.error_m, 0.1);
  double length = 0.0;
  for (std::size_t i = 1; i < run.way.size(); ++i) {
    length += (run.way[i] - run.way[i - 1]).norm();
    EXPECT_GT(world.clearance(run.way[i]), 0.25);
  }
  EXPECT_NEAR(length, run.travelled, 1e-6);
  EXPECT_GT(length, 0.5);

  // Who knows the truth drives on the average no farther, if at all.
  const std::optional<double> tour = apps::shortestTour(planner, world, run);
  if (tour) {
    EXPECT_GT(*tour, 0.0);
  }

  // Nothing may be driven: it gives up, or says that nothing differs within reach.
  apps::TravelRunParams still;
  still.most_travel = 0.0;
  const apps::TravelRunResult stuck =
      apps::travel(planner, localizer, world, {10.0, 1.0, 0.3}, still, 5);
  EXPECT_NE(stuck.outcome, TravelOutcome::localized);
  EXPECT_NE(stuck.outcome, TravelOutcome::wrong);
  EXPECT_EQ(stuck.travelled, 0.0);
}

TEST(TravelOracle, ContradictsWhatIsNotAlike) {
  SimulatorParams laser;
  laser.max_range = 4.0;
  MapIndexParams one_thread;
  one_thread.threads = 1;
  const MapIndex::Ptr index = MapIndex::deferred(nicheCorridor(), one_thread);
  const TravelPlanner planner(index, {});
  const apps::World world(nicheCorridor(), laser, 0, 0.25, 1);
  const auto claim = [&](const mrpt::math::TPose2D& truth, const mrpt::math::TPose2D& rival) {
    apps::TravelRunResult run;
    run.start = truth;
    apps::TravelStep step;
    step.truth = truth;
    step.hypotheses.resize(2);
    step.hypotheses[0].id = 1;
    step.hypotheses[0].pose_map_robot = truth;
    step.hypotheses[1].id = 2;
    step.hypotheses[1].pose_map_robot = rival;
    run.steps = {step};
    return run;
  };
  // The niche is within reach of either.
  EXPECT_FALSE(
      apps::isTrulyIndistinguishable(planner, world, claim({10, 1, 0}, {14, 1, M_PI}), 30.0));
  // Within a metre it is not.
  EXPECT_TRUE(
      apps::isTrulyIndistinguishable(planner, world, claim({10, 1, 0}, {12, 1, M_PI}), 1.0));
  // Neither is the truth: never right.
  apps::TravelRunResult lost = claim({10, 1, 0}, {12, 1, M_PI});
  lost.steps.back().truth = {5, 1, 0};
  EXPECT_FALSE(apps::isTrulyIndistinguishable(planner, world, lost, 1.0));
}

TEST(TravelReport, CountsWhatHappened) {
  std::vector<apps::TravelRecord> records(4);
  records[0].outcome = TravelOutcome::localized;
  records[1].outcome = TravelOutcome::localized;
  records[1].is_ambiguous_at_start = true;
  records[1].travelled = 6.0;
  records[1].tour_m = 4.0;
  records[2].outcome = TravelOutcome::indistinguishable;
  records[2].is_rightly_indistinguishable = true;
  records[3].outcome = TravelOutcome::wrong;
  records[3].collisions = 2;
  records[3].error_m = std::numeric_limits<double>::quiet_NaN();
  const auto summary = apps::travelSummary(records);
  EXPECT_EQ(summary["runs"], 4);
  EXPECT_EQ(summary["localized"], 2);
  EXPECT_EQ(summary["wrong"], 1);
  EXPECT_EQ(summary["gave_up"], 0);
  EXPECT_EQ(summary["indistinguishable_right"], 1);
  EXPECT_EQ(summary["collisions"], 2);
  EXPECT_DOUBLE_EQ(summary["travel_m"]["median"], 3.0);
  EXPECT_DOUBLE_EQ(summary["tour_ratio"]["median"], 1.5);
  EXPECT_THAT(apps::runsCsv(records), testing::Not(HasSubstr("nan")));
  EXPECT_TRUE(apps::travelSummary({})["tour_ratio"].is_null());
}

}  // namespace
}  // namespace mrpt_polyloc::test
