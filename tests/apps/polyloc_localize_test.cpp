#include "ProgramTest.h"
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/io/rawlog_writer.h>

#include <gmock/gmock.h>
#include <mrpt/core/Clock.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>

namespace mrpt_polyloc::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;
using testing::UnorderedElementsAre;

const char* const kHeader =
    "row,stamp,status,rank,x,y,phi_deg,weight,cost,std_x,std_y,std_phi_deg,ms,match,listed,cov_xy";

constexpr std::size_t kColumns = 16, kTimeColumn = 12;

/// CSV without the time.
std::string withoutTimes(const std::string& csv) {
  std::string rest;
  for (const std::string& line : linesOf(csv)) {
    std::vector<std::string> fields = fieldsOf(line);
    if (fields.size() > kTimeColumn) fields[kTimeColumn].clear();
    for (const std::string& field : fields) rest += field + ",";
    rest += "\n";
  }
  return rest;
}

class PolylocLocalize : public ProgramTest {
 protected:
  Outcome localize(const std::vector<std::string>& more,
                   const std::string& scans = "sim/scans.rawlog") const {
    std::vector<std::string> arguments = {"--map", roomFile(), "--scans", path(scans)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("polyloc-localize", arguments);
  }

  /// The fields of the rows of rank 1, by row.
  static std::map<int, std::vector<std::string>> firstAnswers(const std::string& csv) {
    std::map<int, std::vector<std::string>> answers;
    const std::vector<std::string> lines = linesOf(csv);
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const std::vector<std::string> fields = fieldsOf(lines[i]);
      if (fields[3] == "1") answers[std::stoi(fields[0])] = fields;
    }
    return answers;
  }

  /// A rawlog of scans with so many beams each.
  std::string scansOfBeams(const std::vector<std::size_t>& counts) const {
    std::vector<mrpt::obs::CObservation2DRangeScan> scans;
    for (const std::size_t count : counts) {
      mrpt::obs::CObservation2DRangeScan scan;
      scan.sensorLabel = "LASER";
      scan.timestamp = mrpt::Clock::fromDouble(1e9 + static_cast<double>(scans.size()));
      scan.aperture = count > 1 ? 3.0f : 0.0f;
      scan.maxRange = 20.0f;
      scan.resizeScanAndAssign(count, 1.5f, true);
      scans.push_back(scan);
    }
    writeScansRawlog(path("few.rawlog"), scans);
    return "few.rawlog";
  }
};

TEST_F(PolylocLocalize, KeepsItsIndexInAFile) {
  simulate("sim");
  const Outcome plain = localize({});
  const Outcome writes = localize({"--index", path("room.index")});
  ASSERT_EQ(writes.code, 0) << writes.err;
  ASSERT_TRUE(std::filesystem::exists(path("room.index")));
  const Outcome reads = localize({"--index", path("room.index")});
  ASSERT_EQ(reads.code, 0) << reads.err;
  EXPECT_EQ(withoutTimes(writes.out), withoutTimes(plain.out));
  EXPECT_EQ(withoutTimes(reads.out), withoutTimes(plain.out));
}

TEST_F(PolylocLocalize, ExplainsWhatItMakesOfMapAndScans) {
  simulate("sim");
  const Outcome outcome = localize({"--explain"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("free space    36.90 m2 in 1 parts"), HasSubstr("hits"),
                                 HasSubstr("odd: no reading is a no-return")));
  EXPECT_THAT(localize({"--explain", "--max-range", "2"}).out,
              AllOf(HasSubstr("nothing within 2.00 m"), HasSubstr("odd: the range is short")));
  EXPECT_EQ(localize({"--explain", "--method", "exact"}).code, 2);
  write("bad.wkt", "POLYGON ((");
  EXPECT_EQ(run("polyloc-localize",
                {"--map", path("bad.wkt"), "--scans", path("sim/scans.rawlog"), "--explain"})
                .code,
            1);
}

