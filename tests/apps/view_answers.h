#pragma once

#include <mrpt_polyloc/base/angles.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <httplib.h>

namespace mrpt_polyloc::test {

/// An answer: its status and its JSON, null if it is none.
struct Answer {
  int status = -1;
  nlohmann::json body;
};

inline Answer answerOf(const httplib::Result& result) {
  if (!result) return {};
  return {result->status, nlohmann::json::parse(result->body, nullptr, false)};
}

inline void expectPose(const nlohmann::json& hypothesis, double x, double y, double phi) {
  EXPECT_NEAR(hypothesis["x"].get<double>(), x, 0.1);
  EXPECT_NEAR(hypothesis["y"].get<double>(), y, 0.1);
  EXPECT_LT(std::abs(std::remainder(hypothesis["phi"].get<double>() - phi, 2 * kPi)), 0.05);
}

}  // namespace mrpt_polyloc::test
