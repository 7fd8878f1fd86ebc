#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/truth.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <tests/support/data_dir.h>

namespace mrpt_polyloc {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A text file that goes away with the test.
class TruthTest : public ::testing::Test {
 protected:
  std::string write(const std::string& content) {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = ::testing::TempDir() + "polyloc_truth_" + info->name() + ".txt";
    std::ofstream(path_, std::ios::binary) << content;
    return path_;
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::string path_;
};

template <class Call>
std::string formatErrorOf(Call call) {
  try {
    call();
  } catch (const FormatError& error) {
    return error.what();
  }
  return "no FormatError";
}

RangeScan scanAt(double stamp) {
  return RangeScan({}, {0, 0}, stamp);
}

TEST_F(TruthTest, ReadsACompressedFile) {
  // printf '5 1 2 0 0 0 0 1\n# end\n' | gzip
  const std::string gzipped(
      "\037\213\010\000\000\000\000\000\002\003\063\125\060\124\060\122\060\200\102\103\056\145\205"
      "\324\274\024\056\000\264\217\222\257\026\000\000\000",
      36);
  const auto poses = loadTum(write(gzipped));
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].stamp, 5.0);
  EXPECT_EQ(poses[0].pose_map_robot.y, 2.0);
  EXPECT_THAT(formatErrorOf([&] { loadTum(write(gzipped.substr(0, 30))); }),
              HasSubstr("truncated"));
}

TEST_F(TruthTest, ReadsPosesCommentsAndForeignLineEnds) {
  const auto poses =
      loadTum(write("# stamp x y z qx qy qz qw\r\n"
                    "1000000000.5 1.25 -2e1 0 0 0 0.70710678 0.70710678\r\n"
                    "\n"
                    "  1000000001 +3\t4 9 0 0 1 0  # turned by pi"));
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].stamp, 1000000000.5);
  EXPECT_EQ(poses[0].pose_map_robot.x, 1.25);
  EXPECT_EQ(poses[0].pose_map_robot.y, -20.0);
  EXPECT_NEAR(poses[0].pose_map_robot.phi, M_PI / 2, 1e-12);
  EXPECT_EQ(poses[1].pose_map_robot.x, 3.0);
  EXPECT_NEAR(std::abs(poses[1].pose_map_robot.phi), M_PI, 1e-12);
}

TEST_F(TruthTest, TakesTheYawOfATiltedQuaternion) {
  // Yaw 0.7 about z after a roll of 0.2 about x: q = q_z(0.7) * q_x(0.2).
  const double sz = std::sin(0.35), cz = std::cos(0.35), sx = std::sin(0.1), cx = std::cos(0.1);
  std::ostringstream line;
  line.precision(17);
  line << "0 0 0 0 " << cz * sx << " " << sz * sx << " " << sz * cx << " " << cz * cx;
  EXPECT_NEAR(loadTum(write(line.str()))[0].pose_map_robot.phi, 0.7, 1e-12);
}

TEST_F(TruthTest, NamesFileAndLineOfWhatIsWrong) {
  const std::string good = "1 0 0 0 0 0 0 1\n";
  const auto errorOf = [&](const std::string& content) {
    const std::string path = write(content);
    return formatErrorOf([&] { loadTum(path); });
  };
  EXPECT_THAT(errorOf(good + "2 0 0 0 0 0 1\n"),
              AllOf(HasSubstr(path_), HasSubstr("line 2"), HasSubstr("got 7")));
  EXPECT_THAT(errorOf("#\n" + good + "2 0 0 0 0 0 0 1 7\n"),
              AllOf(HasSubstr("line 3"), HasSubstr("got 9")));
  EXPECT_THAT(errorOf("1 0 x 0 0 0 0 1\n"), AllOf(HasSubstr("line 1"), HasSubstr("'x'")));
  EXPECT_THAT(errorOf("1 0 1.5m 0 0 0 0 1\n"), HasSubstr("'1.5m'"));
  EXPECT_THAT(errorOf("1 0 +-5 0 0 0 0 1\n"), HasSubstr("'+-5'"));
  EXPECT_THAT(errorOf("1 nan 0 0 0 0 0 1\n"), HasSubstr("'nan'"));
  EXPECT_THAT(errorOf("1 0 0 0 0 0 inf 1\n"), HasSubstr("'inf'"));
  EXPECT_THAT(errorOf("1 0 0 0 0 0 0 0.9\n"),
              AllOf(HasSubstr("line 1"), HasSubstr("length 0.900000")));
  EXPECT_THAT(errorOf("# nothing\n\n"), HasSubstr("holds no pose"));
  EXPECT_THAT(errorOf(""), HasSubstr("empty file"));
  EXPECT_THAT(formatErrorOf([] { loadTum("/no/such/file.tum"); }),
              HasSubstr("/no/such/file.tum: no such file"));
  EXPECT_THAT(formatErrorOf([] { loadTum(::testing::TempDir()); }), HasSubstr("is a directory"));
}