TEST_F(PolylocLocalize, TakesLimitsOfTheRange) {
  simulate("sim");
  const std::string plain = withoutTimes(localize({}).out);
  EXPECT_NE(withoutTimes(localize({"--max-range", "1.5"}).out), plain);
  EXPECT_NE(withoutTimes(localize({"--min-range", "1.5"}).out), plain);
  EXPECT_EQ(withoutTimes(localize({"--max-range", "1000", "--min-range", "0"}).out), plain);
  for (const char* bad : {"0", "-1", "inf", "x"}) {
    EXPECT_EQ(localize({"--max-range", bad}).code, 2) << bad;
  }
  EXPECT_EQ(localize({"--min-range", "-1"}).code, 2);
  EXPECT_EQ(localize({"--max-range", "1", "--min-range", "2"}).code, 1);
}

TEST_F(PolylocLocalize, UsesTheWholePartOfALogThatIsCutShort) {
  simulate("sim");
  const std::string whole = readFile(path("sim/scans.rawlog"));
  write("cut.rawlog", whole.substr(0, whole.size() - 20));
  const Outcome outcome = localize({}, "cut.rawlog");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, AllOf(StartsWith("polyloc-localize: "),
                                 HasSubstr("cut.rawlog: note: it is cut short")));
  const Outcome strict = localize({"--strict"}, "cut.rawlog");
  EXPECT_EQ(strict.code, 1);
  EXPECT_THAT(strict.err, HasSubstr("truncated"));
}

TEST_F(PolylocLocalize, ScalesAMapInMillimetres) {
  simulate("sim");
  write("mm.wkt", "POLYGON ((0 0, 4000 0, 4000 3000, 0 3000))");
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--map", path("mm.wkt"), "--scans",
                                          path("sim/scans.rawlog")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("polyloc-localize", arguments);
  };
  const Outcome refused = with({});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("mm.wkt"), HasSubstr("--scale 0.001")));
  EXPECT_EQ(with({"--scale", "0.001"}).code, 0);
  EXPECT_EQ(with({"--scale", "0"}).code, 2);
}

TEST_F(PolylocLocalize, RefusesAFileThatIsNotItsIndex) {
  simulate("sim");
  write("bad.index", "no index at all");
  const Outcome outcome = localize({"--index", path("bad.index")});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("bad.index"), HasSubstr("not a search index")));
  write("empty.index", "");
  EXPECT_EQ(localize({"--index", path("empty.index")}).code, 1);
  EXPECT_EQ(localize({"--index", "/no/such/folder/room.index"}).code, 1);
}

