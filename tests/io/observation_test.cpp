#include "tests/support/bridge_files.h"
#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/io/observation.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>

#include <cmath>
#include <limits>

namespace mrpt_polyloc {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using testing::AllOf;
using testing::HasSubstr;

CObservation2DRangeScan plainScan(std::size_t beams, double aperture) {
  CObservation2DRangeScan scan;
  scan.aperture = static_cast<float>(aperture);
  scan.maxRange = 20.0F;
  scan.resizeScanAndAssign(beams, 2.0F, true);
  return scan;
}

std::string refusalOf(const CObservation2DRangeScan& scan) {
  try {
    toRangeScan(scan);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

// MRPT's own conversion of a scan into points in the robot frame is the oracle for all conventions.
TEST(ToRangeScan, HitsWhereMrptPutsItsPoints) {
  std::mt19937 random(11);
  for (int repeat = 0; repeat < 50; ++repeat) {
    auto observation = test::randomObservation(random, 2 + random() % 300);
    observation.maxRange = 1000.0F;
    mrpt::maps::CSimplePointsMap points;
    points.insertionOptions.minDistBetweenLaserPoints = 0.0F;
    points.insertionOptions.isPlanarMap = false;
    points.insertionOptions.also_interpolate = false;
    points.insertObservation(observation);

    const RangeScan scan = toRangeScan(observation);
    ASSERT_EQ(scan.beams().size(), observation.getScanSize());
    ASSERT_EQ(points.size(), scan.hitCount());
    std::size_t next = 0;
    for (const Beam& beam : scan.beams()) {
      if (beam.kind != BeamKind::hit) continue;
      float x = 0, y = 0;
      points.getPoint(next++, x, y);
      EXPECT_NEAR(scan.sensor().x + beam.range * std::cos(beam.bearing), x, 1e-4);
      EXPECT_NEAR(scan.sensor().y + beam.range * std::sin(beam.bearing), y, 1e-4);
    }
  }
}

TEST(ToRangeScan, SpreadsTheApertureOverTheBeamsBothEndsIncluded) {
  auto observation = plainScan(181, kPi);
  const RangeScan left = toRangeScan(observation);
  EXPECT_NEAR(left.beams().front().bearing, -kPi / 2, 1e-6);
  EXPECT_NEAR(left.beams()[90].bearing, 0.0, 1e-6);
  EXPECT_NEAR(left.beams().back().bearing, kPi / 2, 1e-6);

  observation.rightToLeft = false;
  observation.sensorPose = mrpt::poses::CPose3D(0.3, -0.1, 0.5, 1.0, 0, 0);
  const RangeScan right = toRangeScan(observation);
  EXPECT_NEAR(right.beams().front().bearing, 1.0 + 0.5 * kPi, 1e-6);
  EXPECT_NEAR(right.beams().back().bearing, 1.0 - 0.5 * kPi, 1e-6);
  EXPECT_DOUBLE_EQ(right.sensor().x, 0.3);
  EXPECT_DOUBLE_EQ(right.sensor().y, -0.1);
}

TEST(ToRangeScan, TellsKindsByFlagAndRange) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  struct Case {
    float range;
    bool valid;
    BeamKind kind;
    double expected;
  };
  const std::vector<Case> cases = {
      {2.0F, true, BeamKind::hit, 2.0},           {19.59F, true, BeamKind::hit, 19.59},
      {20.0F, true, BeamKind::no_return, 20.0},   {19.61F, true, BeamKind::no_return, 20.0},
      {81.9F, true, BeamKind::no_return, 20.0},   {81.9F, false, BeamKind::no_return, 20.0},
      {19.61F, false, BeamKind::no_return, 20.0}, {3.0F, false, BeamKind::invalid, 0.0},
      {0.0F, true, BeamKind::invalid, 0.0},       {0.0F, false, BeamKind::invalid, 0.0},
      {-1.0F, true, BeamKind::invalid, 0.0},      {nan, true, BeamKind::invalid, 0.0},
      {nan, false, BeamKind::invalid, 0.0},       {inf, true, BeamKind::no_return, 20.0},
      {inf, false, BeamKind::no_return, 20.0},    {-inf, true, BeamKind::invalid, 0.0},
      {-inf, false, BeamKind::invalid, 0.0}};
  auto observation = plainScan(cases.size(), kPi);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    observation.setScanRange(i, cases[i].range);
    observation.setScanRangeValidity(i, cases[i].valid);
  }
  const RangeScan scan = toRangeScan(observation);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(scan.beams()[i].kind, cases[i].kind) << i;
    EXPECT_NEAR(scan.beams()[i].range, cases[i].expected, 1e-6) << i;
  }
}

