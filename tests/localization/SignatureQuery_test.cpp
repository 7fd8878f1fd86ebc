#include "params_messages.h"
#include "simulated_scans.h"
#include <mrpt_polyloc/localization/RangeCode.h>
#include <mrpt_polyloc/localization/SignatureQuery.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace mrpt_polyloc::test {
namespace {

using ::testing::HasSubstr;

std::uint8_t code(double range) {
  return RangeCode::encode(static_cast<float>(range));
}

/// The bins that say something.
std::set<std::size_t> usedBins(const SignatureQuery& query) {
  std::set<std::size_t> bins;
  for (std::size_t i = 0; i < kBins; ++i) {
    if (query.cap_short[i] != 0 || query.cap_long[i] != 0) bins.insert(i);
  }
  return bins;
}

constexpr double kBinWidth = 2 * kPi / 256;

TEST(SignatureQuery, ABearingFallsIntoTheBinWithTheNearestCentre) {
  const auto binOf = [](double bearing) {
    const auto bins = usedBins(SignatureQuery(RangeScan({{bearing, 2.0, BeamKind::hit}})));
    EXPECT_EQ(bins.size(), 1U);
    return *bins.begin();
  };
  EXPECT_EQ(binOf(0.0), 0U);
  EXPECT_EQ(binOf(0.49 * kBinWidth), 0U);
  EXPECT_EQ(binOf(0.51 * kBinWidth), 1U);
  EXPECT_EQ(binOf(-0.49 * kBinWidth), 0U);
  EXPECT_EQ(binOf(-0.51 * kBinWidth), 255U);
  EXPECT_EQ(binOf(kPi), 128U);
  EXPECT_EQ(binOf(-kPi), 128U);
  EXPECT_EQ(binOf(kPi / 2), 64U);
  EXPECT_EQ(binOf(-kPi / 2), 192U);
  EXPECT_EQ(binOf(2 * kPi), 0U);
  EXPECT_EQ(binOf(2 * kPi * 5 + kPi / 2), 64U);
  EXPECT_EQ(binOf(-2 * kPi * 5 - kPi / 2), 192U);
  EXPECT_LT(binOf(1e308), kBins);  // no overflow
  for (std::size_t bin = 0; bin < kBins; ++bin) EXPECT_EQ(binOf(headingOfBin(bin)), bin);
}

TEST(SignatureQuery, TakesTheBeamNearestToTheCentre) {
  const SignatureQuery query(RangeScan({{10.3 * kBinWidth, 3.0, BeamKind::hit},
                                        {9.9 * kBinWidth, 2.0, BeamKind::hit},
                                        {10.2 * kBinWidth, 4.0, BeamKind::hit}}));
  EXPECT_EQ(query.used_bins, 1U);
  EXPECT_EQ(query.range[10], code(2.0));
}

TEST(SignatureQuery, TakesHitsBeforeNoReturns) {
  const Beam hit{10.4 * kBinWidth, 3.0, BeamKind::hit};
  const Beam none{10.0 * kBinWidth, 20.0, BeamKind::no_return};
  for (const auto& beams : {std::vector<Beam>{hit, none}, std::vector<Beam>{none, hit}}) {
    const SignatureQuery query{RangeScan(beams)};
    EXPECT_EQ(query.used_bins, 1U);
    EXPECT_EQ(query.range[10], code(3.0));
    EXPECT_EQ(query.cap_short[10], SignatureCosts{}.cap_short);
  }
}

TEST(SignatureQuery, CapsOfEachKind) {
  SignatureCosts costs;
  costs.cap_short = 5;
  costs.cap_long = 7;
  costs.cap_open = 3;
  costs.cap_none = 2;
  const RangeScan scan({{0, 3.0, BeamKind::hit}, {kPi, 20.0, BeamKind::no_return}});
  const SignatureQuery query(scan, costs, 0.5);
  EXPECT_EQ(query.cap_short[0], 5);
  EXPECT_EQ(query.cap_long[0], 7);
  EXPECT_EQ(query.cap_open[0], 3);
  EXPECT_EQ(query.range[128], code(10.0));
  EXPECT_EQ(query.cap_short[128], 0);
  EXPECT_EQ(query.cap_long[128], 2);
  EXPECT_EQ(query.cap_open[128], 0);
  EXPECT_EQ(SignatureQuery(scan, costs).range[128], code(16.0));
}

TEST(SignatureQuery, HoldsTheCircleTwice) {
  const SignatureQuery query(simulatedScan(asymmetricRoom(), {1, 2, 0.3}));
  EXPECT_EQ(query.used_bins, kBins);
  for (std::size_t i = 0; i < kBins; ++i) {
    EXPECT_EQ(query.range[i], query.range[i + kBins]);
    EXPECT_EQ(query.cap_short[i], query.cap_short[i + kBins]);
    EXPECT_EQ(query.cap_long[i], query.cap_long[i + kBins]);
    EXPECT_EQ(query.cap_open[i], query.cap_open[i + kBins]);
  }
}

TEST(SignatureQuery, InformsWhereARunOf64HoldsAUsedBin) {
  const RangeScan scan(
      {{headingOfBin(3), 3.0, BeamKind::hit}, {headingOfBin(100), 3.0, BeamKind::no_return}});
  const SignatureQuery query(scan);
  for (std::size_t first = 0; first + 64 <= 2 * kBins; ++first) {
    bool informs = false;
    for (std::size_t i = first; i < first + 64; ++i) informs |= query.cap_long[i] != 0;
    EXPECT_EQ(query.informsFrom(first), informs) << first;
  }
}

TEST(SignatureQuery, AnEmptyScanSaysNothing) {
  for (const RangeScan& scan : {RangeScan({}), RangeScan({{0, std::nan(""), BeamKind::hit}})}) {
    const SignatureQuery query(scan);
    EXPECT_EQ(query.used_bins, 0U);
    EXPECT_TRUE(usedBins(query).empty());
    for (std::size_t first = 0; first + 64 <= 2 * kBins; ++first) {
      EXPECT_FALSE(query.informsFrom(first));
    }
  }
}

TEST(SignatureCosts, ChecksNameTheField) {
  EXPECT_EQ(complaintOf(SignatureCosts{}), "");
  SignatureCosts costs;
  costs.cap_short = 64;
  EXPECT_THAT(complaintOf(costs), HasSubstr("cap_short"));
  costs = {};
  costs.cap_long = 64;
  EXPECT_THAT(complaintOf(costs), HasSubstr("cap_long"));
  costs = {};
  costs.cap_open = 255;
  EXPECT_THAT(complaintOf(costs), HasSubstr("cap_open"));
  costs = {};
  costs.cap_none = 64;
  EXPECT_THAT(complaintOf(costs), HasSubstr("cap_none"));
  costs.cap_none = 63;
  EXPECT_EQ(complaintOf(costs), "");
}

}  // namespace
}  // namespace mrpt_polyloc::test