TEST_F(PolylocLocalize, AnswersWithinATimeBudget) {
  simulate("sim");
  const Outcome outcome = localize({"--time-budget", "0.001"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(linesOf(outcome.out).front(), kHeader);
}

TEST_F(PolylocLocalize, MethodsAgreeOnTheFirstAnswer) {
  simulate("sim");
  const auto certified = firstAnswers(localize({}).out);
  for (const std::vector<std::string>& other :
       {std::vector<std::string>{"--method", "cells"}, {"--search-metric", "polar"}}) {
    const auto others = firstAnswers(localize(other).out);
    ASSERT_EQ(certified.size(), others.size());
    for (const auto& [row, fields] : certified) {
      for (const std::size_t column : {4U, 5U}) {
        EXPECT_NEAR(std::stod(fields[column]), std::stod(others.at(row)[column]), 0.02) << row;
      }
    }
  }
}

TEST_F(PolylocLocalize, ThePolarMetricSearchesElsewhereAmidClutter) {
  simulate("sim", {"--short", "0.3"});
  const Outcome robust = localize({}), polar = localize({"--search-metric", "polar"});
  ASSERT_EQ(robust.code, 0) << robust.err;
  ASSERT_EQ(polar.code, 0) << polar.err;
  EXPECT_EQ(withoutTimes(localize({"--search-metric", "robust"}).out), withoutTimes(robust.out));
  EXPECT_NE(withoutTimes(polar.out), withoutTimes(robust.out));
}

TEST_F(PolylocLocalize, FindsEveryScanOfAnAsymmetricRoom) {
  simulate("sim");
  const Outcome outcome = localize({});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_EQ(linesOf(outcome.out).front(), kHeader);
  const auto answers = firstAnswers(outcome.out);
  const auto truth = loadTum(path("sim/truth.tum"));
  ASSERT_EQ(answers.size(), 12u);
  for (const auto& [row, fields] : answers) {
    const auto& pose = truth[static_cast<std::size_t>(row)].pose_map_robot;
    EXPECT_NEAR(std::stod(fields[1]), truth[static_cast<std::size_t>(row)].stamp, 1e-6);
    EXPECT_NEAR(std::stod(fields[4]), pose.x, 0.1) << "row " << row;
    EXPECT_NEAR(std::stod(fields[5]), pose.y, 0.1) << "row " << row;
    EXPECT_NEAR(std::remainder(std::stod(fields[6]) - pose.phi * 180 / M_PI, 360), 0, 2)
        << "row " << row;
  }
}

TEST_F(PolylocLocalize, WeightsOfAScanSumToWhatIsListedAndRanksCount) {
  simulate("sim");
  std::map<std::string, std::vector<double>> weights;
  std::map<std::string, double> listed;
  const std::vector<std::string> lines = linesOf(localize({}).out);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = fieldsOf(lines[i]);
    ASSERT_THAT(fields, SizeIs(kColumns));
    listed[fields[0]] = std::stod(fields[14]);
    EXPECT_GT(std::stod(fields[13]), 0.5);  // match: the scans are this room's
    const double limit = std::stod(fields[9]) * std::stod(fields[10]) + 1e-8;
    EXPECT_LE(std::abs(std::stod(fields[15])), limit);  // a covariance
    weights[fields[0]].push_back(std::stod(fields[7]));
    EXPECT_EQ(std::stoul(fields[3]), weights[fields[0]].size());
  }
  EXPECT_THAT(weights, SizeIs(12));
  for (const auto& [row, parts] : weights) {
    EXPECT_NEAR(std::accumulate(parts.begin(), parts.end(), 0.0), listed[row], 1e-4) << row;
    EXPECT_NEAR(listed[row], 1.0, 1e-4);
  }
}

TEST_F(PolylocLocalize, AListCutShortSaysHowMuchOfThePosteriorItHolds) {
  // A square room looks the same from four poses.
  write("square.wkt", "POLYGON ((0 0, 5 0, 5 5, 0 5, 0 0))\n");
  ASSERT_EQ(run("polyloc-simulate", {"--map", path("square.wkt"), "-n", "3", "--seed", "4",
                                     "--clearance", "0.5", "-o", path("square")})
                .code,
            0);
  const auto answers = [&](const char* most) {
    return firstAnswers(
        run("polyloc-localize", {"--map", path("square.wkt"), "--scans",
                                 path("square/scans.rawlog"), "--max-hypotheses", most})
            .out);
  };
  const auto all = answers("20"), one = answers("1");
  ASSERT_THAT(all, SizeIs(3));
  for (const auto& [row, fields] : one) {
    EXPECT_NEAR(std::stod(fields[7]), std::stod(all.at(row)[7]), 1e-4);  // of the whole
    EXPECT_NEAR(std::stod(fields[14]), std::stod(fields[7]), 1e-4);
    EXPECT_LT(std::stod(fields[14]), 0.5);
    EXPECT_EQ(fields[2], "ambiguous");
  }
}

TEST_F(PolylocLocalize, RowsChoosesScansAndClips) {
  simulate("sim");
  const Outcome outcome = localize({"--rows", "10-99,3"});
  ASSERT_EQ(outcome.code, 0);
  std::vector<int> rows;
  for (const auto& answer : firstAnswers(outcome.out)) rows.push_back(answer.first);
  EXPECT_THAT(rows, ElementsAre(3, 10, 11));
}

TEST_F(PolylocLocalize, RowsOutOfRangeFail) {
  simulate("sim");
  const Outcome outcome = localize({"--rows", "12-20"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("scans.rawlog"), HasSubstr("--rows 12-20"),
                                 HasSubstr("rows 0 to 11")));
}

TEST_F(PolylocLocalize, ResultsDoNotDependOnThreadsOrRuns) {
  simulate("sim", {"--occluders", "2"});
  const std::string once = withoutTimes(localize({"--threads", "1"}).out);
  EXPECT_THAT(linesOf(once), SizeIs(testing::Ge(13u)));
  EXPECT_EQ(once, withoutTimes(localize({"--threads", "1"}).out));
  EXPECT_EQ(once, withoutTimes(localize({"--threads", "2"}).out));
  EXPECT_EQ(once, withoutTimes(localize({}).out));
}

TEST_F(PolylocLocalize, MaxHypothesesLimitsTheList) {
  simulate("sim");
  const Outcome outcome = localize({"--max-hypotheses", "1"});
  EXPECT_THAT(linesOf(outcome.out), SizeIs(1 + 12));
  EXPECT_THAT(firstAnswers(outcome.out), SizeIs(12));
}

TEST_F(PolylocLocalize, ACompassAndAPlaceRuleOutOtherPoses) {
  simulate("sim");
  const auto truth = loadTum(path("sim/truth.tum"))[0].pose_map_robot;
  const std::string place = std::to_string(truth.x) + "," + std::to_string(truth.y) + ",0.5";
  const Outcome near = localize({"--rows", "0", "--near", place});
  const auto answers = firstAnswers(near.out);
  ASSERT_THAT(answers, SizeIs(1));
  const std::vector<std::string> lines = linesOf(near.out);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = fieldsOf(lines[i]);
    EXPECT_LT(std::hypot(std::stod(fields[4]) - truth.x, std::stod(fields[5]) - truth.y), 1.0);
  }
  const double degrees = truth.phi * 180 / M_PI;
  for (const std::string& line :
       linesOf(localize({"--rows", "0", "--compass", std::to_string(degrees), "--compass-tolerance",
                         "15"})
                   .out)) {
    const std::vector<std::string> fields = fieldsOf(line);
    if (fields[3] == "rank" || fields[3] == "0") continue;
    EXPECT_LT(std::abs(std::remainder(std::stod(fields[6]) - degrees, 360)), 20);
  }
}

