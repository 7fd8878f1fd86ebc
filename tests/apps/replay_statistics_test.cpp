#include "ProgramTest.h"
#include "driven_room.h"
#include <mrpt_polyloc/base/errors.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <apps/polyloc-replay/replay_statistics.h>
#include <cmath>
#include <filesystem>
#include <random>

namespace mrpt_polyloc::replay {
namespace {

using mrpt::math::TPose2D;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

/// A run whose estimates are off the truth, (k, 0, 3) at step k, by these metres along y.
RunRecord runOf(const std::vector<double>& errors, std::size_t first = 0) {
  RunRecord run;
  run.seed = 4;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    StepRecord step;
    step.step = first + k;
    step.estimate = {static_cast<double>(first + k), errors[k], 3.0};
    step.particles = 10 + k;
    step.filter_ms = 1.0 + static_cast<double>(k);
    step.search_ms = k == 0 ? 5.0 : 0.0;
    if (k == 0) step.search = LocalizationStatus::unique;
    run.steps.push_back(step);
  }
  return run;
}

Truth truthOf(std::size_t count) {
  Truth truth;
  for (std::size_t k = 0; k < count; ++k) truth.emplace_back(TPose2D(static_cast<double>(k), 0, 3));
  return truth;
}

TEST(ReplayStatistics, SuccessIsFromSomeStepToTheEnd) {
  const Truth truth = truthOf(6);
  EXPECT_EQ(scoreRun(runOf({0, 0, 0, 0, 0, 0}), truth, {}).step, 0U);
  EXPECT_EQ(scoreRun(runOf({0, 0, 9, 0, 0.49, 0}), truth, {}).step, 3U);
  EXPECT_EQ(scoreRun(runOf({9, 9, 9, 9, 9, 0.5}), truth, {}).step, 5U);  // inclusive
  EXPECT_EQ(scoreRun(runOf({0, 0, 0, 0, 0, 0.51}), truth, {}).step, std::nullopt);
  EXPECT_EQ(scoreRun(runOf({0, 0}), Truth(), {}).step, std::nullopt);
  EXPECT_EQ(scoreRun(RunRecord(), truth, {}).step, std::nullopt);
}

TEST(ReplayStatistics, HeadingsCountModuloAFullTurn) {
  const Truth truth = truthOf(1);
  RunRecord run = runOf({0});
  run.steps[0].estimate.phi = 3.0 - 2 * M_PI + 0.17;  // 9.74 degrees
  EXPECT_EQ(scoreRun(run, truth, {}).step, 0U);
  run.steps[0].estimate.phi = 3.0 - 2 * M_PI + 0.18;  // 10.3 degrees
  EXPECT_EQ(scoreRun(run, truth, {}).step, std::nullopt);
}

TEST(ReplayStatistics, StepsWithoutTruthSayNothing) {
  Truth truth = truthOf(5);
  truth[0].reset();
  truth[3].reset();
  EXPECT_EQ(scoreRun(runOf({9, 0, 0, 9, 0}), truth, {}).step, 1U);
  EXPECT_EQ(scoreRun(runOf({0, 0, 9, 9, 0}), truth, {}).step, 4U);
  EXPECT_EQ(scoreRun(runOf({0, 0}), Truth(2), {}).step, std::nullopt);
}

TEST(ReplayStatistics, AgreesWithTheDefinitionOnRandomRuns) {
  std::mt19937 random(11);
  for (int i = 0; i < 500; ++i) {
    const std::size_t count = 1 + random() % 12;
    std::vector<double> errors;
    Truth truth = truthOf(count);
    for (std::size_t k = 0; k < count; ++k) {
      errors.push_back(random() % 3 == 0 ? 2.0 : 0.1);
      if (random() % 4 == 0) truth[k].reset();
    }
    std::optional<std::size_t> expected;
    for (std::size_t from = 0; from < count && !expected; ++from) {
      bool all_right = truth[from].has_value();
      for (std::size_t k = from; k < count; ++k) {
        if (truth[k] && errors[k] > 0.5) all_right = false;
      }
      if (all_right) expected = from;
    }
    ASSERT_EQ(scoreRun(runOf(errors), truth, {}).step, expected) << "case " << i;
  }
}

TEST(ReplayStatistics, SumsUpErrorsTimesAndParticles) {
  RunRecord run = runOf({9, 0.3, 0.4});
  run.steps[2].search = LocalizationStatus::ambiguous;
  run.steps[2].search_ms = 20.0;
  run.steps[2].monitor_ms = 2.0;
  run.steps[2].mixed_in = true;
  const RunScore score = scoreRun(run, truthOf(3), {});
  EXPECT_EQ(score.step, 1U);
  EXPECT_NEAR(score.error_m, std::sqrt((0.09 + 0.16) / 2), 1e-12);
  EXPECT_NEAR(score.error_rad, 0.0, 1e-12);
  EXPECT_EQ(score.search_ms, 5.0);
  EXPECT_EQ(score.first_step_ms, 1.0);
  EXPECT_EQ(score.total_ms, 6.0);
  EXPECT_EQ(score.max_step_ms, 3.0);
  EXPECT_EQ(score.recovery_ms, 22.0);
  EXPECT_EQ(score.first_particles, 10U);
  EXPECT_EQ(score.mean_particles, 11.0);
  EXPECT_EQ(score.searches, 1U);
  EXPECT_EQ(score.mixes, 1U);
}

TEST(ReplayStatistics, CountsTheScansAfterWhichACarriedRobotIsFound) {
  // Steps 0 to 2, 10 to 13, 20 to 21.
  RunRecord run = runOf({0, 0, 0});
  for (const RunRecord& more : {runOf({9, 9, 0, 0}, 10), runOf({9, 9}, 20)}) {
    run.steps.insert(run.steps.end(), more.steps.begin(), more.steps.end());
  }
  const RunScore score = scoreRun(run, truthOf(22), {10, 20});
  EXPECT_THAT(score.found_after, ElementsAre(std::optional<std::size_t>(3), std::nullopt));
  EXPECT_EQ(score.step, std::nullopt);
  EXPECT_THAT(scoreRun(run, Truth(), {10, 20}).found_after, testing::IsEmpty());
}

TEST(ReplayStatistics, StepsAreCutWhereTheRobotIsCarried) {
  ReplayConfig config;
  config.rawlog_offset = 2;
  config.carried = {{4, 5}, {0, 0}, {8, 100}};
  const auto replayed = replayedSteps(config, 10);
  EXPECT_THAT(replayed, ElementsAre(2, 3, 6, 7));
  EXPECT_THAT(stepsAfterGaps(replayed), ElementsAre(6));
  EXPECT_THROW(replayedSteps(config, 2), FormatError);
}

TEST(ReplayStatistics, SummaryHasTheFieldsThatOthersRelyOn) {
  const std::vector<RunRecord> runs = {runOf({9, 0, 0}), runOf({0, 0, 9}), runOf({0, 0, 0})};
  const Truth truth = truthOf(3);
  std::vector<RunScore> scores;
  for (const RunRecord& run : runs) scores.push_back(scoreRun(run, truth, {}));
  ReplayFacts facts;
  facts.init = "polyloc";
  facts.truth_file = "t.tum";
  facts.steps = 3;
  const json result = json::parse(replaySummaryJson(facts, runs, scores));
  EXPECT_EQ(result["runs"], 3);
  EXPECT_EQ(result["success"], 2);
  EXPECT_EQ(result["median_step"], 0.5);
  EXPECT_EQ(result["particles"], 10.0);
  EXPECT_EQ(result["search_ms"], 5.0);
  EXPECT_EQ(result["first_step_ms"], 1.0);
  EXPECT_EQ(result["total_ms"], 6.0);
  EXPECT_EQ(result["per_run"][1]["success"], false);
  EXPECT_TRUE(result["per_run"][1]["step"].is_null());
  EXPECT_THAT(replaySummaryText(facts, scores), HasSubstr("2 of 3"));
}

class ReplayTruth : public test::ProgramTest {
 protected:
  static std::vector<ReplayStep> steps() {
    std::vector<ReplayStep> steps(3);
    for (std::size_t i = 0; i < 3; ++i) {
      steps[i].scan = RangeScan({}, {0, 0}, 100.0 + static_cast<double>(i));
    }
    steps[1].pair = 0;  // the first frame has no action before it
    steps[2].pair = 1;
    return steps;
  }
};

TEST_F(ReplayTruth, IsMatchedByStampOrByPair) {
  const Truth by_stamp = loadTruthOfSteps(
      write("t.tum", "102 2 0 0 0 0 0 1\n100 0 0 0 0 0 0 1\n101 1 0 0 0 0 0 1\n"), steps());
  ASSERT_EQ(by_stamp.size(), 3U);
  EXPECT_EQ(by_stamp[2]->x, 2.0);
  const Truth by_pair = loadTruthOfSteps(write("t.txt", "1 5 6 0.5\n0 3 4 0.5\n"), steps());
  ASSERT_EQ(by_pair.size(), 3U);
  EXPECT_FALSE(by_pair[0]);
  EXPECT_EQ(by_pair[1]->x, 3.0);
  EXPECT_EQ(by_pair[2]->x, 5.0);
  EXPECT_THROW(loadTruthOfSteps(write("u.txt", "2 5 6 0.5\n"), steps()), FormatError);
  EXPECT_THROW(loadTruthOfSteps(write("u.tum", "100 0 0 0 0 0 0 1\n"), steps()), FormatError);
}

}  // namespace
}  // namespace mrpt_polyloc::replay
