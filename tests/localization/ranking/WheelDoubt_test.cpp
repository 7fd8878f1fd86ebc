#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/localization/ranking/WheelDoubt.h>

#include <gtest/gtest.h>

#include <cmath>

namespace mrpt_polyloc {
namespace {

mrpt::math::CMatrixDouble33 diagonal(double x, double y, double phi) {
  mrpt::math::CMatrixDouble33 matrix = mrpt::math::CMatrixDouble33::Zero();
  matrix(0, 0) = x * x;
  matrix(1, 1) = y * y;
  matrix(2, 2) = phi * phi;
  return matrix;
}

/// Movements that are off by so many times what the wheels say, and by what the scans err.
std::vector<MovementError> movements(std::size_t count, double times,
                                     const mrpt::math::CMatrixDouble33& scans, Random& random) {
  std::vector<MovementError> all(count);
  for (MovementError& movement : all) {
    movement.wheels = diagonal(0.01, 0.01, 0.02);
    movement.scans = scans;
    for (int i = 0; i < 3; ++i) {
      movement.off[static_cast<std::size_t>(i)] =
          std::sqrt(times * times * movement.wheels(i, i) + scans(i, i)) * random.normal();
    }
  }
  return all;
}

TEST(WheelDoubt, FindsTheScaleThatMovementsWereDrawnWith) {
  Random random(5);
  for (const double times : {3.0, 8.0, 20.0}) {
    const double scale =
        doubtWheels(movements(200, times, diagonal(0.01, 0.01, 0.01), random)).scale;
    EXPECT_NEAR(scale / times, 1.0, 0.15) << times;
  }
}

TEST(WheelDoubt, BelievesWheelsThatAreOffByChance) {
  EXPECT_EQ(doubtWheels({}).scale, 1.0);
  Random random(6);
  std::size_t doubted = 0;
  for (int i = 0; i < 200; ++i) {
    const double scale = doubtWheels(movements(2, 1.0, diagonal(0.005, 0.005, 0.01), random)).scale;
    EXPECT_LT(scale, 2.5);
    doubted += scale > 1.0;
  }
  EXPECT_LT(doubted, 30U);  // half of them, were nothing known before
}

TEST(WheelDoubt, HearsNothingFromWhatScansDoNotTell) {
  // Along a corridor scans say nothing: there a movement may seem off by anything.
  MovementError along;
  along.wheels = diagonal(0.01, 0.01, 0.02);
  along.scans = diagonal(2.0, 0.01, 0.01);
  along.off = {0.5, 0.0, 0.0};
  EXPECT_EQ(doubtWheels({along, along, along}).scale, 1.0);
  along.scans = diagonal(0.02, 0.01, 0.01);
  EXPECT_GT(doubtWheels({along, along, along}).scale, 10.0);
}

TEST(WheelDoubt, SpeaksAgainstWhatIsOff) {
  MovementError movement;
  movement.wheels = diagonal(0.01, 0.01, 0.02);
  movement.scans = diagonal(0.01, 0.01, 0.01);
  const double exact = doubtWheels({movement}).against;
  movement.off = {0.1, 0.0, 0.0};
  const double off = doubtWheels({movement}).against;
  movement.off = {0.3, 0.0, 0.0};
  const double far_off = doubtWheels({movement}).against;
  EXPECT_LT(exact, off);
  EXPECT_LT(off, far_off);
  // However far, not by more than some logarithms: wheels that err are an excuse for all ways.
  EXPECT_LT(far_off - off, 7.0 * std::log(3.0));
}

}  // namespace
}  // namespace mrpt_polyloc