TEST(ToRangeScan, WithoutAMaximumRangeThereAreOnlyHits) {
  auto observation = plainScan(3, kPi);
  observation.maxRange = 0.0F;
  observation.setScanRangeValidity(1, false);
  observation.setScanRange(2, std::numeric_limits<float>::infinity());
  const RangeScan scan = toRangeScan(observation);
  EXPECT_EQ(scan.beams()[0].kind, BeamKind::hit);
  EXPECT_EQ(scan.beams()[1].kind, BeamKind::invalid);
  EXPECT_EQ(scan.beams()[2].kind, BeamKind::invalid);
}

TEST(ToRangeScan, OneBeamLooksAheadAndNoneIsAScanToo) {
  auto observation = plainScan(1, kPi);
  observation.sensorPose.setYawPitchRoll(0.5, 0, 0);
  const RangeScan one = toRangeScan(observation);
  ASSERT_EQ(one.beams().size(), 1U);
  EXPECT_DOUBLE_EQ(one.beams()[0].bearing, 0.5);
  EXPECT_EQ(one.hitCount(), 1U);
  EXPECT_TRUE(toRangeScan(plainScan(0, kPi)).beams().empty());
}

TEST(ToRangeScan, KeepsStampAndLabel) {
  auto observation = plainScan(3, kPi);
  observation.sensorLabel = "front";
  observation.timestamp = mrpt::Clock::fromDouble(1234567890.25);
  EXPECT_NEAR(toRangeScan(observation).stamp(), 1234567890.25, 1e-6);
  EXPECT_EQ(toRangeScan(observation).label(), "front");
  observation.timestamp = INVALID_TIMESTAMP;
  EXPECT_EQ(toRangeScan(observation).stamp(), 0.0);
}

TEST(ToRangeScan, ALaserUpsideDownHasMirroredBearings) {
  auto upright = plainScan(181, kPi);
  for (std::size_t i = 0; i < 181; ++i) {
    upright.setScanRange(i, 1.0F + 0.01F * static_cast<float>(i));
  }
  upright.sensorPose = mrpt::poses::CPose3D(0.2, 0.1, 0.3, 0.5, 0, 0);
  auto hanging = upright;
  for (std::size_t i = 0; i < 181; ++i) hanging.setScanRange(i, upright.getScanRange(180 - i));
  for (const double roll : {kPi, -kPi}) {
    hanging.sensorPose.setYawPitchRoll(0.5, 0, roll);
    const RangeScan a = toRangeScan(upright), b = toRangeScan(hanging);
    for (std::size_t i = 0; i < 181; ++i) {
      EXPECT_NEAR(a.beams()[i].bearing, b.beams()[180 - i].bearing, 1e-6);
      EXPECT_EQ(a.beams()[i].range, b.beams()[180 - i].range);
    }
  }
}

// MRPT's points are the oracle, seen from above.
TEST(ToRangeScan, ATiltedLaserIsProjectedToTheFloor) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> tilt(-0.11, 0.11);
  for (int repeat = 0; repeat < 50; ++repeat) {
    auto observation = test::randomObservation(random, 2 + random() % 300);
    observation.maxRange = 1000.0F;
    const double roll = tilt(random) + (repeat % 2 == 0 ? 0.0 : kPi);
    observation.sensorPose = mrpt::poses::CPose3D(0.3, -0.2, 100.0, 1.0, tilt(random), roll);
    mrpt::maps::CSimplePointsMap points;
    points.insertionOptions.minDistBetweenLaserPoints = 0.0F;
    points.insertionOptions.isPlanarMap = false;
    points.insertionOptions.also_interpolate = false;
    points.insertObservation(observation);
    const RangeScan scan = toRangeScan(observation);
    ASSERT_EQ(points.size(), scan.hitCount());
    std::size_t next = 0;
    for (const Beam& beam : scan.beams()) {
      if (beam.kind != BeamKind::hit) continue;
      float x = 0, y = 0;
      points.getPoint(next++, x, y);
      EXPECT_NEAR(scan.sensor().x + beam.range * std::cos(beam.bearing), x, 1e-4);
      EXPECT_NEAR(scan.sensor().y + beam.range * std::sin(beam.bearing), y, 1e-4);
    }
  }
}

