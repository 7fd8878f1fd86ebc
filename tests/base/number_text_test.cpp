#include <mrpt_polyloc/base/number_text.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>

namespace mrpt_polyloc {
namespace {

TEST(NumberText, ANumberIsTheWholeOfAText) {
  EXPECT_EQ(parseNumber("-2.5e1"), -25.0);
  EXPECT_EQ(parseNumber("+.5"), 0.5);
  EXPECT_EQ(parseNumber("inf"), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(parseNumber("nan").value_or(0.0)));
  for (const char* bad : {"", "+", "+-1", " 1", "1 ", "1m", "1,5", "1e999", "--1", "0x10"}) {
    EXPECT_EQ(parseNumber(bad), std::nullopt) << "'" << bad << "'";
  }
}

TEST(NumberText, CountsAreDecimalDigits) {
  EXPECT_EQ(parseCount("010"), 10u);
  EXPECT_EQ(parseCount("18446744073709551615"), 18446744073709551615u);
  for (const char* bad : {"", "-1", "+1", "1.0", "0x10", "18446744073709551616"}) {
    EXPECT_EQ(parseCount(bad), std::nullopt) << "'" << bad << "'";
  }
}

TEST(NumberText, WhatIsAppendedReadsBackAsTheSameNumber) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 10'000; ++i) {
    const std::uint64_t bits = random();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    std::string text = "x";
    appendNumber(text, value);
    EXPECT_EQ(parseNumber(text.substr(1)), value) << text;
  }
  std::string text;
  for (const double value : {0.0, -0.5, 1e-6, 123456.75, 1e20}) appendNumber(text += " ", value);
  EXPECT_EQ(text, " 0 -0.5 0.000001 123456.75 1e+20");
}

TEST(NumberText, FormatsAsPrintf) {
  EXPECT_EQ(formatted("%s: %.3f m, %zu of %d", "a", 1.0625, std::size_t{3}, -4),
            "a: 1.062 m, 3 of -4");
  EXPECT_EQ(formatted("plain"), "plain");
  EXPECT_EQ(formatted("%.1f", 1e300).size(), 303U);  // longer than any buffer of a guess
  EXPECT_EQ(formatted("%s", ""), "");
}

}  // namespace
}  // namespace mrpt_polyloc
