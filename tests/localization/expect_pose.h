#pragma once

#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/localization/LocalizationResult.h>

#include <gtest/gtest.h>

#include <algorithm>

/// Whether an answer is right.
namespace mrpt_polyloc::test {

inline bool holdsPose(const LocalizationResult& result, const mrpt::math::TPose2D& pose,
                      double distance = 0.05) {
  return std::any_of(result.hypotheses.begin(), result.hypotheses.end(), [&](const Hypothesis& h) {
    return distanceBetween(h.pose_map_robot, pose) < distance &&
           turnBetween(h.pose_map_robot, pose) < 0.02;
  });
}

inline void expectFirstIs(const LocalizationResult& result, const mrpt::math::TPose2D& truth,
                          double distance = 0.02) {
  ASSERT_FALSE(result.hypotheses.empty()) << toString(result.status);
  const mrpt::math::TPose2D& first = result.hypotheses.front().pose_map_robot;
  EXPECT_LT(distanceBetween(first, truth), distance) << first.asString();
  EXPECT_LT(turnBetween(first, truth), 0.01) << first.asString();
}

}  // namespace mrpt_polyloc::test
