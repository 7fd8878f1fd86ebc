#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/clutter.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace mrpt_polyloc::test {
namespace {

/// 4 m all around at every half degree; each tenth beam a no-return, each twentieth invalid.
RangeScan roundScan(std::size_t beams = 720, double field = kTwoPi) {
  std::vector<Beam> all(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    all[i] = {field * (static_cast<double>(i) / static_cast<double>(beams) - 0.5), 4.0,
              BeamKind::hit};
    if (i % 10 == 3) all[i] = {all[i].bearing, 20.0, BeamKind::no_return};
    if (i % 20 == 7) all[i] = Beam{};
  }
  return RangeScan(std::move(all), {0.1, 0.2}, 12.5, "laser");
}

std::size_t changedBeams(const RangeScan& before, const RangeScan& after) {
  std::size_t changed = 0;
  for (std::size_t i = 0; i < before.beams().size(); ++i) {
    changed += before.beams()[i].range != after.beams()[i].range;
  }
  return changed;
}

TEST(WithClutter, NoneChangesNothing) {
  const RangeScan scan = roundScan();
  const RangeScan same = withClutter(scan, {}, 1);
  EXPECT_EQ(changedBeams(scan, same), 0U);
  EXPECT_EQ(same.stamp(), 12.5);
  EXPECT_EQ(same.label(), "laser");
  EXPECT_EQ(same.sensor().x, 0.1);
}

TEST(WithClutter, ShortBeamsAreTheShareAskedForAndShorter) {
  const RangeScan scan = roundScan(7200);
  const RangeScan cut = withClutter(scan, {0.3, 0.0}, 2);
  const auto hits = static_cast<double>(scan.hitCount());
  EXPECT_NEAR(static_cast<double>(changedBeams(scan, cut)) / hits, 0.3, 0.02);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < scan.beams().size(); ++i) {
    const Beam &a = scan.beams()[i], &b = cut.beams()[i];
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_LE(b.range, a.range);
    if (a.range == b.range) continue;
    EXPECT_GT(b.range, 0.0);
    sum += b.range / a.range;
    count += 1.0;
  }
  EXPECT_NEAR(sum / count, 0.5, 0.02);  // uniform
}

TEST(WithClutter, AnOccluderIsOneSectorAtOneRange) {
  const RangeScan scan = roundScan();
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const RangeScan hidden = withClutter(scan, {0.0, 1.0}, seed);
    std::vector<double> bearings;
    double range = 0.0;
    for (std::size_t i = 0; i < scan.beams().size(); ++i) {
      const Beam& beam = hidden.beams()[i];
      if (beam.range == scan.beams()[i].range) continue;
      EXPECT_EQ(beam.kind, BeamKind::hit);
      if (range > 0.0) {
        EXPECT_EQ(beam.range, range);
      }
      range = beam.range;
      bearings.push_back(beam.bearing);
    }
    // The middle beam may be one of the no-returns, of 20 m; then the occluder may be behind 4 m.
    ASSERT_FALSE(bearings.empty()) << seed;
    double widest = 0.0;
    for (const double b : bearings) widest = std::max(widest, angleBetween(b, bearings.front()));
    EXPECT_LE(widest, 19.0 * kPi / 180.0) << seed;
    EXPECT_GE(range, 0.2 * 4.0);
    EXPECT_LE(range, 0.9 * 20.0);
  }
}

TEST(WithClutter, OccludersAreAsManyAsTheFieldOfViewTakes) {
  // On half a circle 5 of 10; each hides at most 19 degrees.
  const RangeScan half = roundScan(360, kPi);
  const RangeScan hidden = withClutter(half, {0.0, 10.0}, 3);
  EXPECT_GT(changedBeams(half, hidden), 2 * 8U);
  EXPECT_LE(changedBeams(half, hidden), 5 * 2 * 20U);
  const RangeScan none({}, {0, 0});
  EXPECT_TRUE(withClutter(none, {0.5, 10.0}, 1).beams().empty());
}

TEST(WithClutter, TheSameSeedGivesTheSameScan) {
  const RangeScan scan = roundScan();
  EXPECT_EQ(changedBeams(withClutter(scan, {0.2, 5.0}, 9), withClutter(scan, {0.2, 5.0}, 9)), 0U);
  EXPECT_GT(changedBeams(withClutter(scan, {0.2, 5.0}, 9), withClutter(scan, {0.2, 5.0}, 8)), 0U);
}

TEST(WithClutter, RefusesBadNumbers) {
  EXPECT_THROW(withClutter(roundScan(), {1.5, 0.0}, 1), InvalidParamsError);
  EXPECT_THROW(withClutter(roundScan(), {0.0, -1.0}, 1), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc::test
