#include "tests/support/temp_file.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/calibration_files.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>

namespace mrpt_polyloc::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Calibration someCalibration() {
  Calibration calibration;
  calibration.match_intercept = -3.25;
  calibration.match_weights = {1.5, 2.0, -0.5, 0.125, 0.25};
  calibration.least_match_probability = 0.0625;
  calibration.lost_thresholds = {0.0, 0.0, 0.125, 0.25, 0.25, 0.5, 0.625, 0.75};
  calibration.weight_decay = 3.0;
  calibration.unique_probability = 0.875;
  calibration.position_factor = 1.25;
  calibration.heading_factor = 0.75;
  return calibration;
}

std::string complaintOf(const std::string& text) {
  const TempFile file(".json", text);
  try {
    loadCalibration(file.path());
  } catch (const FormatError& error) {
    EXPECT_THAT(error.what(), HasSubstr(file.path()));
    return error.what();
  }
  return "";
}

TEST(CalibrationFile, WhatIsWrittenIsRead) {
  const Calibration before = someCalibration();
  const TempFile file(".json", calibrationJson(before).dump(2));
  const Calibration after = loadCalibration(file.path());
  EXPECT_EQ(after.match_intercept, before.match_intercept);
  EXPECT_EQ(after.match_weights, before.match_weights);
  EXPECT_EQ(after.least_match_probability, before.least_match_probability);
  EXPECT_EQ(after.lost_thresholds, before.lost_thresholds);
  EXPECT_EQ(after.weight_decay, before.weight_decay);
  EXPECT_EQ(after.unique_probability, before.unique_probability);
  EXPECT_EQ(after.position_factor, before.position_factor);
  EXPECT_EQ(after.heading_factor, before.heading_factor);
}

TEST(CalibrationFile, ErrorsNameFileAndMember) {
  EXPECT_THAT(complaintOf("{"), HasSubstr("line 1"));
  EXPECT_THAT(complaintOf("[]"), HasSubstr("no object"));
  const auto changed = [](const std::string& member, const nlohmann::ordered_json& value) {
    nlohmann::ordered_json json = calibrationJson(someCalibration());
    json[member] = value;
    return complaintOf(json.dump());
  };
  EXPECT_THAT(changed("weight_decay", "much"),
              AllOf(HasSubstr("weight_decay"), HasSubstr("number")));
  EXPECT_THAT(changed("weight_decay", -1.0), HasSubstr("weight_decay"));
  EXPECT_THAT(changed("least_match_probability", 1.5), HasSubstr("least_match_probability"));
  EXPECT_THAT(changed("match_weights", 3), HasSubstr("match_weights"));
  EXPECT_THAT(changed("match_weights", {{"lead", 1}}), HasSubstr("explained"));
  EXPECT_THAT(changed("lost_thresholds", {0.1, 0.2}), HasSubstr("lost_thresholds"));
  EXPECT_THAT(changed("lost_thresholds", {0, 0, 0, 0, 0, 0, 0, "x"}), HasSubstr("8 numbers"));
  EXPECT_THAT(changed("lost_thresholds", {0, 0, 0.5, 0.25, 1, 1, 1, 1}),
              HasSubstr("lost_thresholds"));
  nlohmann::ordered_json json = calibrationJson(someCalibration());
  json.erase("lost_thresholds");
  EXPECT_THAT(complaintOf(json.dump()), AllOf(HasSubstr("lost_thresholds"), HasSubstr("missing")));
  json = calibrationJson(someCalibration());
  json.erase("heading_factor");
  EXPECT_THAT(complaintOf(json.dump()), AllOf(HasSubstr("heading_factor"), HasSubstr("missing")));
  EXPECT_THROW(loadCalibration("no_such_file.json"), FormatError);
}

TEST(CalibrationHeader, HoldsTheConstants) {
  const std::string text = calibrationHeader(someCalibration(), {"from these sets"});
  EXPECT_THAT(text, HasSubstr("/// from these sets\n"));
  EXPECT_THAT(text, HasSubstr("constexpr double kMatchIntercept = -3.25;\n"));
  EXPECT_THAT(text, HasSubstr("constexpr double kWeightDecay = 3.0;\n"));
  EXPECT_THAT(
      text,
      HasSubstr("constexpr std::array<double, 5> kMatchWeights = {1.5, 2.0, -0.5, 0.125, 0.25};"));
  EXPECT_THAT(text,
              HasSubstr("kLostThresholds = {0.0, 0.0, 0.125, 0.25, 0.25, 0.5, 0.625, 0.75};"));
}

TEST(CalibrationHeader, TheBuiltInOneIsWhatItWouldWrite) {
  // Written by hand it would drift: all but the comment on its origin must come out again.
  std::ifstream file(std::string(POLYLOC_SOURCE_DIR) +
                     "/mrpt_polyloc/localization/ranking/default_calibration.h");
  ASSERT_TRUE(file);
  std::string built_in;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("/// ", 0) != 0) built_in += line + "\n";
  }
  std::istringstream text(calibrationHeader(Calibration{}, {}));
  std::string written;
  for (std::string line; std::getline(text, line);) {
    if (line.rfind("/// ", 0) != 0) written += line + "\n";
  }
  EXPECT_EQ(built_in, written);
}

TEST(OutcomeJson, HoldsSharesAndTheCurvesFigures) {
  CalibrationOutcome outcome;
  outcome.roc = rocCurve({0.9, 0.8, 0.7, 0.2}, {0.1, 0.3});
  outcome.good = 4;
  outcome.good_lost = 1;
  outcome.foreign = 2;
  outcome.foreign_refused = 2;
  outcome.reliability = reliability({{0.9, true}}, {0.0, 0.5, 1.0});
  const auto json = outcomeJson(outcome);
  EXPECT_EQ(json["good_lost"], 0.25);
  EXPECT_EQ(json["foreign_refused"], 1.0);
  EXPECT_EQ(json["roc_area"], 7.0 / 8.0);
  EXPECT_EQ(json["foreign_refused_at_0.03"], 0.5);
  EXPECT_EQ(json["reliability"].size(), 2U);
  EXPECT_EQ(json["unique_right"], 0.0);
}

}  // namespace
}  // namespace mrpt_polyloc::test
