#include "tests/support/constants.h"
#include "tests/support/params_messages.h"
#include <mrpt_polyloc/localization/scan/RobustCost.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mrpt_polyloc::test {
namespace {

using ::testing::HasSubstr;

constexpr float kEps = 1e-6F;

/// Binary fractions, so that sums are exact.
RobustCostParams roundParams() {
  RobustCostParams params;
  params.tau_short = 0.5;
  params.tau_long = 0.75;
  params.tau_open = 0.25;
  params.tau_none = 0.125;
  params.none_share = 0.5;
  return params;
}

TEST(RobustCost, HitWithoutAnOpenEdge) {
  const RobustCost cost(roundParams());
  EXPECT_FLOAT_EQ(cost.hit(3.0F, 3.0F, kInfinityF), 0.0F);
  EXPECT_NEAR(cost.hit(2.75F, 3.0F, kInfinityF), 0.25F, kEps);  // short of the wall
  EXPECT_FLOAT_EQ(cost.hit(2.0F, 3.0F, kInfinityF), 0.5F);
  EXPECT_NEAR(cost.hit(3.25F, 3.0F, kInfinityF), 0.25F, kEps);  // beyond the wall
  EXPECT_FLOAT_EQ(cost.hit(9.0F, 3.0F, kInfinityF), 0.75F);
  EXPECT_FLOAT_EQ(cost.hit(9.0F, kInfinityF, kInfinityF), 0.5F);  // no wall at all
}

TEST(RobustCost, HitWithAnOpenEdge) {
  const RobustCost cost(roundParams());
  EXPECT_NEAR(cost.hit(1.75F, 5.0F, 2.0F), 0.25F, kEps);  // short of the open edge
  EXPECT_FLOAT_EQ(cost.hit(1.0F, 5.0F, 2.0F), 0.5F);
  EXPECT_FLOAT_EQ(cost.hit(2.0F, 5.0F, 2.0F), 0.25F);  // at it: passed it
  EXPECT_FLOAT_EQ(cost.hit(3.0F, 5.0F, 2.0F), 0.25F);
  EXPECT_NEAR(cost.hit(4.875F, 5.0F, 2.0F), 0.125F, kEps);  // close to the wall beyond
  EXPECT_FLOAT_EQ(cost.hit(5.0F, 5.0F, 2.0F), 0.0F);
  EXPECT_NEAR(cost.hit(5.5F, 5.0F, 2.0F), 0.5F, kEps);  // beyond that wall it is known again
  EXPECT_FLOAT_EQ(cost.hit(9.0F, 5.0F, 2.0F), 0.75F);
  EXPECT_FLOAT_EQ(cost.hit(9.0F, kInfinityF, 2.0F), 0.25F);  // nothing known beyond
}

TEST(RobustCost, NoReturn) {
  const RobustCost cost(roundParams());
  EXPECT_FLOAT_EQ(cost.noReturn(8.0F, 3.0F, kInfinityF), 0.125F);  // a near wall
  EXPECT_FLOAT_EQ(cost.noReturn(8.0F, 4.0F, kInfinityF), 0.0F);    // not nearer than the share
  EXPECT_FLOAT_EQ(cost.noReturn(8.0F, 6.0F, kInfinityF), 0.0F);
  EXPECT_FLOAT_EQ(cost.noReturn(8.0F, kInfinityF, kInfinityF), 0.0F);
  EXPECT_FLOAT_EQ(cost.noReturn(8.0F, 3.0F, 2.0F), 0.0F);  // an open edge was crossed
  EXPECT_FLOAT_EQ(cost.noReturn(8.0F, kInfinityF, 2.0F), 0.0F);
}

TEST(RobustCost, OfABeamByItsKind) {
  const RobustCost cost(roundParams());
  EXPECT_NEAR(cost({0, 2.75, BeamKind::hit}, 3.0F, kInfinityF), 0.25F, kEps);
  EXPECT_FLOAT_EQ(cost({0, 8.0, BeamKind::no_return}, 3.0F, kInfinityF), 0.125F);
  EXPECT_FLOAT_EQ(cost({0, 8.0, BeamKind::invalid}, 3.0F, kInfinityF), 0.0F);
}

TEST(RobustCost, GrowsWithTheErrorOnEitherSideOfTheWall) {
  const RobustCost cost;
  constexpr float kWall = 4.0F;
  for (float z = 0.01F; z < 8.0F; z += 0.01F) {
    const float here = cost.hit(z, kWall, kInfinityF),
                next = cost.hit(z + 0.01F, kWall, kInfinityF);
    if (z + 0.01F <= kWall) {
      EXPECT_GE(here, next) << z;
    }
    if (z >= kWall) {
      EXPECT_LE(here, next) << z;
    }
    EXPECT_GE(here, 0.0F);
    EXPECT_LE(here, 0.6F);
    for (const float open : {1.0F, 2.5F, 3.99F}) {  // an open edge never makes a beam cost more
      EXPECT_LE(cost.hit(z, kWall, open), here + kEps) << z << " " << open;
    }
  }
}

TEST(RobustCost, ChecksNameTheField) {
  EXPECT_EQ(complaintOf(RobustCostParams{}), "");
  for (const double bad : {0.0, -1.0, std::nan(""), kInfinity}) {
    RobustCostParams params;
    params.tau_short = bad;
    EXPECT_THAT(complaintOf(params), HasSubstr("tau_short"));
    params = {};
    params.tau_long = bad;
    EXPECT_THAT(complaintOf(params), HasSubstr("tau_long"));
    params = {};
    params.tau_open = bad;
    EXPECT_THAT(complaintOf(params), HasSubstr("tau_open"));
  }
  for (const double bad : {-0.1, std::nan(""), kInfinity}) {
    RobustCostParams params;
    params.tau_none = bad;
    EXPECT_THAT(complaintOf(params), HasSubstr("tau_none"));
    params = {};
    params.none_share = bad;
    EXPECT_THAT(complaintOf(params), HasSubstr("none_share"));
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
