#include "travel_support.h"
#include <mrpt_polyloc/localization/scan/BeamSectors.h>
#include <mrpt_polyloc/localization/scan/beam_evidence.h>
#include <mrpt_polyloc/travel/PairEvidence.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tests/support/map_factories.h>
#include <tests/support/random_maps.h>

namespace mrpt_polyloc::test {
namespace {

LaserModel around(std::size_t beams, double max_range) {
  LaserModel laser;
  for (std::size_t i = 0; i < beams; ++i) {
    laser.bearings.push_back(2.0 * kPi * static_cast<double>(i) / static_cast<double>(beams) - kPi);
  }
  laser.max_range = max_range;
  return laser;
}

ExpectedReadings exactly(const std::vector<float>& ranges) {
  return {ranges, ranges};
}

/// Without any width of the bands it is the evidence of a scan that reads just what is expected.
TEST(PairEvidence, IsTheEvidenceOfAPerfectScan) {
  const PolygonMap map = floorPlan(smallFlat(), 2);
  const RangePredictor predictor(Triangulation(map), 0.5, 1);
  const LaserModel laser = around(90, 6.0);
  const BeamPattern pattern(laser.bearings);
  HypothesisParams params;
  params.evidence.hidden_cost = 0.0;  // it asks for the reading, not for a band
  const PairEvidence evidence(laser, params, 0.0);
  std::mt19937 random(2);
  const std::vector<TPoint2D> places = randomFreePoints(map, 40, random);
  for (std::size_t k = 0; k + 1 < places.size(); k += 2) {
    PredictedRanges truth, judged;
    predictor.predict({places[k].x, places[k].y, 0.3}, pattern, truth);
    predictor.predict({places[k + 1].x, places[k + 1].y, 1.3}, pattern, judged);
    std::vector<Beam> beams;
    for (std::size_t i = 0; i < laser.bearings.size(); ++i) {
      const bool is_hit = truth.wall[i] < 6.0F;
      beams.push_back({laser.bearings[i], is_hit ? static_cast<double>(truth.wall[i]) : 6.0,
                       is_hit ? BeamKind::hit : BeamKind::no_return});
    }
    const BeamSectors sectors(beams);
    const PairedDifference difference = sectors.difference(
        beamEvidence(beams, truth, params.evidence), beamEvidence(beams, judged, params.evidence));
    const double expected =
        difference.mean / std::hypot(difference.standard_error, params.indifference);
    EXPECT_NEAR(evidence.zScore(exactly(truth.wall), exactly(judged.wall)), expected, 1e-4);
  }
}

TEST(PairEvidence, TellsNothingWhereBandsOverlap) {
  const LaserModel laser = around(36, 10.0);
  const PairEvidence evidence(laser, {});
  ExpectedReadings a, b;
  a.low.assign(36, 2.0F);
  a.high.assign(36, 3.0F);
  b.low.assign(36, 2.9F);
  b.high.assign(36, 5.0F);
  EXPECT_EQ(evidence.tells(a, b), 0.0);
  b.low.assign(36, 4.0F);
  EXPECT_GT(evidence.tells(a, b), 0.99);
  // Beyond the laser's reach all is one.
  a.low.assign(36, 11.0F);
  a.high.assign(36, 12.0F);
  b.low.assign(36, 20.0F);
  b.high.assign(36, 21.0F);
  EXPECT_EQ(evidence.tells(a, b), 0.0);
}

TEST(PairEvidence, GrowsWithWhatDiffersAndIsSymmetric) {
  const LaserModel laser = around(180, 20.0);
  const PairEvidence evidence(laser, {});
  std::vector<float> walls(180, 4.0F);
  double before = 0.0;
  for (std::size_t different = 0; different <= 60; different += 5) {
    std::vector<float> other = walls;
    for (std::size_t i = 0; i < different; ++i) other[i] = 6.0F;
    const double tells = evidence.tells(exactly(walls), exactly(other));
    EXPECT_DOUBLE_EQ(tells, evidence.tells(exactly(other), exactly(walls)));
    EXPECT_GE(tells, before - 1e-9);
    EXPECT_LE(tells, 1.0);
    before = tells;
  }
  EXPECT_GT(before, 0.99);
}

}  // namespace
}  // namespace mrpt_polyloc::test
