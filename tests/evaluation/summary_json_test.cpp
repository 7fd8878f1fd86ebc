#include <mrpt_polyloc/evaluation/summary_json.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace mrpt_polyloc {
namespace {

using nlohmann::ordered_json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A 4 x 3 room with a square pillar, one open side, and a wall beyond it.
PolygonMap roomWithPillar() {
  FreePolygon room;
  room.outer = wallRing({{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  room.outer.kinds[1] = EdgeKind::open;
  room.holes.push_back(wallRing({{1, 1}, {1, 2}, {2, 2}, {2, 1}}));
  return PolygonMap({room}, {{{5, 0}, {5, 2}}});
}

std::vector<std::string> keysOf(const ordered_json& json) {
  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  return keys;
}

TEST(MapStatisticsTest, HoldsTheFiguresOfTheMap) {
  const ordered_json json = mapStatistics(roomWithPillar());
  EXPECT_THAT(keysOf(json),
              ElementsAre("vertices", "reflex_vertices", "holes", "components", "area_m2",
                          "perimeter_m", "open_perimeter_m", "walls_beyond_m"));
  EXPECT_EQ(json["vertices"], 8);
  EXPECT_EQ(json["reflex_vertices"], 4);
  EXPECT_EQ(json["holes"], 1);
  EXPECT_EQ(json["components"], 1);
  EXPECT_DOUBLE_EQ(json["area_m2"], 11.0);
  EXPECT_DOUBLE_EQ(json["perimeter_m"], 18.0);
  EXPECT_DOUBLE_EQ(json["open_perimeter_m"], 3.0);
  EXPECT_DOUBLE_EQ(json["walls_beyond_m"], 2.0);
}

TEST(SummaryJsonTest, HasTheKeysInOrder) {
  Summary all;
  all.scans = 4;
  all.top1 = 0.75;
  all.top20 = 1.0;
  all.in_ellipse = 0.5;
  all.unique_right = 1.0;
  all.median_error_m = 0.03;
  all.median_error_deg = 0.4;
  all.ms_p90 = 12.5;
  all.status = {1, 2, 0, 1};
  Summary good = all;
  good.scans = 3;
  const std::string text = summaryJson(all, &good, {1.5, 40.25, 1.75}, roomWithPillar());
  EXPECT_EQ(text.back(), '\n');
  const ordered_json json = ordered_json::parse(text);
  EXPECT_THAT(keysOf(json),
              ElementsAre("scans", "top1", "top5", "top20", "in_list", "in_ellipse", "unique_right",
                          "median_error_m", "median_error_deg", "ms_median", "ms_p90", "ms_max",
                          "status", "index_build_s", "index_mb", "cold_start_s", "map", "good"));
  EXPECT_THAT(keysOf(json["status"]),
              ElementsAre("unique", "ambiguous", "no_match", "too_few_beams"));
  EXPECT_THAT(
      keysOf(json["good"]),
      ElementsAre("scans", "top1", "top5", "top20", "in_list", "in_ellipse", "unique_right",
                  "median_error_m", "median_error_deg", "ms_median", "ms_p90", "ms_max", "status"));
  EXPECT_EQ(json["scans"], 4);
  EXPECT_EQ(json["good"]["scans"], 3);
  EXPECT_EQ(json["top1"], 0.75);
  EXPECT_EQ(json["in_ellipse"], 0.5);
  EXPECT_EQ(json["ms_p90"], 12.5);
  EXPECT_EQ(json["status"]["ambiguous"], 2);
  EXPECT_EQ(json["index_mb"], 40.25);
  EXPECT_EQ(json["map"], mapStatistics(roomWithPillar()));
}

TEST(SummaryJsonTest, WhatDoesNotExistIsNull) {
  Summary some;
  some.scans = 1;
  const auto json = ordered_json::parse(summaryJson(some, nullptr, {}, roomWithPillar()));
  EXPECT_FALSE(json.contains("good"));
  EXPECT_TRUE(json["unique_right"].is_null());
  EXPECT_TRUE(json["median_error_m"].is_null());
  EXPECT_TRUE(json["median_error_deg"].is_null());
  EXPECT_EQ(json["top1"], 0.0);

  const Summary none;
  const auto empty = ordered_json::parse(summaryJson(none, &none, {}, roomWithPillar()));
  EXPECT_EQ(empty["scans"], 0);
  for (const char* key :
       {"top1", "top5", "top20", "in_list", "in_ellipse", "ms_median", "ms_p90", "ms_max"}) {
    EXPECT_TRUE(empty[key].is_null()) << key;
    EXPECT_TRUE(empty["good"][key].is_null()) << key;
  }
}

TEST(ScansCsvTest, OneLinePerScan) {
  ScanRecord found;
  found.row = 7;
  found.stamp = 1000000000.25;
  found.truth = {1, 2, -M_PI};
  found.score = {LocalizationStatus::unique, 1, 0.5, M_PI / 180, 12.3456};
  found.hypotheses = 3;
  found.answer.emplace();
  found.answer->pose_map_robot = {1.5, 2, 3 * M_PI / 2};
  found.answer->cost = 0.0625;
  ScanRecord lost;
  lost.row = 8;
  lost.stamp = 1;
  lost.score = {LocalizationStatus::no_match, 0, std::nan(""), std::nan(""), 4.0};
  EXPECT_EQ(scansCsv({found, lost}),
            "row,stamp,status,right_rank,hypotheses,error_m,error_deg,cost,x,y,phi_deg,truth_x,"
            "truth_y,truth_phi_deg,ms\n"
            "7,1000000000.250000,unique,1,3,0.5000,1.0000,0.062500,1.500000,2.000000,-90.000000,"
            "1.000000,2.000000,180.000000,12.346\n"
            "8,1.000000,no_match,0,0,,,,,,,0.000000,0.000000,0.000000,4.000\n");
  EXPECT_THAT(scansCsv({}), HasSubstr("row,stamp"));
}

}  // namespace
}  // namespace mrpt_polyloc
