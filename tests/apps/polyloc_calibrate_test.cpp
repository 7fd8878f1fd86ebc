#include "ProgramTest.h"
#include <mrpt_polyloc/io/polygon_files.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace mrpt_polyloc::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class PolylocCalibrate : public ProgramTest {
 protected:
  /// Three rooms of different shapes with scans of each: sets.txt, and a folder each.
  void makeSets() const {
    const auto make = [&](const std::string& name, const std::string& wkt, const char* seed) {
      const std::string map = write(name + ".wkt", wkt);
      const Outcome outcome = run("polyloc-simulate", {"--map", map, "-n", "8", "--seed", seed,
                                                       "--sigma", "0.03", "-o", path(name)});
      ASSERT_EQ(outcome.code, 0) << outcome.err;
    };
    make("hall", "POLYGON((0 0, 9 0, 9 6, 6 6, 6 4, 0 4, 0 0))\n", "1");
    make("cross", "POLYGON((0 0, 3 0, 3 -2, 5 -2, 5 0, 7 0, 7 3, 4 3, 4 5, 2 5, 2 3, 0 3, 0 0))\n",
         "2");
    make("corridor", "POLYGON((0 0, 14 0, 14 2, 8 2, 8 5, 5 5, 5 2, 0 2, 0 0))\n", "3");
    write("good.txt", "0\n1\n2\n3\n4\n5\n");
    write("sets.txt",
          "# three rooms\n"
          "hall hall.wkt hall/scans.rawlog hall/truth.tum good.txt\n\n"
          "cross cross.wkt cross/scans.rawlog cross/truth.tum\n"
          "corridor corridor.wkt corridor/scans.rawlog corridor/truth.tum  # the last\n");
  }

  Outcome calibrate(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {path("sets.txt"), "-o", path("out"), "--cluttered", "5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("polyloc-calibrate", arguments);
  }

  void expectFailure(const std::string& list, const std::string& file, const std::string& place) {
    write("sets.txt", list);
    const Outcome outcome = calibrate();
    EXPECT_EQ(outcome.code, 1) << list;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("polyloc-calibrate: "), HasSubstr(file)));
    EXPECT_THAT(outcome.err, HasSubstr(place));
    EXPECT_FALSE(std::filesystem::exists(path("out"))) << list;
  }
};

TEST_F(PolylocCalibrate, WritesConstantsAndCurvesThatTheOthersRead) {
  makeSets();
  const Outcome outcome = calibrate({"--header", path("constants.h"), "--threads", "2"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(files("out"), ElementsAre("calibration.json", "reliability.csv", "reliability.svg",
                                        "report.json", "roc.csv", "roc.svg"));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("foreign scans refused"), HasSubstr("left out")));
  const json report = json::parse(readFile(path("out/report.json")));
  EXPECT_EQ(report["calibration"], json::parse(readFile(path("out/calibration.json"))));
  EXPECT_EQ(report["fitted"]["good"], 22);
  EXPECT_EQ(report["fitted"]["foreign"], 48);
  EXPECT_EQ(report["fitted"]["cluttered"], 15);
  EXPECT_GT(report["fitted"]["roc_area"], 0.9);
  EXPECT_THAT(readFile(path("constants.h")), AllOf(HasSubstr("kWeightDecay"), HasSubstr("cross")));
  EXPECT_EQ(linesOf(readFile(path("out/roc.csv"))).front(), "kind,threshold,lost,refused");
  EXPECT_EQ(linesOf(readFile(path("out/reliability.csv"))).size(), 1U + 2 * 6U);
  for (const char* picture : {"out/roc.svg", "out/reliability.svg"}) {
    EXPECT_THAT(readFile(path(picture)), AllOf(HasSubstr("<svg"), HasSubstr("</svg>")));
  }

  const Outcome evaluated =
      run("polyloc-eval", {"--map", path("hall.wkt"), "--scans", path("hall/scans.rawlog"),
                           "--truth", path("hall/truth.tum"), "--calibration",
                           path("out/calibration.json"), "-o", path("eval")});
  EXPECT_EQ(evaluated.code, 0) << evaluated.err;
}

TEST_F(PolylocCalibrate, ConstantsDoNotDependOnThreads) {
  makeSets();
  const auto constants = [&](const char* threads) {
    EXPECT_EQ(calibrate({"--threads", threads}).code, 0);
    return readFile(path("out/calibration.json"));
  };
  EXPECT_EQ(constants("1"), constants("2"));
}

TEST_F(PolylocCalibrate, ScalesItsMapsAndRefusesThoseThatDoNotFit) {
  makeSets();
  ASSERT_EQ(calibrate().code, 0);
  const std::string in_metres = readFile(path("out/calibration.json"));
  for (const char* name : {"hall.wkt", "cross.wkt", "corridor.wkt"}) {  // half metres
    write(name, toText(loadPolygonMap(path(name), nullptr, 2.0).map, ".wkt"));
  }
  ASSERT_EQ(calibrate({"--scale", "0.5"}).code, 0);
  EXPECT_EQ(readFile(path("out/calibration.json")), in_metres);
  const Outcome refused = calibrate({"--scale", "0.5", "--max-memory", "0.2"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("hall.wkt"), HasSubstr("--max-memory")));
}

