#include <mrpt_polyloc/localization/scan/BeamEvidence.h>
#include <mrpt_polyloc/localization/scan/beam_evidence.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

double meanOf(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// A room of 10 x 10 m with a pane in the map before its right wall.
class BeamEvidenceTest : public testing::Test {
 protected:
  PolygonMap map_{{{wallRing({{0, 0}, {10, 0}, {10, 10}, {0, 10}}),
                    {wallRing({{8, 3}, {8, 7}, {8.05, 7}, {8.05, 3}})}}}};
  RangePredictor predictor_{Triangulation(map_), RangePredictor::kSquareSize, 1};
  const TPose2D pose_{5, 5, 0};
};

TEST_F(BeamEvidenceTest, OfAPointOnAWallIsWhatItsBeamMet) {
  const ScanCost cost(predictor_, RangeScan({{0.0, 3.0, BeamKind::hit}}), {});
  const BeamEvidence evidence(cost);
  EXPECT_NEAR(evidence.nearness(pose_), 1.0, 0.01);
  EXPECT_NEAR(evidence.at(pose_).front(), 0.0, 0.01);
}

TEST_F(BeamEvidenceTest, BehindGlassCostsLessOnAWallThanBesideIt) {
  // Both beams pass the pane; one ends on the wall behind, the other before it.
  const ScanCost on_wall(predictor_, RangeScan({{0.0, 5.0, BeamKind::hit}}), {});
  const ScanCost nowhere(predictor_, RangeScan({{0.0, 4.1, BeamKind::hit}}), {});
  const BeamEvidenceParams params;
  const double passes = params.cost.tau_long;
  EXPECT_NEAR(BeamEvidence(on_wall).at(pose_).front(), passes, 0.01);
  EXPECT_NEAR(BeamEvidence(nowhere).nearness(pose_), 0.0, 0.01);
  EXPECT_NEAR(BeamEvidence(nowhere).at(pose_).front(), passes + params.off_wall_cost, 0.01);
}

TEST_F(BeamEvidenceTest, PointsFallOffAsAGaussian) {
  const ScanCost cost(predictor_, RangeScan({{0.0, 2.65, BeamKind::hit}}), {});
  BeamEvidenceParams params;
  params.wall_sigma = 0.3;
  EXPECT_NEAR(BeamEvidence(cost, params).nearness(pose_), std::exp(-0.5), 0.01);
}

TEST_F(BeamEvidenceTest, PointsInOnePlaceCountAsOne) {
  // Fifty beams to one place on the pane, and one into the middle of the room.
  std::vector<Beam> beams(50, Beam{0.0, 3.0, BeamKind::hit});
  beams.push_back({2.0, 2.0, BeamKind::hit});
  beams.push_back({2.5, 30.0, BeamKind::no_return});  // has no point
  const ScanCost cost(predictor_, RangeScan(beams), {});
  const BeamEvidence evidence(cost);
  EXPECT_NEAR(evidence.nearness(pose_), 0.5, 0.01);
  // The mean over all beams holds the mean over the places.
  PredictedRanges predicted;
  cost.predict(pose_, predicted);
  const double met = meanOf(beamEvidence(cost.beams(), predicted));
  EXPECT_NEAR(meanOf(evidence.at(pose_)), met + 0.5 * BeamEvidenceParams{}.off_wall_cost, 2e-3);
}

TEST_F(BeamEvidenceTest, OfNoBeamsIsNone) {
  const ScanCost cost(predictor_, RangeScan({}), {});
  EXPECT_TRUE(BeamEvidence(cost).at(pose_).empty());
  EXPECT_EQ(BeamEvidence(cost).nearness(pose_), 0.0);
}

}  // namespace
}  // namespace mrpt_polyloc
