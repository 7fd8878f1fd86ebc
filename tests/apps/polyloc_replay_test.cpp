#include "ProgramTest.h"
#include "driven_room.h"
#include "tests/support/data_dir.h"
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/io/map_files.h>
#include <mrpt_polyloc/io/mrpt_compat.h>
#include <mrpt_polyloc/io/polygon_files.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <apps/polyloc-replay/replay_statistics.h>
#include <cmath>
#include <filesystem>

namespace mrpt_polyloc::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

const std::string kIni = std::string(POLYLOC_SOURCE_DIR) + "/apps/polyloc-replay/";
const std::string kDatasets = std::string(POLYLOC_SOURCE_DIR) + "/datasets/";
const std::string kMrptData = "/usr/share/mrpt/datasets/";

class PolylocReplay : public ProgramTest {
 protected:
  /// An ini for the room; `polyloc` and `experiment` are lines of these sections.
  std::string ini(const std::string& polyloc = "", const std::string& experiment = "",
                  const std::string& maps = "polygonMap2D_count=1\n",
                  const std::string& creation = "file=room.wkt\n") const {
    roomFile();
    return write("room.ini", "[polyloc]\n" + polyloc +
                                 "[LocalizationExperiment]\nrawlog_file=drive.rawlog\n" +
                                 experiment + "[MetricMap]\n" + maps +
                                 "[MetricMap_polygonMap2D_00_creationOpts]\n" + creation +
                                 "[PF_options]\nPF_algorithm=0\nresamplingMethod=0\n"
                                 "adaptiveSampleSize=0\nBETA=0.5\nsampleSize=1\n");
  }
  Outcome replay(const std::vector<std::string>& more, const std::string& folder = "out") const {
    std::vector<std::string> arguments = {path("room.ini"), "-o", path(folder)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("polyloc-replay", arguments);
  }
  json summary(const std::string& folder = "out") const {
    return json::parse(readFile(path(folder + "/summary.json")));
  }
  /// The lines of steps.csv without what they took.
  std::vector<std::string> steps(const std::string& folder, const std::string& run) const {
    std::vector<std::string> kept;
    for (const std::string& line : linesOf(readFile(path(folder + "/steps.csv")))) {
      const auto fields = fieldsOf(line);
      if (fields[0] != run) continue;
      std::string text;
      for (std::size_t i = 1; i + 4 < fields.size(); ++i) text += fields[i] + ",";
      kept.push_back(text);
    }
    return kept;
  }

  const Drive drive_ = driveThroughRoom(40);
};

TEST_F(PolylocReplay, ScalesTheMapOfTheSearchAndRefusesOneThatDoesNotFit) {
  ini("map=halves.wkt\nparticles=100\n");
  write("halves.wkt", toText(loadPolygonMap(path("room.wkt"), nullptr, 2.0).map, ".wkt"));
  writeActionLog(path("drive.rawlog"), drive_);
  write("truth.tum", tumTruth(drive_));
  const std::vector<std::string> judged = {"--truth", path("truth.tum"), "--scale"};
  // From the first scan on, for the search finds it.
  const auto finds = [&](const char* scale) {
    std::vector<std::string> arguments = judged;
    arguments.emplace_back(scale);
    const Outcome outcome = replay(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return summary()["success"] == 1 && summary()["median_step"] == 0.0;
  };
  EXPECT_TRUE(finds("0.5"));
  EXPECT_FALSE(finds("1"));  // the filter may come to it in time
  ini("map=halves.wkt\nscale=0.5 # m\nparticles=100\n");
  EXPECT_EQ(replay({"--truth", path("truth.tum")}).code, 0);
  EXPECT_EQ(summary()["success"], 1);
  const Outcome refused = replay({"--max-memory", "0.2"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("halves.wkt"), HasSubstr("--max-memory")));
}

TEST_F(PolylocReplay, FollowsTheRobotFromTheFirstScan) {
  ini("particles=200\nreport_steps=0,7\n", "3DSceneFrequency=20\n");
  writeActionLog(path("drive.rawlog"), drive_);
  write("truth.tum", tumTruth(drive_));
  const Outcome outcome = replay({"--truth", path("truth.tum"), "--repetitions", "3"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("success       3 of 3"));
  EXPECT_THAT(files("out"), ElementsAre("3D", "report.html", "scene.3Dscene", "steps.csv",
                                        "summary.json", "trajectory.tum"));
  const json result = summary();
  EXPECT_EQ(result["runs"], 3);
  EXPECT_EQ(result["success"], 3);
  EXPECT_EQ(result["median_step"], 0.0);
  EXPECT_GE(result["particles"].get<double>(), 200.0);
  EXPECT_LT(result["median_error_m"].get<double>(), 0.1);
  EXPECT_GT(result["search_ms"].get<double>(), 0.0);
  EXPECT_GT(result["total_ms"].get<double>(), result["first_step_ms"].get<double>());
  ASSERT_THAT(result["per_run"], SizeIs(3));
  EXPECT_EQ(result["per_run"][2]["seed"], 3);

  const auto trajectory = loadTum(path("out/trajectory.tum"));
  ASSERT_EQ(trajectory.size(), 40U);
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    EXPECT_NEAR(trajectory[i].stamp, 1e9 + 0.1 * static_cast<double>(i), 1e-4);
    EXPECT_NEAR(trajectory[i].pose_map_robot.x, drive_.truth[i].x, 0.2);
    EXPECT_NEAR(trajectory[i].pose_map_robot.y, drive_.truth[i].y, 0.2);
  }
  EXPECT_THAT(linesOf(readFile(path("out/steps.csv"))), SizeIs(1 + 3 * 40));
  const std::string report = readFile(path("out/report.html"));
  EXPECT_THAT(report, AllOf(StartsWith("<!DOCTYPE html>"), HasSubstr("Step 0:"),
                            HasSubstr("Step 7:"), HasSubstr("Step 39:"), HasSubstr("</html>")));
}

TEST_F(PolylocReplay, WritesScenesThatMrptReads) {
  ini("particles=150\n", "3DSceneFrequency=20\n");
  writeActionLog(path("drive.rawlog"), drive_);
  ASSERT_EQ(replay({}).code, 0);
  EXPECT_THAT(files("out/3D"), ElementsAre("step_00019.3Dscene", "step_00039.3Dscene"));
  for (const char* name : {"out/scene.3Dscene", "out/3D/step_00019.3Dscene"}) {
    Scene scene;
    ASSERT_TRUE(scene.loadFromFile(path(name))) << name;
    for (const char* object : {"map", "estimate", "particles", "robot"}) {
      EXPECT_TRUE(scene.getByName(object)) << name << " " << object;
    }
  }
}

TEST_F(PolylocReplay, WithoutTruthThereIsNoVerdict) {
  ini("particles=150\n");
  writeActionLog(path("drive.rawlog"), drive_);
  const Outcome outcome = replay({});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json result = summary();
  for (const char* key : {"success", "median_step", "median_error_m", "truth"}) {
    EXPECT_TRUE(result[key].is_null()) << key;
  }
  EXPECT_FALSE(result["per_run"][0].contains("success"));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("success")));
}

