// Rows of more than one scan: several lasers, the last metres of a drive, several maps.
#include "ProgramTest.h"
#include "driven_room.h"
#include "tests/support/data_dir.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <set>

namespace mrpt_polyloc::test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::SizeIs;

class ScanSetPrograms : public ProgramTest {
 protected:
  Outcome localize(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"--map", roomFile(), "--scans", path("drive.rawlog")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("polyloc-localize", arguments);
  }
  Outcome evaluate(const std::string& scans, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"--map",   roomFile(),        "--scans", path(scans),
                                          "--truth", path("truth.tum"), "-o",      path("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("polyloc-eval", arguments);
  }
  nlohmann::json summary() const {
    return nlohmann::json::parse(readFile(path("out/summary.json")));
  }

  const Drive drive_ = driveThroughRoom(12);
};

TEST_F(ScanSetPrograms, RowsWithTheLastMetresAreAsManyAsScans) {
  for (const bool has_actions : {true, false}) {
    (has_actions ? writeActionLog : writeObservationLog)(path("drive.rawlog"), drive_);
    write("truth.tum", tumTruth(drive_));
    ASSERT_EQ(evaluate("drive.rawlog", {"--accumulate", "1"}).code, 0);
    EXPECT_EQ(summary()["scans"], 12);
    EXPECT_EQ(summary()["top1"], 1.0);
    EXPECT_EQ(summary()["status"]["unique"], 12);
    const double one_metre = summary()["median_error_m"];
    ASSERT_EQ(evaluate("drive.rawlog", {"--accumulate", "0"}).code, 0);
    EXPECT_LT(one_metre, summary()["median_error_m"].get<double>() + 0.01);
    // Scan by scan the same rows.
    const Outcome alone = localize({"--max-hypotheses", "1"});
    const Outcome all = localize({"--max-hypotheses", "1", "--accumulate", "2"});
    ASSERT_EQ(all.code, 0) << all.err;
    EXPECT_EQ(linesOf(alone.out).size(), linesOf(all.out).size());
    // The first row has nothing before it.
    EXPECT_EQ(fieldsOf(linesOf(alone.out)[1])[4], fieldsOf(linesOf(all.out)[1])[4]);
    // What others cost is the mean over all scans.
    EXPECT_NE(fieldsOf(linesOf(alone.out)[9])[8], fieldsOf(linesOf(all.out)[9])[8]);
  }
}

TEST_F(ScanSetPrograms, EvalMakesOdometryFromTheTruthWhereThereIsNone) {
  ASSERT_EQ(
      run("polyloc-simulate", {"--map", roomFile(), "-n", "5", "--seed", "1", "-o", path("sim")})
          .code,
      0);
  const std::string scans = "sim/scans.rawlog";
  std::filesystem::copy(path("sim/truth.tum"), path("truth.tum"));
  const Outcome without =
      run("polyloc-localize", {"--map", roomFile(), "--scans", path(scans), "--accumulate", "2"});
  EXPECT_EQ(without.code, 1);
  EXPECT_THAT(without.err, AllOf(HasSubstr("scans.rawlog"), HasSubstr("no odometry")));
  ASSERT_EQ(evaluate(scans, {"--accumulate", "2"}).code, 0);
  EXPECT_EQ(summary()["top1"], 1.0);
  EXPECT_EQ(evaluate(scans, {"--accumulate", "2", "--odometry-noise", "0.1,5,5"}).code, 0);
}

TEST_F(ScanSetPrograms, SeveralMapsAreOneQuery) {
  writeActionLog(path("drive.rawlog"), drive_);
  const std::string other = write("other.wkt", "POLYGON ((0 0, 9 0, 9 3, 5 3, 5 7, 0 7, 0 0))\n");
  const Outcome outcome = localize({"--map", other, "--rows", "0,5", "--accumulate", "1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto lines = linesOf(outcome.out);
  EXPECT_THAT(lines.front(), EndsWith(",cov_xy,map"));
  std::set<std::string> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto fields = fieldsOf(lines[i]);
    ASSERT_THAT(fields, SizeIs(17));
    if (fields[3] != "1") continue;
    rows.insert(fields[0]);
    EXPECT_EQ(fields[16], roomFile());
  }
  EXPECT_THAT(rows, SizeIs(2));
  EXPECT_EQ(localize({"--map", other, "--svg", path("pic.svg")}).code, 2);
  EXPECT_EQ(localize({"--map", other, "--method", "cells"}).code, 2);
  EXPECT_EQ(localize({"--map", path("none.wkt")}).code, 1);
}

TEST_F(ScanSetPrograms, WrongUseIsNamed) {
  writeActionLog(path("drive.rawlog"), drive_);
  write("truth.tum", tumTruth(drive_));
  EXPECT_EQ(localize({"--accumulate", "-1"}).code, 2);
  EXPECT_EQ(localize({"--accumulate", "1", "--method", "cells"}).code, 2);
  EXPECT_EQ(evaluate("drive.rawlog", {"--accumulate", "1", "--odometry-noise", "1,2"}).code, 2);
  EXPECT_EQ(evaluate("drive.rawlog", {"--accumulate", "1", "--odometry-noise", "1,2,-1"}).code, 2);
  const Outcome unknown = localize({"--sensor", "LASER,TAIL"});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("'"));
  // A log begun again: its clock runs back.
  const std::string log = readFile(path("drive.rawlog"));
  write("drive.rawlog", log + log);
  const Outcome back = localize({"--accumulate", "50"});
  EXPECT_EQ(back.code, 1);
  EXPECT_THAT(back.err, AllOf(HasSubstr("drive.rawlog: row "), HasSubstr("by its stamp")));
}

TEST_F(ScanSetPrograms, BothLasersOfCase15TellMoreThanOne) {
  POLYLOC_DATA_OR_SKIP(data);
  const std::string folder = data + "/cases/15-two-lasers/";
  const auto unique = [&](const std::string& sensors) {
    const Outcome outcome = run(
        "polyloc-eval", {"--map", folder + "map.wkt", "--scans", folder + "scans.rawlog", "--truth",
                         folder + "truth.tum", "--sensor", sensors, "-o", path("out")});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return summary()["status"]["unique"].get<int>();
  };
  EXPECT_LT(unique("front"), 45);
  // 57 of 60 with the threshold of `unique` before it knew what foreign scans do to it.
  EXPECT_GE(unique("front,rear"), 50);
  EXPECT_EQ(summary()["scans"], 60);
  EXPECT_GT(summary()["unique_right"].get<double>(), 0.98);
}

}  // namespace
}  // namespace mrpt_polyloc::test