// 0.3 m above the floor and 4 degrees down: the middle beam meets the floor at 4.30 m.
TEST(ToRangeScan, ReadingsOfTheFloorSayNothing) {
  const double down = 4.0 * kPi / 180;
  auto observation = plainScan(3, kPi);
  observation.sensorPose = mrpt::poses::CPose3D(0, 0, 0.3, 0, down, 0);
  EXPECT_EQ(toRangeScan(observation).beams()[1].kind, BeamKind::hit);
  EXPECT_NEAR(toRangeScan(observation).beams()[1].range, 2.0 * std::cos(down), 1e-6);
  for (const float range : {4.2F, 20.0F, std::numeric_limits<float>::infinity()}) {
    observation.setScanRange(1, range);
    EXPECT_EQ(toRangeScan(observation).beams()[1].kind, BeamKind::invalid) << range;
  }
  observation.setScanRange(0, 20.0F);  // a beam to the side stays level
  EXPECT_EQ(toRangeScan(observation).beams()[0].kind, BeamKind::no_return);
  observation.sensorPose.z() = 0.0;  // a height that says nothing
  observation.setScanRange(1, 4.2F);
  EXPECT_EQ(toRangeScan(observation).beams()[1].kind, BeamKind::hit);
}

TEST(ToRangeScan, RefusesASensorThatIsTiltedTooMuch) {
  auto observation = plainScan(3, kPi);
  observation.sensorLabel = "tilted";
  const auto refusalAt = [&](double z, double pitch_deg, double roll_deg) {
    observation.sensorPose =
        mrpt::poses::CPose3D(0, 0, z, 0.1, pitch_deg * kPi / 180, roll_deg * kPi / 180);
    return refusalOf(observation);
  };
  EXPECT_EQ(refusalAt(0, 5.0, 0), "");
  EXPECT_THAT(refusalAt(0, 6.0, 0),
              AllOf(HasSubstr("tilted by 6 deg"), HasSubstr("2.87"), HasSubstr("'tilted'")));
  EXPECT_THAT(refusalAt(0, 0, 174.0), HasSubstr("tilted by 6 deg"));
  EXPECT_EQ(refusalAt(0.6, 9.0, 0), "");
  EXPECT_EQ(refusalAt(0, -9.0, 0), "");  // up: no beam of this half circle meets the floor
  EXPECT_THAT(refusalAt(0, -11.0, 0), HasSubstr("tilted by 11 deg"));
  EXPECT_THAT(refusalAt(5.0, 11.0, 0), HasSubstr("at most 10 deg"));
}

TEST(ToRangeScan, RefusesWhatIsNotFinite) {
  auto observation = plainScan(3, std::nan(""));
  EXPECT_THAT(refusalOf(observation), HasSubstr("aperture"));
  observation = plainScan(3, -1.0);
  EXPECT_THAT(refusalOf(observation), HasSubstr("aperture"));
  observation = plainScan(3, kPi);
  observation.sensorPose.x(std::nan(""));
  EXPECT_THAT(refusalOf(observation), HasSubstr("not finite"));
}

TEST(ToObservation, IsTheInverse) {
  std::mt19937 random(12);
  for (int repeat = 0; repeat < 50; ++repeat) {
    auto observation = test::randomObservation(random, random() % 200);
    observation.rightToLeft = true;
    if (observation.getScanSize() > 3) observation.setScanRange(2, 0.0F);
    const RangeScan scan = toRangeScan(observation);
    const RangeScan back = toRangeScan(toObservation(
        scan, static_cast<double>(observation.aperture), observation.sensorPose.yaw(), 25.0));
    EXPECT_TRUE(test::sameScans({scan}, {back})) << repeat;
  }
}

TEST(ToObservation, RefusesBeamsThatAreElsewhere) {
  const RangeScan scan(
      {{-0.5, 1, BeamKind::hit}, {0.1, 1, BeamKind::hit}, {0.5, 1, BeamKind::hit}});
  EXPECT_THROW(toObservation(scan, 1.0, 0.0, 10.0), std::invalid_argument);
  const RangeScan even({{-0.5, 1, BeamKind::hit}, {0, 1, BeamKind::hit}, {0.5, 1, BeamKind::hit}});
  EXPECT_NO_THROW(toObservation(even, 1.0, 0.0, 10.0));
  EXPECT_THROW(toObservation(even, 1.0, 0.1, 10.0), std::invalid_argument);
  EXPECT_THROW(toObservation(even, -1.0, 0.0, 10.0), std::invalid_argument);
  EXPECT_THROW(toObservation(even, 1.0, 0.0, 0.0), std::invalid_argument);
}

