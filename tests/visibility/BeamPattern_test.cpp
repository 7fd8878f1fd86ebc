#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/visibility/BeamPattern.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace mrpt_polyloc {
namespace {

using ::testing::ElementsAre;

/// Against a linear search, at random angles, at the bearings and right beside them.
void expectFindsBeams(const BeamPattern& pattern, std::mt19937& random) {
  const float* bearings = pattern.bearings();
  const std::size_t n = pattern.size();
  std::uniform_real_distribution<float> uniform(-3.1415927F, 3.1415927F);
  std::vector<float> angles{-3.1415927F, 3.1415927F, 0.0F, -0.0F};
  for (int i = 0; i < 300; ++i) angles.push_back(uniform(random));
  for (std::size_t i = 0; i < n; ++i) {
    angles.push_back(bearings[i]);
    angles.push_back(std::nextafter(bearings[i], -4.0F));
    angles.push_back(std::nextafter(bearings[i], 4.0F));
  }
  std::vector<std::int32_t> found(angles.size());
  pattern.firstFrom(angles.data(), angles.size(), found.data());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    std::int32_t expected = 0;
    while (expected < static_cast<std::int32_t>(n) && bearings[expected] < angles[i]) ++expected;
    ASSERT_EQ(found[i], expected) << "angle " << angles[i] << " of " << n << " beams";
  }
}

TEST(BeamPattern, SortsAndWraps) {
  const BeamPattern pattern({2.0, -1.0, 2 * kPi + 0.5, kPi, -7 * kPi / 2});
  ASSERT_EQ(pattern.size(), 5U);
  EXPECT_THAT(pattern.order(), ElementsAre(3, 1, 2, 4, 0));
  EXPECT_FALSE(pattern.isInOrder());
  const double expected[] = {-kPi, -1.0, 0.5, kPi / 2, 2.0};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(pattern.bearings()[i], expected[i], 1e-6);
    EXPECT_NEAR(pattern.cosines()[i], std::cos(expected[i]), 1e-7);
    EXPECT_NEAR(pattern.sines()[i], std::sin(expected[i]), 1e-7);
  }
}

TEST(BeamPattern, KnowsWhenItIsInOrder) {
  EXPECT_TRUE(BeamPattern({-1.0, 0.0, 1.0}).isInOrder());
  EXPECT_TRUE(BeamPattern({-1.0, 0.0, 0.0, 1.0}).isInOrder());
  EXPECT_TRUE(BeamPattern(std::vector<double>{}).isInOrder());
  EXPECT_FALSE(BeamPattern({1.0, 0.0}).isInOrder());
}

TEST(BeamPattern, FindsTheFirstBeamFromAnAngle) {
  std::mt19937 random(51);
  std::uniform_real_distribution<double> uniform(-20, 20), narrow(0.1, 0.1001);
  expectFindsBeams(BeamPattern(std::vector<double>{}), random);
  expectFindsBeams(BeamPattern({kPi}), random);
  expectFindsBeams(BeamPattern({-kPi, std::nextafter(kPi, 0.0), kPi, 0.0}), random);
  expectFindsBeams(BeamPattern(std::vector<double>(100, 0.25)), random);  // all the same
  for (const int n : {2, 7, 64, 360, 361, 1000}) {
    std::vector<double> regular, irregular, crowded;
    for (int i = 0; i < n; ++i) {
      regular.push_back(-kPi + 2 * kPi * i / n);
      irregular.push_back(uniform(random));
      crowded.push_back(narrow(random));  // many in one slot
    }
    for (const auto* bearings : {&regular, &irregular, &crowded}) {
      expectFindsBeams(BeamPattern(*bearings), random);
    }
  }
}

TEST(BeamPattern, RefusesWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(BeamPattern({0.0, nan}), InvalidParamsError);
  EXPECT_THROW(BeamPattern({std::numeric_limits<double>::infinity()}), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
