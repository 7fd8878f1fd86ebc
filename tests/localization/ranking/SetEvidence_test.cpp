#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/ranking/SetEvidence.h>
#include <mrpt_polyloc/localization/scan/BeamEvidence.h>

#include <gtest/gtest.h>

#include <cmath>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

class SetEvidenceTest : public ::testing::Test {
 protected:
  static RangeScan scanFrom(const PolygonMap& map, const TPose2D& pose) {
    ScanOptions options;
    options.field_of_view = 4.0;
    options.sigma = 0.05;
    return simulatedScan(map, pose, options);
  }
  static ScanSet drive(const RangeScan& scan, const std::vector<TPose2D>& steps) {
    std::vector<Moment> moments;
    for (const TPose2D& step : steps) moments.push_back({{scan}, measuredMotion(step), false});
    return ScanSet(std::move(moments));
  }

  const PolygonMap map_ = asymmetricRoom();
  const Triangulation triangulation_{map_};
  const RangePredictor predictor_{triangulation_};
  const TPose2D here_{2, 1, 0.3}, there_{2.3, 1.4, 0.5};
};

TEST_F(SetEvidenceTest, OfOneScanIsThatOfTheScan) {
  const RangeScan scan = scanFrom(map_, here_);
  const ScanSet set(scan);
  const MomentWeights weights(set, {});
  const SetEvidence evidence(predictor_, set, weights);
  const ScanCost cost(predictor_, scan, {});
  const auto here = evidence.at({here_}), there = evidence.at({there_});
  EXPECT_EQ(here.front(), BeamEvidence(cost).at(here_));
  EXPECT_DOUBLE_EQ(evidence.cost({there_}), cost.mean(there_));
  const PairedDifference expected =
      BeamSectors(cost.beams()).difference(here.front(), there.front());
  const PairedDifference difference = evidence.difference(here, there);
  EXPECT_DOUBLE_EQ(difference.mean, expected.mean);
  EXPECT_DOUBLE_EQ(difference.standard_error, expected.standard_error);
}

TEST_F(SetEvidenceTest, TheSameScanAgainSaysNothingNewFromHereAndHalvesTheVarianceFromAfar) {
  const RangeScan scan = scanFrom(map_, here_);
  const auto compared = [&](const std::vector<TPose2D>& steps) {
    const ScanSet set = drive(scan, steps);
    const MomentWeights weights(set, {});
    const SetEvidence evidence(predictor_, set, weights);
    const std::vector<TPose2D> a(steps.size(), here_), b(steps.size(), there_);
    return evidence.difference(evidence.at(a), evidence.at(b));
  };
  const PairedDifference one = compared({{0, 0, 0}});
  const PairedDifference standing = compared({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  EXPECT_NEAR(standing.mean, one.mean, 1e-9);
  EXPECT_NEAR(standing.standard_error, one.standard_error, 1e-4 * one.standard_error);
  const PairedDifference apart = compared({{0, 0, 0}, {40, 0, 0}});
  EXPECT_NEAR(apart.mean, one.mean, 1e-9);
  EXPECT_NEAR(apart.standard_error, one.standard_error / std::sqrt(2.0), 1e-6);
}

TEST_F(SetEvidenceTest, TwoLasersOfOneMomentAreOneScanOfTheirBeams) {
  // Split into two lasers at one place, a scan says what it said.
  const RangeScan scan = scanFrom(map_, here_);
  std::vector<Beam> left, right;
  for (const Beam& beam : scan.beams()) (beam.bearing > 0.1 ? left : right).push_back(beam);
  const ScanSet set(std::vector<RangeScan>{RangeScan(right), RangeScan(left)});
  const ScanSet whole(scan);
  const MomentWeights weights(set, {}), weights_whole(whole, {});
  // (Points are thinned scan by scan, which differs a little.)
  BeamEvidenceParams met_alone;
  met_alone.off_wall_cost = 0.0;
  const SetEvidence split(predictor_, set, weights, {}, met_alone);
  const SetEvidence joined(predictor_, whole, weights_whole, {}, met_alone);
  const PairedDifference a = split.difference(split.at({here_}), split.at({there_}));
  const PairedDifference b = joined.difference(joined.at({here_}), joined.at({there_}));
  EXPECT_NEAR(a.mean, b.mean, 1e-6);
  EXPECT_NEAR(a.standard_error, b.standard_error, 1e-6);
  EXPECT_NEAR(split.cost({there_}), joined.cost({there_}), 1e-9);
}

}  // namespace
}  // namespace mrpt_polyloc::test