/// The beams that say something.
std::vector<Beam> tellingBeams(const RangeScan& scan) {
  std::vector<Beam> beams;
  for (const Beam& beam : scan.beams()) {
    if (beam.kind != BeamKind::invalid) beams.push_back(beam);
  }
  return beams;
}

TEST(ToEvenObservation, IsTheInverseWhereBeamsAreEven) {
  Random random(31);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const double first = random.uniform(-3.0, 1.0), step = random.uniform(0.005, 0.05);
    std::vector<Beam> beams;
    for (int i = 0; i < 120; ++i) {
      const double lot = random.unit();
      const BeamKind kind = lot < 0.2 && i > 0 && i < 119 ? BeamKind::invalid
                            : lot < 0.4                   ? BeamKind::no_return
                                                          : BeamKind::hit;
      beams.push_back({first + step * i, random.uniform(0.1, 20.0), kind});
    }
    const RangeScan scan(beams, {0.3, -0.1}, 17.0, "LASER");
    const RangeScan back = toRangeScan(toEvenObservation(scan, 25.0));
    EXPECT_EQ(back.sensor().x, 0.3);
    EXPECT_EQ(back.sensor().y, -0.1);
    EXPECT_EQ(back.stamp(), 17.0);
    EXPECT_EQ(back.label(), "LASER");
    const std::vector<Beam> is = tellingBeams(back);
    std::size_t k = 0;
    for (const Beam& beam : tellingBeams(scan)) {
      if (beam.kind != BeamKind::hit) continue;
      while (k < is.size() && is[k].kind != BeamKind::hit) ++k;
      ASSERT_LT(k, is.size());
      EXPECT_LT(angleBetween(is[k].bearing, beam.bearing), 1e-5);
      EXPECT_NEAR(is[k].range, beam.range, 1e-5);
      ++k;
    }
    EXPECT_EQ(back.hitCount(), scan.hitCount());
  }
}

TEST(ToEvenObservation, UnevenBeamsMoveByUpToHalfTheirMiddleSpacing) {
  Random random(32);
  std::vector<Beam> beams;
  for (int i = 0; i < 200; ++i) {
    beams.push_back({-1.5 + 0.01 * i + random.uniform(-0.0009, 0.0009), 1.0 + i, BeamKind::hit});
  }
  const RangeScan back = toRangeScan(toEvenObservation(RangeScan(beams), 1000.0));
  EXPECT_GE(back.hitCount(), 190u);  // two may come to one place
  for (const Beam& beam : back.beams()) {
    if (beam.kind != BeamKind::hit) continue;
    const auto i = static_cast<std::size_t>(std::lround(beam.range - 1.0));
    ASSERT_LT(i, beams.size());
    EXPECT_LT(angleBetween(beam.bearing, beams[i].bearing), 0.0055) << i;
  }
}

TEST(ToEvenObservation, OfSeveralBeamsOnOnePlaceTheLastHitStays) {
  const RangeScan scan({{0.0, 1, BeamKind::hit},
                        {0.1, 2, BeamKind::hit},
                        {0.1001, 3, BeamKind::hit},
                        {0.1001, 9, BeamKind::no_return},
                        {0.2, 4, BeamKind::hit},
                        {0.3, 5, BeamKind::hit}});
  const auto observation = toEvenObservation(scan, 10.0);
  ASSERT_EQ(observation.getScanSize(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(observation.getScanRangeValidity(i));
    EXPECT_EQ(observation.getScanRange(i), i == 0 ? 1.0F : static_cast<float>(i + 2));
  }
}

TEST(ToEvenObservation, TakesScansOfNoneAndOfOneBeam) {
  EXPECT_EQ(toEvenObservation(RangeScan({}), 10.0).getScanSize(), 0u);
  EXPECT_EQ(toEvenObservation(RangeScan({{0.3, 0.0, BeamKind::invalid}}), 10.0).getScanSize(), 0u);
  const RangeScan back =
      toRangeScan(toEvenObservation(RangeScan({{0.3, 2.0, BeamKind::hit}}), 10.0));
  ASSERT_EQ(back.beams().size(), 1u);
  EXPECT_NEAR(back.beams()[0].bearing, 0.3, 1e-6);
  EXPECT_THROW(toEvenObservation(RangeScan({}), 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace mrpt_polyloc