TEST_F(PolylocLocalize, TheNearestCellsHonourCompassAndPlaceToo) {
  simulate("sim");
  const auto truth = loadTum(path("sim/truth.tum"));
  const auto firstPose = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--rows", "2", "--method", "cells"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = localize(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return fieldsOf(linesOf(outcome.out).at(1));
  };
  const double degrees = truth[2].pose_map_robot.phi * 180 / M_PI;
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--compass", std::to_string(degrees)}, {"--range", "2"}}) {
    const std::vector<std::string> fields = firstPose(more);
    ASSERT_EQ(fields[3], "1");
    EXPECT_NEAR(std::stod(fields[4]), truth[2].pose_map_robot.x, 0.05);
    EXPECT_NEAR(std::stod(fields[5]), truth[2].pose_map_robot.y, 0.05);
    EXPECT_LT(std::abs(std::remainder(std::stod(fields[6]) - degrees, 360)), 1.0);
  }
  // The other way round at best something else fits, and nothing far away.
  const std::vector<std::string> reversed = firstPose({"--compass", std::to_string(degrees + 180)});
  EXPECT_TRUE(reversed[3] == "0" ||
              std::abs(std::remainder(std::stod(reversed[6]) - degrees, 360)) > 160);
  EXPECT_EQ(firstPose({"--near", "100,100,1"})[3], "0");
}

