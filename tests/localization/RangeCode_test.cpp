#include <mrpt_polyloc/localization/RangeCode.h>

#include <gtest/gtest.h>

#include <limits>

namespace mrpt_polyloc::test {
namespace {

TEST(RangeCode, NothingIsZeroAndInfinityTheGreatest) {
  EXPECT_EQ(RangeCode::encode(0.0F), 0);
  EXPECT_EQ(RangeCode::encode(-1.0F), 0);
  EXPECT_EQ(RangeCode::encode(std::numeric_limits<float>::infinity()), 255);
  EXPECT_EQ(RangeCode::encode(1e30F), 255);
  EXPECT_LT(RangeCode::encode(50.0F), 255);
  EXPECT_EQ(RangeCode::encode(54.0F), 255);
}

TEST(RangeCode, GrowsWithTheRangeInSmallSteps) {
  int before = 0;
  for (float range = 0.0F; range < 60.0F; range += 0.005F) {
    const int code = RangeCode::encode(range);
    EXPECT_GE(code, before) << range;
    EXPECT_LE(code, before + 1) << range;
    before = code;
  }
  EXPECT_EQ(before, 255);
}

TEST(RangeCode, OfAMetreAndOfTen) {
  EXPECT_EQ(RangeCode::encode(1.0F), 44);    // 64 ln 2 = 44.36
  EXPECT_EQ(RangeCode::encode(10.0F), 153);  // 64 ln 11 = 153.47
}

}  // namespace
}  // namespace mrpt_polyloc::test