TEST_F(PolylocCalibrate, ACalibrationDecidesWhatIsRefused) {
  makeSets();
  ASSERT_EQ(calibrate().code, 0);
  json calibration = json::parse(readFile(path("out/calibration.json")));
  const auto refused = [&](double least, const std::vector<std::string>& more = {}) {
    calibration["least_match_probability"] = least;
    const std::string file = write("changed.json", calibration.dump());
    std::vector<std::string> arguments = {"--map",
                                          path("hall.wkt"),
                                          "--scans",
                                          path("hall/scans.rawlog"),
                                          "--truth",
                                          path("hall/truth.tum"),
                                          "--calibration",
                                          file,
                                          "-o",
                                          path("eval")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run("polyloc-eval", arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return json::parse(readFile(path("eval/summary.json")))["status"]["no_match"].get<int>();
  };
  EXPECT_EQ(refused(0.0), 0);
  calibration["lost_thresholds"] = {0, 0, 0, 0, 0, 0, 0, 1};
  EXPECT_EQ(refused(1.0, {"--max-lost", "0.03"}), 0);
  EXPECT_EQ(refused(0.0, {"--max-lost", "0.05"}), 8);
  calibration["match_intercept"] = -1e6;
  EXPECT_EQ(refused(0.5), 8);
}

TEST_F(PolylocCalibrate, AnotherFormOfABuildingCountsForWeightsAlone) {
  makeSets();
  ASSERT_EQ(calibrate().code, 0);
  const json before = json::parse(readFile(path("out/report.json")));
  const std::string list = readFile(path("sets.txt"));
  write("sets.txt", list + "hall/again hall.wkt cross/scans.rawlog cross/truth.tum\n");
  ASSERT_EQ(calibrate().code, 0);
  const json after = json::parse(readFile(path("out/report.json")));
  for (const char* count : {"good", "foreign", "cluttered"}) {
    EXPECT_EQ(after["fitted"][count], before["fitted"][count]) << count;
  }
  for (const char* constant : {"match_intercept", "match_weights", "least_match_probability"}) {
    EXPECT_EQ(after["calibration"][constant], before["calibration"][constant]) << constant;
  }
  // Its scans are of another place: what was unique and right no longer is.
  EXPECT_NE(after["calibration"]["weight_decay"], before["calibration"]["weight_decay"]);
}

TEST_F(PolylocCalibrate, OnCoarseCellsLessIsUnique) {
  makeSets();
  const auto unique = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "--map",   path("corridor.wkt"),       "--scans", path("corridor/scans.rawlog"),
        "--truth", path("corridor/truth.tum"), "-o",      path("eval")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run("polyloc-eval", arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return json::parse(readFile(path("eval/summary.json")))["status"]["unique"].get<int>();
  };
  // Nearly its own mirror image.
  EXPECT_GT(unique({}), unique({"--cell-size", "50"}));
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--cell-size", "0"}, {"--max-lost", "1.5"}}) {
    EXPECT_EQ(run("polyloc-localize", {"--map", path("corridor.wkt"), "--scans",
                                       path("corridor/scans.rawlog"), more[0], more[1]})
                  .code,
              2);
  }
}

TEST_F(PolylocCalibrate, BadListsNameFileAndPlace) {
  makeSets();
  const std::string hall = "hall hall.wkt hall/scans.rawlog hall/truth.tum good.txt\n";
  expectFailure("", "sets.txt", "empty file");
  expectFailure(hall, "sets.txt", "fewer than two sets");
  expectFailure(hall + "hall/coarse hall.wkt hall/scans.rawlog hall/truth.tum\n", "sets.txt",
                "fewer than two sets");
  expectFailure(hall + "cross cross.wkt\n", "sets.txt", "line 2");
  expectFailure(hall + "\n" + hall, "sets.txt", "line 3");
  expectFailure(hall + "x gone.wkt cross/scans.rawlog cross/truth.tum\n", "gone.wkt",
                "no such file");
  expectFailure(hall + "x cross.wkt gone.rawlog cross/truth.tum\n", "gone.rawlog", "");
  expectFailure(hall + "x cross.wkt cross/scans.rawlog cross/truth.tum sets.txt\n", "sets.txt",
                "line 1");
  const Outcome outcome = run("polyloc-calibrate", {path("gone.txt"), "-o", path("out")});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("gone.txt"));
}

TEST_F(PolylocCalibrate, ABadCalibrationFileFails) {
  makeSets();
  const auto evaluate = [&](const std::string& calibration) {
    return run("polyloc-eval",
               {"--map", path("hall.wkt"), "--scans", path("hall/scans.rawlog"), "--truth",
                path("hall/truth.tum"), "--calibration", calibration, "-o", path("eval")});
  };
  for (const std::string& file :
       {path("gone.json"), write("bad.json", "{\"weight_decay\": 1}"), write("not.json", "x")}) {
    const Outcome outcome = evaluate(file);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr(file));
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
