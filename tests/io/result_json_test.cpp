#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/io/result_json.h>
#include <mrpt_polyloc/io/scan_json.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace mrpt_polyloc::test {
namespace {

TEST(ResultJson, HoldsWhatTheResultHolds) {
  const GlobalLocalizer localizer(asymmetricRoom());
  SearchOptions options;
  options.keep_regions = true;
  const auto result =
      localizer.localize(simulatedScan(localizer.map(), {4.2, 1.0, 0.4}), {}, options);
  const auto json = nlohmann::json::parse(toJson(result, 3).dump());
  EXPECT_EQ(json["status"], toString(result.status));
  EXPECT_EQ(json["match"], result.match_probability);
  EXPECT_EQ(json["listed"], result.listed);
  ASSERT_EQ(json["hypotheses"].size(), result.hypotheses.size());
  ASSERT_FALSE(result.hypotheses.empty());
  const Hypothesis& h = result.hypotheses.front();
  const auto& first = json["hypotheses"][0];
  EXPECT_EQ(first["x"], h.pose_map_robot.x);
  EXPECT_EQ(first["phi"], h.pose_map_robot.phi);
  EXPECT_EQ(first["weight"], h.weight);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) EXPECT_EQ(first["covariance"][i][j], h.covariance(i, j));
  }
  ASSERT_TRUE(result.certificate);
  EXPECT_EQ(json["certificate"]["cost"], result.certificate->cost);
  EXPECT_EQ(json["certificate"]["regions"], result.certificate->regions);
  const auto& settled = json["certificate"];
  EXPECT_EQ(settled["bounded"].get<std::size_t>() + settled["distant"].get<std::size_t>() +
                settled["lowered"].get<std::size_t>() + settled["drained"].get<std::size_t>() +
                settled["undecided"].get<std::size_t>(),
            result.certificate->regions);
  EXPECT_GT(settled["lowered"].get<std::size_t>(), 0U);
  // The few regions of least bound, in its order.
  ASSERT_EQ(json["regions"].size(), std::min<std::size_t>(3, result.regions.size()));
  for (const PoseRegion& region : result.regions) {
    EXPECT_GE(region.bound, json["regions"][0]["bound"].get<double>());
  }
}

TEST(ResultJson, OfNothingFound) {
  const auto json = toJson(LocalizationResult{});
  EXPECT_EQ(json["status"], "too_few_beams");
  EXPECT_TRUE(json["certificate"].is_null());
  EXPECT_TRUE(json["hypotheses"].empty());
  EXPECT_FALSE(json.contains("regions"));
}

TEST(ResultJson, HashesAreSixteenDigits) {
  EXPECT_EQ(hashText(0), "0000000000000000");
  EXPECT_EQ(hashText(0xfedcba9876543210ULL), "fedcba9876543210");
}

TEST(ScanJson, TellsKindsAndHidesWhatIsNotKnown) {
  const RangeScan scan(
      {{0.1, 2.5, BeamKind::hit}, {0.2, 8.0, BeamKind::no_return}, {0.3, 0.0, BeamKind::invalid}},
      {0.2, -0.1}, 12.5, "LASER");
  const auto json = toJson(scan);
  EXPECT_EQ(json["kinds"], "hni");
  EXPECT_EQ(json["ranges"].dump(), "[2.5,8.0,null]");
  // A scan does not keep where beams look that say nothing.
  EXPECT_EQ(json["bearings"].dump(), "[0.1,0.2,0.0]");
  EXPECT_EQ(json["sensor"]["y"], -0.1);
  EXPECT_EQ(json["stamp"], 12.5);
  EXPECT_EQ(json["label"], "LASER");
}

}  // namespace
}  // namespace mrpt_polyloc::test