TEST_F(PolylocReplay, TheSameSeedGivesTheSameRunWhateverRanBefore) {
  ini("particles=150\n");
  writeActionLog(path("drive.rawlog"), drive_);
  write("truth.tum", tumTruth(drive_));
  const std::vector<std::string> truth = {"--truth", path("truth.tum")};
  ASSERT_EQ(replay({"--seed", "5", "--repetitions", "2"}, "a").code, 0);
  ASSERT_EQ(replay({"--seed", "5"}, "b").code, 0);
  ASSERT_EQ(replay({"--seed", "6"}, "c").code, 0);
  EXPECT_EQ(readFile(path("a/trajectory.tum")), readFile(path("b/trajectory.tum")));
  EXPECT_NE(readFile(path("a/trajectory.tum")), readFile(path("c/trajectory.tum")));
  EXPECT_EQ(steps("a", "0"), steps("b", "0"));
  EXPECT_THAT(steps("a", "1"), SizeIs(40));
  EXPECT_EQ(steps("a", "1"), steps("c", "0"));
}

TEST_F(PolylocReplay, ReadsLogsOfObservationsAndIndexedTruth) {
  ini("particles=200\n", "ground_truth_path_file=truth.txt\n");
  write("truth.txt", indexedTruth(drive_));
  writeObservationLog(path("drive.rawlog"), drive_);
  ASSERT_EQ(replay({}, "observations").code, 0);
  writeActionLog(path("actions.rawlog"), drive_);
  ASSERT_EQ(replay({"--rawlog", path("actions.rawlog")}, "actions").code, 0);
  for (const char* folder : {"observations", "actions"}) {
    EXPECT_EQ(summary(folder)["success"], 1) << folder;
    EXPECT_EQ(summary(folder)["median_step"], 0.0) << folder;
    EXPECT_EQ(summary(folder)["steps"], 40) << folder;
  }
}

