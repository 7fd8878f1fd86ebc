#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/sensor_survey.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace mrpt_polyloc {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Scans of ranges up to `reach`; what is beyond `limit` reads `nothing`.
std::vector<LoggedScan> logOf(std::size_t scans, double reach, double limit, double nothing,
                              double stated) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> range(0.6, reach);
  std::vector<LoggedScan> log(scans);
  for (LoggedScan& scan : log) {
    scan.max_range = stated;
    scan.label = "L";
    for (int i = 0; i < 90; ++i) {
      const double r = range(random);
      scan.ranges.push_back(r < limit ? r : nothing);
    }
  }
  return log;
}

struct Surveyed {
  SensorFacts facts;
  Notes notes;
};

Surveyed survey(const std::vector<LoggedScan>& log, const ReadingOptions& options = {}) {
  Surveyed result;
  result.facts = LogSurvey(log, options, &result.notes).of(log.front());
  return result;
}

TEST(SensorSurvey, TakesTheStatedMaximumWhereNothingSpeaksAgainstIt) {
  for (const double nothing : {8.0, 7.99, 81.91, 0.0}) {
    const auto found = survey(logOf(50, 10, 7.9, nothing, 8.0));
    EXPECT_EQ(found.facts.limits.max_range, 8.0) << nothing;
    EXPECT_THAT(found.notes, IsEmpty()) << nothing;
  }
  EXPECT_EQ(survey(logOf(50, 10, 99, 0, 80.0)).facts.limits.max_range, 80.0);
}

TEST(SensorSurvey, FindsAMaximumThatIsNotSaid) {
  for (const double unsaid : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const auto found = survey(logOf(50, 10, 8, 8.19, unsaid));
    EXPECT_EQ(found.facts.limits.max_range, 8.19);
    EXPECT_THAT(found.notes, ElementsAre(HasSubstr("not said, taken for 8.19 m")));
  }
}

TEST(SensorSurvey, TakesNoMaximumWhereNoReadingStandsOut) {
  const auto found = survey(logOf(50, 10, 99, 0, 0));
  EXPECT_EQ(found.facts.limits.max_range, 0.0);
  EXPECT_THAT(found.notes, ElementsAre(HasSubstr("all are taken for hits")));
  // Infinite readings say that there was nothing, as far as the sensor is known to see.
  const double infinity = std::numeric_limits<double>::infinity();
  const auto infinite = survey(logOf(50, 10, 8, infinity, 0));
  EXPECT_NEAR(infinite.facts.limits.max_range, 8.0, 0.02);
}

TEST(SensorSurvey, SeesThatTheStatedMaximumIsWrong) {
  const auto low = survey(logOf(50, 30, 99, 0, 10.0));
  EXPECT_NEAR(low.facts.limits.max_range, 30.0, 0.1);
  EXPECT_THAT(low.notes, ElementsAre(HasSubstr("said to be 10 m")));
  EXPECT_EQ(survey(logOf(50, 60, 50, 51.15, 10.0)).facts.limits.max_range, 51.15);
  const auto high = survey(logOf(50, 10, 8, 8.19, 80.0));
  EXPECT_EQ(high.facts.limits.max_range, 8.19);
  EXPECT_THAT(high.notes, ElementsAre(HasSubstr("8.19 m is the greatest reading of many scans")));
}

TEST(SensorSurvey, PassesOverStrayReadings) {
  auto log = logOf(50, 10, 8, 8.19, 0);
  log[3].ranges[5] = 81.9;
  log[9].ranges[5] = 77.0;
  EXPECT_EQ(survey(log).facts.limits.max_range, 8.19);
}

TEST(SensorSurvey, TheOptionWins) {
  ReadingOptions options;
  options.max_range = 5.0;
  const auto found = survey(logOf(50, 10, 8, 8.19, 80), options);
  EXPECT_EQ(found.facts.limits.max_range, 5.0);
  EXPECT_THAT(found.notes, IsEmpty());
  options.min_range = 5.0;
  EXPECT_THROW(options.check(), InvalidParamsError);
  options = {};
  options.max_range = 0.0;
  EXPECT_THROW(options.check(), InvalidParamsError);
}

TEST(SensorSurvey, FindsTheRobotItself) {
  auto log = logOf(50, 10, 99, 0, 20);
  for (LoggedScan& scan : log) {
    scan.ranges[10] = 0.21 + 0.001 * static_cast<double>(&scan - log.data()) / 5;
    scan.ranges[11] = 0.35;
  }
  log[7].ranges[10] = 3.0;
  const auto found = survey(log);
  ASSERT_EQ(found.facts.robot_beams.size(), 90U);
  EXPECT_EQ(std::count(found.facts.robot_beams.begin(), found.facts.robot_beams.end(), true), 2);
  EXPECT_TRUE(found.facts.robot_beams[10] && found.facts.robot_beams[11]);
  EXPECT_THAT(found.notes, ElementsAre(HasSubstr("2 of 90 beams")));
  const auto scans = toRangeScans("f", log, {}, nullptr);
  EXPECT_EQ(scans[7].beams()[10].kind, BeamKind::invalid);
  EXPECT_EQ(scans[7].beams()[12].kind, BeamKind::hit);

  ReadingOptions options;
  options.min_range = 0.3;  // then nothing is guessed
  EXPECT_THAT(survey(log, options).facts.robot_beams, IsEmpty());
  EXPECT_EQ(toRangeScans("f", log, options, nullptr)[0].beams()[10].kind, BeamKind::invalid);
  EXPECT_EQ(toRangeScans("f", log, options, nullptr)[0].beams()[11].kind, BeamKind::hit);
}

TEST(SensorSurvey, ARobotThatStandsStillIsNotSeen) {
  auto log = logOf(1, 10, 99, 0, 20);
  log[0].ranges[10] = 0.2;
  log.resize(50, log[0]);
  EXPECT_THAT(survey(log).facts.robot_beams, IsEmpty());
}

TEST(SensorSurvey, TellsOfATilt) {
  auto log = logOf(5, 10, 99, 0, 20);
  for (LoggedScan& scan : log) scan.height = 100, scan.pitch = 0.034;
  EXPECT_THAT(survey(log).notes, IsEmpty());
  for (LoggedScan& scan : log) scan.pitch = 0.036;
  EXPECT_THAT(survey(log).notes, ElementsAre(HasSubstr("tilted by 2.06 deg")));
}

}  // namespace
}  // namespace mrpt_polyloc
