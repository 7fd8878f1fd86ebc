#include "PolylocLocalizeTest.h"
#include <mrpt_polyloc/evaluation/truth.h>

#include <cmath>
#include <filesystem>

namespace mrpt_polyloc::test {
namespace {

/// What apps/demo.sh shows, in MRPT's map, of which two thirds of the borders are open: its last
/// line is the pose of the last scan.
TEST_F(PolylocLocalize, FindsMrptsDemoUpToItsLastScan) {
  const std::string demo = "/usr/share/mrpt/datasets/localization_demo";
  if (!std::filesystem::exists(demo + ".rawlog")) GTEST_SKIP() << "mrpt-common is not installed";
  const Outcome outcome =
      run("polyloc-localize", {"--map", demo + ".simplemap.gz", "--scans", demo + ".rawlog"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto answers = firstAnswers(outcome.out);
  const auto truth = loadTum(POLYLOC_SOURCE_DIR "/datasets/localization_demo_truth.tum");
  ASSERT_EQ(truth.size(), 37U);
  int right = 0;
  bool is_last_right = false;
  for (const auto& [row, fields] : answers) {
    const mrpt::math::TPose2D& pose = truth[static_cast<std::size_t>(row)].pose_map_robot;
    is_last_right = std::hypot(std::stod(fields[4]) - pose.x, std::stod(fields[5]) - pose.y) < 0.3;
    if (is_last_right) ++right;
  }
  EXPECT_GE(right, 36);
  EXPECT_EQ(answers.rbegin()->first, 36);
  EXPECT_TRUE(is_last_right);
}

}  // namespace
}  // namespace mrpt_polyloc::test