TEST_F(TruthTest, WritesWhatItReads) {
  const std::vector<StampedPose> poses{{1234567890.25, {1.0000004, -2.5, 3.0}},
                                       {1234567891.0, {-1e5, 0.125, -3.1}}};
  const std::string text = toTum(poses);
  EXPECT_THAT(text, HasSubstr("1234567890.250000000 1.000000 -2.500000 0 0 0 "));
  const auto back = loadTum(write(text));
  ASSERT_EQ(back.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back[i].stamp, poses[i].stamp);
    EXPECT_NEAR(back[i].pose_map_robot.x, poses[i].pose_map_robot.x, 1e-6);
    EXPECT_NEAR(back[i].pose_map_robot.phi, poses[i].pose_map_robot.phi, 1e-8);
  }
  EXPECT_EQ(toTum({}), "");
}

TEST(MatchTruthTest, MatchesByStampInAnyOrder) {
  const std::vector<StampedPose> truth{
      {1e9 + 2, {2, 0, 0}}, {1e9, {0, 0, 0}}, {1e9 + 1, {1, 0, 0}}};
  const auto poses =
      matchTruth({scanAt(1e9), scanAt(1e9 + 1.001), scanAt(1e9 + 1.999)}, truth, "t.tum");
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[0].x, 0.0);
  EXPECT_EQ(poses[1].x, 1.0);
  EXPECT_EQ(poses[2].x, 2.0);
}

TEST(MatchTruthTest, LetsLasersThatFireTogetherShareTheirPose) {
  EXPECT_EQ(matchTruth({scanAt(5), scanAt(5)}, {{5, {1, 2, 3}}}, "t.tum").size(), 2U);
}

TEST(MatchTruthTest, RefusesWhatDoesNotMatchOnce) {
  const std::vector<StampedPose> truth{{1, {0, 0, 0}}, {2, {0, 0, 0}}};
  EXPECT_THAT(formatErrorOf([&] {
                matchTruth({scanAt(1), scanAt(2.002)}, truth, "t.tum");
              }),
              AllOf(HasSubstr("t.tum: scan 1 (stamp 2.002000)"), HasSubstr("no pose")));
  EXPECT_THAT(formatErrorOf([&] { matchTruth({scanAt(1)}, truth, "t.tum"); }),
              AllOf(HasSubstr("pose 1 (stamp 2.000000)"), HasSubstr("no scan")));
  EXPECT_THAT(formatErrorOf([&] {
                matchTruth({scanAt(1)}, {{1, {0, 0, 0}}, {1.0005, {0, 0, 0}}}, "t.tum");
              }),
              AllOf(HasSubstr("scan 0"), HasSubstr("several poses")));
  EXPECT_TRUE(matchTruth({}, {}, "t.tum").empty());
}

