#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/reliability.h>

#include <gtest/gtest.h>

namespace mrpt_polyloc::test {
namespace {

TEST(Reliability, BinsAreWhatCountingGives) {
  Random random(5);
  std::vector<Forecast> forecasts;
  for (int i = 0; i < 500; ++i) forecasts.push_back({random.unit(), random.unit() < 0.4});
  const std::vector<double> edges{0.0, 0.25, 0.5, 0.9, 1.0};
  const auto bins = reliability(forecasts, edges);
  ASSERT_EQ(bins.size(), 4U);
  for (std::size_t b = 0; b < bins.size(); ++b) {
    double count = 0, stated = 0, right = 0;
    for (const Forecast& f : forecasts) {
      if (f.probability < edges[b] || f.probability >= edges[b + 1]) continue;
      count += 1;
      stated += f.probability;
      right += f.came_true;
    }
    EXPECT_EQ(static_cast<double>(bins[b].count), count);
    EXPECT_NEAR(bins[b].stated, stated / count, 1e-12);
    EXPECT_NEAR(bins[b].true_share, right / count, 1e-12);
  }
}

TEST(Reliability, EdgesBelongToTheUpperBinButTheLast) {
  const auto bins = reliability({{0.5, true}, {1.0, true}, {0.0, false}}, {0.0, 0.5, 1.0});
  EXPECT_EQ(bins[0].count, 1U);
  EXPECT_EQ(bins[1].count, 2U);
  EXPECT_EQ(bins[0].true_share, 0.0);
}

TEST(Reliability, ErrorByHand) {
  // 1 of 2 right where 0.8 was stated, 2 of 2 where 1 was: (2 * 0.3 + 2 * 0) / 4.
  const auto bins =
      reliability({{0.8, true}, {0.8, false}, {1.0, true}, {1.0, true}}, {0.0, 0.9, 1.0});
  EXPECT_NEAR(calibrationError(bins), 0.15, 1e-12);
  EXPECT_EQ(calibrationError(reliability({}, {0.0, 1.0})), 0.0);
}

TEST(Reliability, RefusesEdgesThatDoNotRise) {
  EXPECT_THROW(reliability({}, {0.0}), InvalidParamsError);
  EXPECT_THROW(reliability({}, {0.0, 0.0}), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc::test
