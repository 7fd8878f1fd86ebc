#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

RangeScan scanAt(double stamp, const std::string& label = {}) {
  return RangeScan({{0.1, 2.0, BeamKind::hit}, {0.2, 3.0, BeamKind::no_return}}, {0, 0}, stamp,
                   label);
}

Moment moment(double stamp, const TPose2D& step) {
  return {{scanAt(stamp)}, measuredMotion(step), false};
}

/// Ten moments, a step each.
std::vector<Moment> drive(const TPose2D& step) {
  std::vector<Moment> moments;
  for (int i = 0; i < 10; ++i) moments.push_back(moment(100.0 + i, step));
  return moments;
}

std::vector<double> stampsOf(const ScanSet& set) {
  std::vector<double> stamps;
  for (const Moment& m : set.moments()) stamps.push_back(m.scans.front().stamp());
  return stamps;
}

TEST(ScanSet, KnowsWhereEachMomentIsSeenFromNow) {
  const ScanSet set({moment(1, {9, 9, 9}), moment(2, {1, 0, M_PI / 2}), moment(3, {2, 0, 0})});
  // Forward by 1, a turn to the left, forward by 2: the start is 2 behind and 1 to the right... in
  // the axes of now, which look along the map's y.
  const TPose2D start = set.fromNow(0).pose_before_after;
  EXPECT_NEAR(start.x, -2.0, 1e-12);
  EXPECT_NEAR(start.y, 1.0, 1e-12);
  EXPECT_NEAR(start.phi, -M_PI / 2, 1e-12);
  EXPECT_EQ(set.fromNow(2).pose_before_after, TPose2D(0, 0, 0));
  EXPECT_EQ(set.fromNow(2).covariance(0, 0), 0.0);
  EXPECT_GT(set.fromNow(0).covariance(2, 2), set.fromNow(1).covariance(2, 2));
  EXPECT_EQ(set.scanCount(), 3U);
  EXPECT_EQ(set.hitCount(), 3U);
  EXPECT_EQ(set.single(), nullptr);
  EXPECT_NE(ScanSet(scanAt(1)).single(), nullptr);
}

TEST(ScanSet, RefusesWhatIsNoDrive) {
  EXPECT_THROW(ScanSet(std::vector<Moment>{}), InvalidParamsError);
  EXPECT_THROW(ScanSet(std::vector<RangeScan>{}), InvalidParamsError);
  EXPECT_THROW(ScanSet({moment(2, {}), moment(1, {})}), InvalidParamsError) << "wrong order";
  EXPECT_NO_THROW(ScanSet({moment(2, {}), moment(0, {})})) << "stamp not known";
  EXPECT_THROW(ScanSet({moment(1, {}), moment(2, {std::nan(""), 0, 0})}), InvalidParamsError);
  Moment after_gap = moment(2, {});
  after_gap.is_after_gap = true;
  EXPECT_THROW(ScanSet({moment(1, {}), after_gap}), InvalidParamsError);
}

TEST(ScanSet, LastMetresEndAtTheLengthAGapAndAJump) {
  LastMetresParams params;
  params.length = 2.0;
  std::vector<Moment> moments = drive({0.5, 0, 0});
  EXPECT_EQ(stampsOf(lastMetres(moments, 9, params)),
            (std::vector<double>{105, 106, 107, 108, 109}));
  EXPECT_EQ(stampsOf(lastMetres(moments, 1, params)), (std::vector<double>{100, 101}));
  params.most_moments = 2;
  EXPECT_EQ(stampsOf(lastMetres(moments, 9, params)), (std::vector<double>{108, 109}));
  params.most_moments = 12;
  moments[8].is_after_gap = true;
  EXPECT_EQ(stampsOf(lastMetres(moments, 9, params)), (std::vector<double>{108, 109}));
  moments[9].since_before = measuredMotion({1.2, 0, 0});
  EXPECT_EQ(stampsOf(lastMetres(moments, 9, params)), (std::vector<double>{109}));
  params.length = 0.0;
  EXPECT_EQ(stampsOf(lastMetres(moments, 7, params)), (std::vector<double>{107}));
}

TEST(ScanSet, LastMetresLeaveOutWhatSeesTheSameAndKeepTheWay) {
  LastMetresParams params;
  params.spacing = 0.2;
  const std::vector<Moment> moments = drive({0.08, 0, 0.02});
  const ScanSet set = lastMetres(moments, 9, params);
  EXPECT_EQ(stampsOf(set), (std::vector<double>{100, 103, 106, 109}));
  // The way is that of all movements.
  TPose2D way(0, 0, 0);
  for (int i = 0; i < 9; ++i) way = way + moments[1].since_before.pose_before_after;
  const TPose2D back = TPose2D(0, 0, 0) - way;
  EXPECT_NEAR(set.fromNow(0).pose_before_after.x, back.x, 1e-9);
  EXPECT_NEAR(set.fromNow(0).pose_before_after.y, back.y, 1e-9);
  // Turning on the spot shows something new, standing nothing.
  EXPECT_EQ(lastMetres(drive({0, 0, 0.3}), 9, params).moments().size(), 10U);
  EXPECT_EQ(lastMetres(drive({0, 0, 0}), 9, params).moments().size(), 1U);
}

TEST(ScanSet, TheAccumulatorGathersTheLastMetres) {
  LastMetresParams params;
  for (const TPose2D& step :
       {TPose2D(0.3, 0, 0.1), TPose2D(0.05, 0.05, 0), TPose2D(0.9, 0, -0.2)}) {
    const std::vector<Moment> moments = drive(step);
    ScanAccumulator accumulator(params);
    for (std::size_t i = 0; i < moments.size(); ++i) {
      const ScanSet set = accumulator.add(moments[i].scans, moments[i].since_before);
      EXPECT_EQ(stampsOf(set), stampsOf(lastMetres(moments, i, params)));
    }
    accumulator.clear();
    EXPECT_EQ(accumulator.add({scanAt(200)}, Motion()).moments().size(), 1U);
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
