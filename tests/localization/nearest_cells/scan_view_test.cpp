#include "tests/support/params_messages.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/localization/nearest_cells/scan_view.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;
using ::testing::HasSubstr;

TEST(ScanView, OfACleanScanIsWhatTheRaysSay) {
  const PolygonMap map = asymmetricRoom();
  const BruteForceRays rays(map);
  const TPose2D pose(1.5, 2.1, 0.7);
  const auto view = viewOfScan(simulatedScan(map, pose));
  ASSERT_TRUE(view);
  ASSERT_TRUE(view->samples.isComplete());
  EXPECT_TRUE(std::isinf(view->reach));
  double sum = 0.0;
  for (std::size_t i = 0; i < 180; ++i) {
    const double truth =
        rays.cast({pose.x, pose.y}, pose.phi + kPi / 90 * static_cast<double>(i)).wall;
    sum += std::pow(static_cast<double>(view->samples.samples()[i]) - truth, 2);
  }
  EXPECT_LT(std::sqrt(sum / 180), 0.25);  // but for the corners and jumps
}

TEST(ScanView, IsBlindToTheOrderOfBeamsAndToSingleSpikes) {
  const PolygonMap map = asymmetricRoom();
  const RangeScan scan = simulatedScan(map, {1.5, 2.1, 0.7});
  std::vector<Beam> beams = scan.beams();
  std::shuffle(beams.begin(), beams.end(), std::mt19937(1));
  const auto view = viewOfScan(scan), shuffled = viewOfScan(RangeScan(beams));
  EXPECT_EQ(view->samples.samples(), shuffled->samples.samples());

  beams = scan.beams();
  beams[40].range = beams[41].range = 0.1;
  const auto spiked = viewOfScan(RangeScan(beams));
  for (std::size_t i = 0; i < 180; ++i) {
    EXPECT_GT(spiked->samples.samples()[i], 0.2F) << i;
  }
}

TEST(ScanView, BridgesNarrowGapsAndLeavesWideOnesUnseen) {
  std::vector<Beam> beams;
  for (int degree = 0; degree < 360; ++degree) {
    const bool narrow = degree > 100 && degree<106, wide = degree> 200 && degree < 240;
    const BeamKind kind = narrow ? BeamKind::no_return : wide ? BeamKind::invalid : BeamKind::hit;
    beams.push_back({degree * kPi / 180, kind == BeamKind::no_return ? 30.0 : 2.0, kind});
  }
  const auto view = viewOfScan(RangeScan(beams));
  ASSERT_TRUE(view);
  EXPECT_TRUE(std::isinf(view->reach));
  for (std::size_t i = 0; i < 180; ++i) {
    if (2 * i == 200 || 2 * i == 240) continue;  // on a hit, by rounding on either side
    const bool is_unseen = 2 * i > 200 && 2 * i < 240;
    EXPECT_EQ(view->samples.isValid(i), !is_unseen) << i;
    EXPECT_EQ(view->samples.samples()[i], is_unseen ? 0.0F : 2.0F) << i;
  }
}

TEST(ScanView, ReachesAsFarAsNoReturnsSay) {
  std::vector<Beam> beams;
  for (int degree = -90; degree <= 90; ++degree) {
    const bool hit = std::abs(degree) > 20;
    beams.push_back(
        {degree * kPi / 180, hit ? 25.0 : 12.0, hit ? BeamKind::hit : BeamKind::no_return});
  }
  ScanViewParams params;
  auto view = viewOfScan(RangeScan(beams), params);
  EXPECT_EQ(view->reach, 12.0);
  EXPECT_EQ(view->samples.samples()[30], 20.0F);  // cut off at the range
  params.range = 10.0;
  view = viewOfScan(RangeScan(beams), params);
  EXPECT_TRUE(std::isinf(view->reach));
  EXPECT_EQ(view->samples.samples()[30], 10.0F);
  EXPECT_FALSE(view->samples.isValid(90));  // behind
  EXPECT_FALSE(view->samples.isValid(0));   // nothing came back
}

TEST(ScanView, OfScansThatSayTooLittleIsNone) {
  EXPECT_FALSE(viewOfScan(RangeScan({})));
  EXPECT_FALSE(viewOfScan(RangeScan({{0.0, 1.0, BeamKind::hit}})));
  EXPECT_FALSE(viewOfScan(RangeScan({{0.3, 1.0, BeamKind::hit}, {0.3, 2.0, BeamKind::hit}})));
  const Beam lost{0.1, 30.0, BeamKind::no_return};
  EXPECT_FALSE(viewOfScan(RangeScan({lost, {0.2, 30.0, BeamKind::no_return}})));
  // Between two samples, no sample.
  EXPECT_FALSE(viewOfScan(RangeScan({{0.001, 1.0, BeamKind::hit}, {0.002, 1.0, BeamKind::hit}})));
}

TEST(ScanView, BadParamsAreNamed) {
  ScanViewParams params;
  EXPECT_EQ(complaintOf(params), "");
  params.samples = 30;
  EXPECT_THAT(complaintOf(params), HasSubstr("samples"));
  params.samples = 181;
  EXPECT_THAT(complaintOf(params), HasSubstr("samples"));
  params = {};
  params.range = 0.0;
  EXPECT_THAT(complaintOf(params), HasSubstr("range"));
  params = {};
  params.bridged_gap = -0.1;
  EXPECT_THAT(complaintOf(params), HasSubstr("bridged_gap"));
}

}  // namespace
}  // namespace mrpt_polyloc::test
