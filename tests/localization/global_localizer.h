#pragma once

#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/localization/GlobalLocalizer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

/// What the tests of the localizer have in common.
namespace mrpt_polyloc::test {

/// What every answer keeps.
inline void expectConsistent(const LocalizationResult& result, std::size_t most = 20) {
  const bool answered =
      result.status == LocalizationStatus::unique || result.status == LocalizationStatus::ambiguous;
  EXPECT_EQ(answered, !result.hypotheses.empty());
  EXPECT_LE(result.hypotheses.size(), most);
  double sum = 0.0;
  for (std::size_t i = 0; i < result.hypotheses.size(); ++i) {
    const Hypothesis& h = result.hypotheses[i];
    EXPECT_TRUE(std::isfinite(h.pose_map_robot.x + h.pose_map_robot.y + h.pose_map_robot.phi));
    EXPECT_GE(h.weight, 0.0);
    sum += h.weight;
    if (i > 0) {
      EXPECT_LE(h.weight, result.hypotheses[i - 1].weight);
      EXPECT_GE(h.z_score, result.hypotheses[i - 1].z_score);
    }
  }
  EXPECT_NEAR(sum, result.listed, 1e-9);
  EXPECT_LE(result.listed, 1.0 + 1e-9);
  EXPECT_EQ(result.listed > 0.0, answered);
}

/// A localizer of the asymmetric room, built once for all tests of a program.
class InAsymmetricRoom : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { localizer_ = new GlobalLocalizer(asymmetricRoom()); }
  static void TearDownTestSuite() {
    delete localizer_;
    localizer_ = nullptr;
  }
  static const GlobalLocalizer& localizer() { return *localizer_; }

 private:
  static inline GlobalLocalizer* localizer_ = nullptr;
};

}  // namespace mrpt_polyloc::test