TEST_F(PolylocReplay, StartsAnywhereIfAsked) {
  ini("particles=200\n", "particles_count=4000\n");
  writeActionLog(path("drive.rawlog"), drive_);
  write("truth.tum", tumTruth(drive_));
  const Outcome outcome = replay({"--truth", path("truth.tum"), "--init", "uniform"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json result = summary();
  EXPECT_EQ(result["particles"], 4000.0);
  EXPECT_EQ(result["init"], "uniform");
  EXPECT_EQ(result["search_ms"], 0.0);
  EXPECT_EQ(result["success"], 1);  // seen with every seed from 1 to 20
}

TEST_F(PolylocReplay, FindsARobotThatWasCarried) {
  writeActionLog(path("drive.rawlog"), drive_);
  write("truth.tum", tumTruth(drive_));
  ini("particles=200\ncarried=14-28\n");
  const std::vector<std::string> runs = {"--truth", path("truth.tum"), "--repetitions", "5"};
  ASSERT_EQ(replay(runs, "found").code, 0);
  json result = summary("found");
  EXPECT_EQ(result["steps"], 25);
  EXPECT_EQ(result["success"], 5);
  ASSERT_THAT(result["teleports"], SizeIs(1));
  EXPECT_EQ(result["teleports"][0]["step"], 29);
  EXPECT_EQ(result["teleports"][0]["recovered"], 5);
  EXPECT_LE(result["teleports"][0]["max_scans"].get<double>(), 4.0);
  // Without recovery it stays lost: the particles are 2 m away.
  ini("particles=200\ncarried=14-28\nrecovery=false\nuniform_share=0\n");
  ASSERT_EQ(replay(runs, "lost").code, 0);
  EXPECT_EQ(summary("lost")["success"], 0);
  EXPECT_EQ(summary("lost")["teleports"][0]["recovered"], 0);
}

TEST_F(PolylocReplay, GoesOnWithScansThatSayNothing) {
  Drive drive = drive_;
  drive.scans[0].resizeScan(0);
  for (std::size_t i = 0; i < drive.scans[5].getScanSize(); ++i) {
    drive.scans[5].setScanRange(i, std::nanf(""));
  }
  ini("particles=200\n");
  writeActionLog(path("drive.rawlog"), drive);
  write("truth.tum", tumTruth(drive));
  const Outcome outcome = replay({"--truth", path("truth.tum")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(summary()["success"], 1);
  EXPECT_EQ(summary()["median_step"], 1.0);  // found at the first scan that says something
}

TEST_F(PolylocReplay, NamesWhatIsWrong) {
  const auto failure = [&](int code, const std::vector<std::string>& more = {}) {
    const Outcome outcome = replay(more);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_FALSE(fs::exists(path("out/summary.json")));
    EXPECT_EQ(linesOf(outcome.err).size(), code == 1 ? 1U : 2U) << outcome.err;
    return outcome.err;
  };
  ini("partciles=3\n");
  EXPECT_THAT(failure(1),
              AllOf(HasSubstr("room.ini"), HasSubstr("[polyloc]"), HasSubstr("'partciles'")));
  ini();
  EXPECT_THAT(failure(1), AllOf(HasSubstr("drive.rawlog"), HasSubstr("no such file")));
  writeActionLog(path("drive.rawlog"), drive_);
  const std::string whole = readFile(path("drive.rawlog"));
  write("cut.rawlog", whole.substr(0, whole.size() / 2));
  EXPECT_THAT(failure(1, {"--strict", "--rawlog", path("cut.rawlog")}), HasSubstr("cut.rawlog"));
  Drive tilted = drive_;
  tilted.scans[3].sensorPose.setFromValues(0, 0, 0, 0, 0.2, 0);
  writeActionLog(path("tilted.rawlog"), tilted);
  EXPECT_THAT(failure(1, {"--rawlog", path("tilted.rawlog")}),
              AllOf(HasSubstr("object 7"), HasSubstr("tilted by 11")));
  Drive blind = drive_;
  blind.scans.clear();
  writeObservationLog(path("blind.rawlog"), blind);
  EXPECT_EQ(replay({"--rawlog", path("blind.rawlog")}).code, 1);

  ini("", "", "polygonMap2D_count=1\n", "file=none.wkt\n");
  EXPECT_THAT(failure(1), HasSubstr("none.wkt"));
  write("broken.wkt", "POLYGON ((0 0, 1 1, 1 0");
  ini("", "", "polygonMap2D_count=1\n", "file=broken.wkt\n");
  EXPECT_THAT(failure(1), HasSubstr("broken.wkt"));
  ini("", "", "polygonMap2D_count=1\n", "file=room.wkt\nfle=2\n");
  EXPECT_THAT(failure(1), HasSubstr("'fle'"));
  ini("", "", "polygonMap3D_count=1\n");
  EXPECT_THAT(failure(1), AllOf(HasSubstr("[MetricMap]"), HasSubstr("'polygonMap3D'")));
  ini("", "", "polygonMap2D_count=0\n");
  EXPECT_THAT(failure(1), HasSubstr("asks for no map"));
  ini("", "", "polygonMap2D_count=1\noccupancyGrid_count=1\n");
  EXPECT_THAT(failure(1), HasSubstr("COccupancyGridMap2D is empty"));
  ini("carried=0-100\n");
  EXPECT_THAT(failure(1), HasSubstr("no step is left"));

  ini();
  write("far.tum", "5 0 0 0 0 0 0 1\n");
  EXPECT_THAT(failure(1, {"--truth", path("far.tum")}),
              AllOf(HasSubstr("far.tum"), HasSubstr("scan 0")));
  write("far.txt", "0 0 0 0\n40 0 0 0\n");
  EXPECT_THAT(failure(1, {"--truth", path("far.txt")}),
              AllOf(HasSubstr("far.txt"), HasSubstr("line 2"), HasSubstr("only 40")));
  EXPECT_THAT(failure(1, {"-l", path("none.so")}), HasSubstr("none.so"));
  EXPECT_THAT(failure(2, {"--init", "somewhere"}), HasSubstr("--init"));
  EXPECT_THAT(failure(2, {"--repetitions", "0"}), HasSubstr("--repetitions"));
  EXPECT_EQ(run("polyloc-replay", {"-o", path("out")}).code, 2);
  EXPECT_EQ(run("polyloc-replay", {path("none.ini"), "-o", path("out")}).code, 1);
}

TEST_F(PolylocReplay, LocalizesTheDemoFromAnyFolder) {
  if (!fs::exists(kMrptData + "localization_demo.rawlog")) GTEST_SKIP() << "mrpt-common is missing";
  const Outcome outcome = run("polyloc-replay", {kIni + "localization_demo.ini", "--truth",
                                                 kDatasets + "localization_demo_truth.tum",
                                                 "--repetitions", "3", "-o", path("demo")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(summary("demo")["success"], 3);
  EXPECT_EQ(summary("demo")["median_step"], 0.0);
  const auto last = loadTum(path("demo/trajectory.tum")).back().pose_map_robot;
  EXPECT_NEAR(last.x, 15.89, 0.3);  // as MRPT's own unit test says
  EXPECT_NEAR(last.y, -10.0, 0.3);
  EXPECT_NEAR(last.phi * 180 / M_PI, 4.8, 5.0);
}

TEST_F(PolylocReplay, StartsMrptsOwnGridFilterToo) {
  if (!fs::exists(kMrptData + "localization_demo.rawlog")) GTEST_SKIP() << "mrpt-common is missing";
  const Outcome outcome =
      run("polyloc-replay", {kIni + "localization_demo_grid.ini", "--truth",
                             kDatasets + "localization_demo_truth.tum", "-o", path("grid")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(summary("grid")["maps"], "mrpt::maps::COccupancyGridMap2D");
  EXPECT_EQ(summary("grid")["success"], 1);
}

TEST_F(PolylocReplay, ReadsGridmapsAndMrptsTruth) {
  if (!fs::exists(kMrptData + "uwb_ro-localization_demo.rawlog")) {
    GTEST_SKIP() << "mrpt-common is missing";
  }
  std::string text = readFile(kIni + "localization_demo_grid.ini");
  const auto replace = [&text](const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.rfind(from), from.size(), to);
  };
  replace("localization_demo.rawlog", "uwb_ro-localization_demo.rawlog");
  replace("localization_demo.simplemap.gz", "uwb_ro-localization_demo_map.gridmap.gz");
  const Outcome outcome =
      run("polyloc-replay", {write("uwb.ini", text), "--truth",
                             kMrptData + "uwb_ro-localization_demo_GT.txt", "-o", path("uwb")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(summary("uwb")["success"], 1);
  // Its index is that of the pair: matched with the scan before or after, errors are above 0.3 m.
  EXPECT_LT(summary("uwb")["median_error_m"].get<double>(), 0.25);
  EXPECT_EQ(summary("uwb")["median_step"], 1.0);  // the first frame has no action before it
}

/// The median fit of the scans of a log at their true poses, moved along x by so much [m].
double medianFit(const std::string& log, const std::string& map, const std::string& truth_file,
                 double shift) {
  const auto steps = loadReplayLog(kMrptData + log);
  const replay::Truth truth = replay::loadTruthOfSteps(kDatasets + truth_file, steps);
  const CPolygonMap2D polygons(loadMap(kMrptData + map).map);
  std::vector<double> fits;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    mrpt::poses::CPosePDFParticles particle;
    particle.resetDeterministic({truth[i]->x + shift, truth[i]->y, truth[i]->phi}, 1);
    fits.push_back(filterFit(polygons, *steps[i].laser, particle, 1));
  }
  return percentile(fits, 0.5);
}

TEST_F(PolylocReplay, ShippedTruthsFitTheirScans) {
  if (!fs::exists(kMrptData + "localization_demo.rawlog")) GTEST_SKIP() << "mrpt-common is missing";
  const std::string demo = "localization_demo",
                    sena = "2006-01ENE-21-SENA_Telecom Faculty_one_loop_only";
  const std::string faculty = "malaga-cs-fac-building.simplemap.gz";
  const auto fit = [&](bool is_demo, double shift) {
    return is_demo ? medianFit(demo + ".rawlog", demo + ".simplemap.gz", demo + "_truth.tum", shift)
                   : medianFit(sena + ".rawlog", faculty, "sena_loop_truth.tum", shift);
  };
  for (const bool is_demo : {true, false}) {
    const double right = fit(is_demo, 0.0);
    EXPECT_GT(right, -1.3) << is_demo;  // 13 cm a beam, obstacles and all
    for (const double shift : {-0.25, 0.25}) EXPECT_LT(fit(is_demo, shift), right - 0.3) << is_demo;
  }
}

TEST_F(PolylocReplay, FindsARobotThatIsCarriedTwiceThroughAnOffice) {
  POLYLOC_DATA_OR_SKIP(data);
  const auto office = [&](const std::string& carried) {
    return write("office.ini",
                 "[polyloc]\nparticles=300\n" + carried +
                     "[LocalizationExperiment]\nrawlog_file=" + data +
                     "/replay/driving_in_office.rawlog\n[MetricMap]\npolygonMap2D_count=1\n"
                     "[MetricMap_polygonMap2D_00_creationOpts]\nfile=" +
                     data +
                     "/replay/gh25_simulated.simplemap\n"
                     "[MetricMap_polygonMap2D_00_likelihoodOpts]\ndecimation=10\n");
  };
  ASSERT_EQ(run("polyloc-replay", {office(""), "-o", path("whole")}).code, 0);
  EXPECT_EQ(summary("whole")["mixes"], 0.0);  // no alarm in 1,159 scans
  const Outcome outcome =
      run("polyloc-replay", {office("carried=200-420,700-980\n"), "--truth",
                             path("whole/trajectory.tum"), "-o", path("carried")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json result = summary("carried");
  EXPECT_EQ(result["success"], 1);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(result["teleports"][i]["recovered"], 1) << i;
    EXPECT_LE(result["teleports"][i]["max_scans"].get<double>(), 10.0) << i;
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