TEST_F(TruthTest, ReadsIndexedPoses) {
  const auto poses = loadIndexedTruth(write("# index x y phi\n2 1.5 -2 0.25\n0\t3 4 -1 # c\n"), 4);
  ASSERT_EQ(poses.size(), 4U);
  EXPECT_EQ(poses[2], mrpt::math::TPose2D(1.5, -2, 0.25));
  EXPECT_EQ(poses[0], mrpt::math::TPose2D(3, 4, -1));
  EXPECT_FALSE(poses[1] || poses[3]);
  EXPECT_TRUE(isIndexedTruth(path_));
  EXPECT_FALSE(isIndexedTruth(write("# none\n1 0 0 0 0 0 0 1\n")));
  EXPECT_THROW(isIndexedTruth(write("")), FormatError);
}

TEST_F(TruthTest, RefusesWrongIndexedPoses) {
  const auto error = [&](const std::string& content) {
    return formatErrorOf([&] { loadIndexedTruth(write(content), 2); });
  };
  EXPECT_THAT(error("0 1 2 3\n2 1 2 3\n"),
              AllOf(HasSubstr(path_), HasSubstr("line 2"), HasSubstr("only 2")));
  EXPECT_THAT(error("0 1 2 3\n0 1 2 3\n"), AllOf(HasSubstr("line 2"), HasSubstr("second time")));
  EXPECT_THAT(error("0.5 1 2 3\n"), HasSubstr("no whole number"));
  EXPECT_THAT(error("-1 1 2 3\n"), HasSubstr("no whole number"));
  EXPECT_THAT(error("0 1 2\n"), HasSubstr("expected 4 fields"));
  EXPECT_THAT(error("0 1 nan 3\n"), HasSubstr("'nan' is not a finite number"));
  EXPECT_THAT(error("# nothing\n"), HasSubstr("holds no pose"));
  EXPECT_THAT(formatErrorOf([] { loadIndexedTruth("/none/at/all", 2); }),
              HasSubstr("no such file"));
}

TEST_F(TruthTest, ReadsRowNumbers) {
  EXPECT_THAT(loadRows(write("# good rows\n3\n 0 # the first\n\n7\r\n"), 8), ElementsAre(3, 0, 7));
  EXPECT_TRUE(loadRows(write("# none\n"), 8).empty());
}

TEST_F(TruthTest, RefusesWrongRows) {
  const auto errorOf = [&](const std::string& content) {
    const std::string path = write(content);
    return formatErrorOf([&] { loadRows(path, 8); });
  };
  EXPECT_THAT(errorOf("1\n8\n"), AllOf(HasSubstr("line 2"), HasSubstr("row 8 of 8 scans")));
  EXPECT_THAT(errorOf("-1\n"), HasSubstr("'-1' is not a row number"));
  EXPECT_THAT(errorOf("1.5\n"), HasSubstr("'1.5'"));
  EXPECT_THAT(errorOf("99999999999999999999999\n"), HasSubstr("is not a row number"));
  EXPECT_THAT(errorOf("1 2\n"), HasSubstr("one row number"));
  EXPECT_THAT(errorOf("1\n2\n1\n"), AllOf(HasSubstr("line 3"), HasSubstr("row 1 a second time")));
}

TEST(TruthDataTest, ReadsEveryShippedTruth) {
  POLYLOC_DATA_OR_SKIP(data);
  std::size_t sets = 0;
  for (const auto& set : std::filesystem::directory_iterator(data + "/scans")) {
    const auto truth_path = set.path() / "truth.tum";
    if (!std::filesystem::exists(truth_path)) continue;
    ++sets;
    const auto truth = loadTum(truth_path.string());
    const auto rows = loadRows((set.path() / "good.txt").string(), truth.size());
    EXPECT_FALSE(rows.empty()) << set.path();
    std::vector<RangeScan> scans;
    for (const StampedPose& pose : truth) scans.push_back(scanAt(pose.stamp));
    EXPECT_EQ(matchTruth(scans, truth, truth_path.string()).size(), truth.size());
  }
  EXPECT_GT(sets, 0U);
}

}  // namespace
}  // namespace mrpt_polyloc
