// What a localizer makes of scans, priors and parameters out of the ordinary.
#include "global_localizer.h"
#include "tests/support/constants.h"
#include "tests/support/params_messages.h"
#include <mrpt_polyloc/base/angles.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;
using ::testing::HasSubstr;

TEST_F(InAsymmetricRoom, NoMatchWhereThePriorIsOutsideTheMap) {
  PosePrior prior;
  prior.near = PosePrior::Disk{100, 100, 2};
  const auto result = localizer().localize(simulatedScan(asymmetricRoom(), {1.5, 2, 0.3}), prior);
  EXPECT_EQ(result.status, LocalizationStatus::no_match);
  expectConsistent(result);
}

TEST_F(InAsymmetricRoom, AScanOfAMuchLargerPlaceHasNoMatch) {
  const PolygonMap hall = squareMap(30.0);
  const auto result = localizer().localize(simulatedScan(hall, {13, 16, 0.4}));
  EXPECT_EQ(result.status, LocalizationStatus::no_match);
  expectConsistent(result);
}

TEST_F(InAsymmetricRoom, AScanFromOutsideTheMapGetsADefinedAnswer) {
  std::vector<Beam> beams;
  const BruteForceRays rays{asymmetricRoom()};
  for (int i = 0; i < 360; ++i) {
    const double bearing = i * kPi / 180;
    const double range = rays.cast({-3, 2}, bearing).wall;
    beams.push_back(
        {bearing, std::min(range, 20.0), range < 20.0 ? BeamKind::hit : BeamKind::no_return});
  }
  const auto result = localizer().localize(RangeScan(std::move(beams)));
  EXPECT_NE(result.status, LocalizationStatus::too_few_beams);
  expectConsistent(result);
}

TEST_F(InAsymmetricRoom, TooFewBeams) {
  const auto all = [](double range, BeamKind kind) {
    std::vector<Beam> beams;
    for (int i = 0; i < 360; ++i) beams.push_back({i * kPi / 180, range, kind});
    return RangeScan(std::move(beams));
  };
  for (const RangeScan& scan :
       {RangeScan({}), RangeScan({{0, 2, BeamKind::hit}}), all(2.0, BeamKind::invalid),
        all(20.0, BeamKind::no_return), all(kNaN, BeamKind::hit), all(kInfinity, BeamKind::hit),
        all(1e300, BeamKind::hit), all(-1.0, BeamKind::hit), all(0.0, BeamKind::hit)}) {
    const auto result = localizer().localize(scan);
    EXPECT_EQ(result.status, LocalizationStatus::too_few_beams);
    expectConsistent(result);
  }
}

TEST_F(InAsymmetricRoom, TheLeastNumberOfHitsIsSearchedFor) {
  const RangeScan whole = simulatedScan(asymmetricRoom(), {1.5, 2, 0.3});
  const auto withHits = [&](std::size_t hits) {
    std::vector<Beam> beams = whole.beams();
    for (std::size_t i = hits; i < beams.size(); ++i) beams[i].kind = BeamKind::invalid;
    return localizer().localize(RangeScan(std::move(beams)));
  };
  EXPECT_EQ(withHits(14).status, LocalizationStatus::too_few_beams);
  EXPECT_NE(withHits(15).status, LocalizationStatus::too_few_beams);
  expectConsistent(withHits(15));
}

TEST_F(InAsymmetricRoom, RangesAndBearingsOfAnySizeAreAnswered) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-300, 38), bearing(-1e6, 1e6);
  for (int run = 0; run < 5; ++run) {
    std::vector<Beam> beams = simulatedScan(asymmetricRoom(), {1.5, 2, 0.3}).beams();
    for (std::size_t i = 0; i < beams.size(); i += 3) {
      beams[i].range = std::pow(10.0, exponent(random));
      beams[i].bearing = run == 0 ? 1e308 : bearing(random);
    }
    expectConsistent(localizer().localize(RangeScan(std::move(beams))));
  }
}

TEST(GlobalLocalizer, RefusesAPriorThatSaysNothing) {
  PosePrior compass;
  compass.compass = PosePrior::Compass{0.0, 4.0};
  EXPECT_THAT(complaintOf(compass), HasSubstr("compass tolerance"));
  compass.compass = PosePrior::Compass{kNaN, 0.1};
  EXPECT_THAT(complaintOf(compass), HasSubstr("compass heading"));
  PosePrior disk;
  disk.near = PosePrior::Disk{0.0, 0.0, -1.0};
  EXPECT_THAT(complaintOf(disk), HasSubstr("near radius"));
  disk.near = PosePrior::Disk{0.0, kInfinity, 1.0};
  EXPECT_THAT(complaintOf(disk), HasSubstr("near y"));
}

TEST(GlobalLocalizerParams, ChecksNameTheField) {
  EXPECT_EQ(complaintOf(GlobalLocalizerParams{}), "");
  const auto complaint = [](const std::function<void(GlobalLocalizerParams&)>& spoil) {
    GlobalLocalizerParams params;
    spoil(params);
    EXPECT_THROW(GlobalLocalizer(squareMap(1.0), params), InvalidParamsError);
    return complaintOf(params);
  };
  EXPECT_THAT(complaint([](auto& p) { p.cost.tau_long = -1; }), HasSubstr("tau_long"));
  EXPECT_THAT(complaint([](auto& p) { p.certified.margin = -1; }), HasSubstr("margin"));
  EXPECT_THAT(complaint([](auto& p) { p.refinement.gate = 0; }), HasSubstr("gate"));
  EXPECT_THAT(complaint([](auto& p) { p.hypotheses.merge_angle = 0; }), HasSubstr("merge_angle"));
}

TEST(SearchOptions, ChecksNameTheField) {
  SearchOptions options;
  options.max_hypotheses = 0;
  EXPECT_THAT(complaintOf(options), HasSubstr("max_hypotheses"));
  options = {};
  options.threads = -1;
  EXPECT_THAT(complaintOf(options), HasSubstr("threads"));
  options = {};
  for (const double bad : {-1.0, kNaN}) {
    options.time_budget_ms = bad;
    EXPECT_THAT(complaintOf(options), HasSubstr("time_budget_ms"));
    EXPECT_THROW(GlobalLocalizer(squareMap(1.0)).localize(RangeScan({}), {}, options),
                 InvalidParamsError);
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