TEST_F(PolylocLocalize, ScansWithoutInformationHaveOneRowOfRankZero) {
  const Outcome outcome = localize({}, scansOfBeams({0, 1}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<std::string> lines = linesOf(outcome.out);
  ASSERT_THAT(lines, SizeIs(3));
  EXPECT_THAT(lines[1], StartsWith("0,1000000000.000000,too_few_beams,0,,,,,,,,,"));
  EXPECT_THAT(lines[2], StartsWith("1,1000000001.000000,too_few_beams,0,,,,,,,,,"));
  EXPECT_THAT(fieldsOf(lines[1]), SizeIs(kColumns));
  EXPECT_EQ(lines[1].substr(lines[1].size() - 10), ",0.0000,0,");  // match, listed, no covariance
}

TEST_F(PolylocLocalize, WritesCsvPictureAndIni) {
  simulate("sim");
  const Outcome outcome = localize({"--rows", "0-2", "-o", path("out.csv"), "--svg",
                                    path("out.svg"), "--pf-ini", path("out.ini")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_EQ(linesOf(readFile(path("out.csv"))).front(), kHeader);
  EXPECT_THAT(readFile(path("out.svg")),
              AllOf(HasSubstr("class=\"hit\""), HasSubstr("class=\"best\""),
                    HasSubstr("class=\"path\""), HasSubstr("</svg>")));
  EXPECT_THAT(files(), ElementsAre("out.csv", "out.ini", "out.svg", "room.wkt", "sim"));

  std::map<std::string, double> values;
  const std::vector<std::string> ini = linesOf(readFile(path("out.ini")));
  EXPECT_THAT(ini, Contains("[LocalizationExperiment]"));
  for (const std::string& line : ini) {
    const std::size_t equals = line.find('=');
    if (line[0] != '#' && equals != std::string::npos) {
      values[line.substr(0, equals)] = std::stod(line.substr(equals + 1));
    }
  }
  const auto truth = loadTum(path("sim/truth.tum"))[0].pose_map_robot;
  EXPECT_EQ(values.at("init_PDF_mode"), 1);
  EXPECT_LT(values.at("init_PDF_min_x"), truth.x);
  EXPECT_GT(values.at("init_PDF_max_x"), truth.x);
  EXPECT_GE(values.at("init_PDF_max_x") - values.at("init_PDF_min_x"), 0.4999);
  EXPECT_LT(values.at("init_PDF_min_y"), truth.y);
  EXPECT_GT(values.at("init_PDF_max_y"), truth.y);
  EXPECT_GE(values.at("init_PDF_max_yaw_deg") - values.at("init_PDF_min_yaw_deg"), 9.999);
}

TEST_F(PolylocLocalize, NoIniWithoutALocalizedScan) {
  const Outcome outcome =
      localize({"-o", path("out.csv"), "--pf-ini", path("out.ini")}, scansOfBeams({1}));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("out.ini"), HasSubstr("no scan could be localized")));
  EXPECT_THAT(files(), ElementsAre("few.rawlog", "room.wkt"));
}

TEST_F(PolylocLocalize, BadScanFilesFailWithAMessage) {
  const auto expectFailure = [&](const std::string& scans, const std::string& reason) {
    const Outcome outcome = localize({}, scans);
    EXPECT_EQ(outcome.code, 1) << scans;
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("polyloc-localize: "), HasSubstr(scans), HasSubstr(reason)));
    EXPECT_THAT(outcome.out, IsEmpty());
  };
  expectFailure("missing.rawlog", "no such file");
  expectFailure("missing.log", "no such file");
  write("scans.bag", "x");
  expectFailure("scans.bag", "unknown extension");
  write("empty.rawlog", "");
  expectFailure("empty.rawlog", "empty");
  write("empty.log", "");
  expectFailure("empty.log", "");
  write("foreign.rawlog", "no rawlog at all");
  expectFailure("foreign.rawlog", "");
  write("fov.log", "FLASER 3 1.0 1.0 1.0 0 0 0 0 0 0 1.0 host 1.0\n");
  expectFailure("fov.log", "--laser-fov");
}

TEST_F(PolylocLocalize, LaserFovSaysWhatACarmenLogDoesNot) {
  write("fov.log", "FLASER 3 1.0 1.0 1.0 0 0 0 0 0 0 1.0 host 1.0\n");
  const Outcome outcome = localize({"--laser-fov", "180"}, "fov.log");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(linesOf(outcome.out), SizeIs(2));
}

TEST_F(PolylocLocalize, AnUnknownSensorLabelFails) {
  simulate("sim");
  EXPECT_EQ(localize({"--sensor", "LASER", "--rows", "0"}).code, 0);
  const Outcome outcome = localize({"--sensor", "REAR"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("REAR"));
}

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
  expectFailure("", "holds no polygon");
  expectFailure("\nPOLYGON ((1 1, 2 1, 2 2, 1 x))\n", "line 2");
  expectFailure("\nPOLYGON EMPTY\n", "line 2: expected one POLYGON");
  expectFailure("POLYGON ((-3 -3, 3 -3, 3 3, -3 3), (1 1, 1 2, 2 2))", "with holes");
  expectFailure("POLYGON ((0 0, 3 0, 3 3))", "at the robot itself");
  expectFailure("POLYGON ((1 1, 3 1, 3 3, 1 3))", "line 1: ");
}

TEST_F(PolylocLocalize, UnwritableOutputFailsBeforeTheSearch) {
  const std::string room = roomFile();
  for (const char* option : {"-o", "--svg", "--pf-ini"}) {
    const Outcome outcome = localize({option, room + "/out"}, "missing.rawlog");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(room + "/out"), HasSubstr("Not a directory")));
  }
  EXPECT_THAT(files(), ElementsAre("room.wkt"));
}

}  // namespace
}  // namespace mrpt_polyloc::test
