#include "PolylocLocalizeTest.h"
#include <mrpt_polyloc/evaluation/truth.h>

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <numeric>

namespace mrpt_polyloc::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

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

TEST_F(PolylocLocalize, TheTreeFindsTheNearestCellsThatTheIndexFinds) {
  // All around, and half of it: there the tree leaves the answer to the index.
  for (const char* fov : {"360", "180"}) {
    simulate("sim", {"--fov", fov});
    const Outcome index = localize({"--method", "cells"});
    const Outcome tree = localize({"--method", "cells", "--nearest", "tree"});
    ASSERT_EQ(tree.code, 0) << tree.err;
    EXPECT_EQ(withoutTimes(tree.out), withoutTimes(index.out)) << fov;
  }
  EXPECT_EQ(localize({"--nearest", "tree"}).code, 2);
  EXPECT_EQ(localize({"--method", "cells", "--nearest", "list"}).code, 2);
}

}  // namespace
}  // namespace mrpt_polyloc::test
