#include <mrpt_polyloc/localization/ranking/MomentWeights.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace mrpt_polyloc {
namespace {

ScanSet drive(const std::vector<double>& steps) {
  std::vector<Moment> moments;
  for (const double step : steps) {
    moments.push_back(
        {{RangeScan({{0.1, 2.0, BeamKind::hit}})}, measuredMotion({step, 0, 0}), false});
  }
  return ScanSet(std::move(moments));
}

TEST(MomentWeights, OneMomentIsOne) {
  const MomentWeights one(drive({5.0}), {});
  EXPECT_EQ(one.independent, 1.0);
  EXPECT_EQ(one.weights, std::vector<double>{1.0});
}

TEST(MomentWeights, StandingStillSaysNothingNewAndFarApartAllOfIt) {
  EXPECT_NEAR(MomentWeights(drive({0, 0, 0, 0, 0}), {}).independent, 1.0, 1e-4);
  EXPECT_NEAR(MomentWeights(drive({0, 50, 50, 50}), {}).independent, 4.0, 1e-4);
  // Many looks from one place and one from elsewhere are two.
  const MomentWeights two(drive({0, 0, 0, 0, 50}), {});
  EXPECT_NEAR(two.independent, 2.0, 1e-3);
  EXPECT_NEAR(two.weights.back(), 0.5, 1e-3);
}

TEST(MomentWeights, OfAChainAreThoseOfAMarkovProcess) {
  // Correlation r from one to the next: the information of n values of an autoregressive process is
  // (n - (n - 2) r) / (1 + r).
  const ScanCorrelation correlation{0.5, 1.0};
  for (const double step : {0.1, 0.4, 1.0}) {
    const double r = std::exp(-step / 0.5);
    for (const std::size_t n : {2U, 3U, 7U}) {
      const MomentWeights weights(drive(std::vector<double>(n, step)), correlation);
      EXPECT_NEAR(weights.independent,
                  (static_cast<double>(n) - (static_cast<double>(n) - 2.0) * r) / (1.0 + r), 1e-4);
      EXPECT_NEAR(std::accumulate(weights.weights.begin(), weights.weights.end(), 0.0), 1.0, 1e-12);
    }
    // What one more adds to a long chain.
    const MomentWeights nine(drive(std::vector<double>(9, step)), correlation);
    const MomentWeights eight(drive(std::vector<double>(8, step)), correlation);
    EXPECT_NEAR(correlation.gain(measuredMotion({step, 0, 0})),
                nine.independent - eight.independent, 1e-4);
  }
}

}  // namespace
}  // namespace mrpt_polyloc
