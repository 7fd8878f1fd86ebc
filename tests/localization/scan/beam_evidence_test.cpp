#include "tests/support/constants.h"
#include <mrpt_polyloc/localization/scan/beam_evidence.h>

#include <gtest/gtest.h>

namespace mrpt_polyloc::test {
namespace {

float evidenceOf(double range, float wall, float open = kInfinityF, BeamKind kind = BeamKind::hit) {
  return beamEvidence({{0.0, range, kind}}, {{wall}, {open}}).front();
}

TEST(BeamEvidence, ByHand) {
  EXPECT_NEAR(evidenceOf(3.0, 3.0F), 0.0, 1e-6);
  EXPECT_NEAR(evidenceOf(2.7, 3.0F), 0.3, 1e-6);
  EXPECT_NEAR(evidenceOf(3.4, 3.0F), 0.4, 1e-6);
  EXPECT_NEAR(evidenceOf(9.0, 3.0F), 0.6, 1e-6);                // passes a wall: capped
  EXPECT_NEAR(evidenceOf(2.5, 3.0F), 0.5, 1e-6);                // up to here as the cost
  EXPECT_NEAR(evidenceOf(1.5, 4.0F), 0.5 + 0.05 * 2.0, 1e-6);   // two metres more are hidden
  EXPECT_NEAR(evidenceOf(1.0, 30.0F), 0.5 + 0.05 * 5.0, 1e-6);  // five at most
  EXPECT_NEAR(evidenceOf(1.0, kInfinityF), 0.5 + 0.05 * 5.0, 1e-6);
}

TEST(BeamEvidence, WhatLiesPastAnOpenEdgeIsNotHidden) {
  EXPECT_NEAR(evidenceOf(1.0, 9.0F, 3.0F), 0.5 + 0.05 * 1.5, 1e-6);
  EXPECT_NEAR(evidenceOf(4.0, 9.0F, 3.0F), 0.25, 1e-6);
}

TEST(BeamEvidence, WhatTheMapIsOffBySaysNothing) {
  BeamEvidenceParams params;
  params.tolerance = 0.1;
  const auto evidence = [&](double range, float wall, float open, BeamKind kind = BeamKind::hit) {
    return beamEvidence({{0.0, range, kind}}, {{wall}, {open}}, params).front();
  };
  EXPECT_EQ(evidence(2.95, 3.0F, kInfinityF), 0.0F);
  EXPECT_EQ(evidence(3.09, 3.0F, kInfinityF), 0.0F);
  EXPECT_NEAR(evidence(2.7, 3.0F, kInfinityF), 0.2, 1e-6);
  EXPECT_NEAR(evidence(3.4, 3.0F, kInfinityF), 0.3, 1e-6);
  EXPECT_NEAR(evidence(9.0, 3.0F, kInfinityF), 0.6, 1e-6);  // capped as without
  EXPECT_NEAR(evidence(2.5, 3.0F, kInfinityF), 0.4, 1e-6);
  EXPECT_NEAR(evidence(1.5, 4.0F, kInfinityF), 0.5 + 0.05 * 2.0, 1e-6);
  EXPECT_NEAR(evidence(4.0, 9.0F, 3.0F), 0.25, 1e-6);
  EXPECT_NEAR(evidence(8.8, 9.0F, 3.0F), 0.1, 1e-6);
  EXPECT_NEAR(evidence(20.0, 3.0F, kInfinityF, BeamKind::no_return), 0.15, 1e-6);
}

TEST(BeamEvidence, OfNoReturns) {
  EXPECT_NEAR(evidenceOf(20.0, 3.0F, kInfinityF, BeamKind::no_return), 0.15, 1e-6);
  EXPECT_NEAR(evidenceOf(20.0, kInfinityF, kInfinityF, BeamKind::no_return), 0.0, 1e-6);
  EXPECT_TRUE(beamEvidence({}, {}).empty());
}

}  // namespace
}  // namespace mrpt_polyloc::test
