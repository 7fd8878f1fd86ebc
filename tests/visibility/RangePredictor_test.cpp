#include "tests/support/BruteForceRays.h"
#include "tests/support/constants.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;
using test::BruteForceRays;
using test::kInfinityF;
using test::RayHit;

/// Equal up to single precision: of the range, and of coordinates on maps of up to 100 m.
bool closeInFloat(double a, double b) {
  return a == b || std::abs(a - b) <= 2e-5 * std::max(a, b) + 1e-6;
}

/// A few last places of single-precision coordinates on such maps [m].
constexpr double kShift = 4e-6;

/// How predictions compare with brute force, beam by beam.
struct Comparison {
  std::size_t beams = 0;
  std::size_t grazing = 0;  ///< differ, but so does brute force with the beam turned a little
  std::string failure;      ///< the first other difference
};

/// Whether a value equals or lies between two neighbours of a row.
bool liesIn(const std::vector<double>& row, double value) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (closeInFloat(row[i], value)) return true;
    if (i > 0 && (row[i - 1] < value) != (row[i] < value)) return true;
  }
  return false;
}

/// A beam that differs must pass a vertex, or a wall, closely: brute force itself changes when it
/// is turned by up to 2e-5 rad, or moved sideways by what single precision does to coordinates, and
/// the prediction lies among the results.
void compareBeam(const BruteForceRays& rays, const TPoint2D& from, double angle, float wall,
                 float open, Comparison& comparison) {
  ++comparison.beams;
  const RayHit hit = rays.cast(from, angle);
  if (closeInFloat(wall, hit.wall) && closeInFloat(open, hit.open)) return;
  bool wall_explained = false, open_explained = false;
  for (const double shift : {-kShift, 0.0, kShift}) {
    std::vector<double> walls, opens;
    for (const double turn : {-2e-5, -1e-5, -4e-6, -1e-6, 0.0, 1e-6, 4e-6, 1e-5, 2e-5}) {
      const double a = angle + turn;
      const RayHit other =
          rays.cast({from.x - shift * std::sin(a), from.y + shift * std::cos(a)}, a);
      walls.push_back(other.wall);
      opens.push_back(other.open);
    }
    wall_explained = wall_explained || liesIn(walls, wall);
    open_explained = open_explained || liesIn(opens, open);
  }
  if (wall_explained && open_explained) {
    ++comparison.grazing;
  } else if (comparison.failure.empty()) {
    comparison.failure = "from (" + std::to_string(from.x) + ", " + std::to_string(from.y) +
                         ") at angle " + std::to_string(angle) + ": predicted " +
                         std::to_string(wall) + " open " + std::to_string(open) + ", brute force " +
                         std::to_string(hit.wall) + " open " + std::to_string(hit.open);
  }
}

Comparison compare(const BruteForceRays& rays, const std::vector<TPose2D>& poses,
                   const std::vector<double>& bearings, const PredictedRanges& predicted) {
  Comparison comparison;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t k = 0; k < bearings.size(); ++k) {
      const std::size_t beam = i * bearings.size() + k;
      compareBeam(rays, {poses[i].x, poses[i].y}, poses[i].phi + bearings[k], predicted.wall[beam],
                  predicted.open[beam], comparison);
    }
  }
  return comparison;
}

std::vector<double> fan(std::size_t beams, double from, double field_of_view) {
  std::vector<double> bearings(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    bearings[i] = from + field_of_view * static_cast<double>(i) / static_cast<double>(beams);
  }
  return bearings;
}

/// Regular, partial, single, irregular and shuffled patterns, some far from [-pi, pi].
std::vector<double> randomBearings(std::mt19937& random) {
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  switch (random() % 6) {
    case 0:
      return fan(360, -kPi, 2 * kPi);
    case 1:
      return fan(181, -kPi / 2, kPi);
    case 2:
      return {angle(random)};
    case 3: {
      std::vector<double> bearings = fan(90, 10.0, -4.5);  // clockwise, wrapped
      std::shuffle(bearings.begin(), bearings.end(), random);
      return bearings;
    }
    case 4: {
      std::vector<double> bearings(random() % 40);
      for (double& b : bearings) b = 20 * angle(random);
      if (!bearings.empty()) bearings.push_back(bearings.front());  // a repeated one
      return bearings;
    }
    default:
      return {-kPi, kPi, 0.0, kPi / 2, -kPi / 2, std::nextafter(kPi, 0.0)};
  }
}

/// Poses in free space, and others in the box of the map: of these all is seen through free space.
std::vector<TPose2D> freePoses(const Triangulation& t, std::vector<TPose2D> poses) {
  const auto is_outside = [&t](const TPose2D& pose) { return !t.isFree({pose.x, pose.y}); };
  poses.erase(std::remove_if(poses.begin(), poses.end(), is_outside), poses.end());
  return poses;
}

std::vector<TPose2D> randomPoses(const PolygonMap& map, std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> heading(-kPi, kPi);
  std::vector<TPose2D> poses;
  for (const TPoint2D& p : test::randomPoints(map, 0.9, count, random)) {
    const double phi = random() % 4 == 0 ? 300 * heading(random) : heading(random);
    poses.emplace_back(p.x, p.y, phi);
  }
  return poses;
}

TEST(RangePredictor, EqualsBruteForceOnRandomMaps) {
  std::mt19937 random(21);
  std::size_t beams = 0, grazing = 0;
  for (std::uint32_t seed = 0; seed < 80; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PolygonMap map = test::floorPlan(test::randomParams(random), seed);
    const Triangulation triangulation(map);
    const double square_size = seed % 3 == 0 ? 0.2 : seed % 3 == 1 ? 0.5 : 1.7;
    const double horizon = seed % 4 == 0 ? 0.3 : seed % 4 == 1 ? 1.0 : seed % 4 == 2 ? 4.0 : 1e3;
    const BruteForceRays rays(map, horizon);
    const RangePredictor predictor(triangulation, square_size, 1, horizon);
    for (int i = 0; i < 6; ++i) {
      const std::vector<double> bearings = randomBearings(random);
      const std::vector<TPose2D> poses = freePoses(triangulation, randomPoses(map, 20, random));
      PredictedRanges predicted;
      predictor.predict(poses, BeamPattern(bearings), predicted);
      ASSERT_EQ(predicted.wall.size(), poses.size() * bearings.size());
      ASSERT_EQ(predicted.open.size(), poses.size() * bearings.size());
      const Comparison comparison = compare(rays, poses, bearings, predicted);
      EXPECT_EQ(comparison.failure, "");
      beams += comparison.beams;
      grazing += comparison.grazing;
    }
  }
  EXPECT_GT(beams, 300000U);
  EXPECT_LT(static_cast<double>(grazing), 1e-3 * static_cast<double>(beams));
}

TEST(RangePredictor, SeesNearWallsFromUnknownSpaceAndNoWallTooNear) {
  std::mt19937 random(24);
  const double outside = SquareExpander::kHorizonOutside;
  std::size_t near = 0, far = 0, wrong = 0;
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    const PolygonMap map = test::floorPlan(test::randomParams(random), seed);
    const Triangulation triangulation(map);
    const BruteForceRays rays(map);
    const RangePredictor predictor(triangulation, 0.5, 1);
    const std::vector<double> bearings = fan(90, -kPi, 2 * kPi);
    const BeamPattern beams(bearings);
    PredictedRanges predicted;
    for (const TPose2D& pose : randomPoses(map, 20, random)) {
      if (triangulation.isFree({pose.x, pose.y})) continue;
      predictor.predict(pose, beams, predicted);
      for (std::size_t i = 0; i < bearings.size(); ++i) {
        const RayHit hit = rays.cast({pose.x, pose.y}, pose.phi + bearings[i]);
        const double wall = predicted.wall[i];
        if (hit.wall < outside) {
          ++near;
          wrong += closeInFloat(wall, hit.wall) ? 0U : 1U;
        } else {
          ++far;
          wrong += wall < outside ? 1U : 0U;
        }
      }
    }
  }
  EXPECT_GT(near, 5000U);
  EXPECT_GT(far, 1000U);
  EXPECT_LE(wrong, (near + far) / 1000);  // beams that graze a vertex
}

TEST(RangePredictor, GivesOnePoseWhatItGivesMany) {
  std::mt19937 random(22);
  const PolygonMap map = test::floorPlan(test::randomParams(random), 22);
  const Triangulation triangulation(map);
  const RangePredictor predictor(triangulation, 0.5, 1), other(triangulation, 0.5, 2);
  const std::vector<TPose2D> poses = randomPoses(map, 300, random);
  for (int i = 0; i < 4; ++i) {
    const std::vector<double> bearings = randomBearings(random);
    const BeamPattern beams(bearings);
    PredictedRanges many, one, by_two_threads;
    predictor.predict(poses, beams, many);
    other.predict(poses, beams, by_two_threads);
    EXPECT_EQ(many.wall, by_two_threads.wall);
    EXPECT_EQ(many.open, by_two_threads.open);
    for (std::size_t k = 0; k < poses.size(); ++k) {
      predictor.predict(poses[k], beams, one);
      const auto begin = static_cast<std::ptrdiff_t>(k * bearings.size());
      ASSERT_TRUE(std::equal(one.wall.begin(), one.wall.end(), many.wall.begin() + begin));
      ASSERT_TRUE(std::equal(one.open.begin(), one.open.end(), many.open.begin() + begin));
    }
  }
}

TEST(RangePredictor, GivesTheLinesThatAreHit) {
  std::mt19937 random(23);
  std::size_t beams_hit = 0, on_line = 0;
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    const PolygonMap map = test::floorPlan(test::randomParams(random), seed);
    const BruteForceRays rays(map);
    const Triangulation triangulation(map);
    const RangePredictor predictor(triangulation, 0.5, 1);
    std::vector<double> bearings = fan(90, -2.0, 5.0);
    std::shuffle(bearings.begin(), bearings.end(), random);
    const BeamPattern beams(bearings);
    PredictedRanges ranges;
    PredictedHits hits;
    for (const TPose2D& pose : freePoses(triangulation, randomPoses(map, 60, random))) {
      predictor.predict(pose, beams, ranges);
      predictor.predict(pose, beams, hits);
      for (std::size_t i = 0; i < bearings.size(); ++i) {
        const double wall = ranges.wall[i];
        if (std::isinf(wall) && !std::isinf(ranges.open[i])) continue;  // beyond the horizon
        if (std::isinf(wall)) {
          EXPECT_EQ(hits.along[i], 0.0F);
          EXPECT_EQ(hits.across[i], 0.0F);
          continue;
        }
        const auto onLine = [&](double bearing) {
          return 1.0 / (hits.along[i] * std::cos(bearing) + hits.across[i] * std::sin(bearing));
        };
        EXPECT_NEAR(onLine(bearings[i]), wall, 1e-5 * wall);
        // Off a vertex, a beam a little beside hits the same line.
        const double beside = bearings[i] + 1e-3;
        const RayHit hit = rays.cast({pose.x, pose.y}, pose.phi + beside);
        ++beams_hit;
        on_line += std::abs(onLine(beside) - hit.wall) < 1e-3 * hit.wall ? 1 : 0;
      }
    }
  }
  EXPECT_GT(beams_hit, 10000U);
  EXPECT_GT(static_cast<double>(on_line), 0.97 * static_cast<double>(beams_hit));
}

TEST(RangePredictor, PredictsFromUnknownSpaceThatNoCellCovers) {
  Ring left = wallRing({{0, 0}, {4, 0}, {4, 4}, {0, 4}}), right = left;
  for (TPoint2D& p : right.vertices) p.x += 40;
  left.kinds[1] = right.kinds[3] = EdgeKind::open;
  const PolygonMap map({{left, {}}, {right, {}}}, {{{30, -1}, {31, 1}}});
  const Triangulation triangulation(map);
  const RangePredictor predictor(triangulation, 0.5, 1);
  ASSERT_FALSE(predictor.index().covers({20, 2}));
  const std::vector<double> bearings = fan(720, -kPi, 2 * kPi);
  const std::vector<TPose2D> poses{{20, 2, 0.3}, {35, 0.5, 2}, {10, 4.9, -1}};
  PredictedRanges predicted;
  predictor.predict(poses, BeamPattern(bearings), predicted);
  const Comparison comparison = compare(BruteForceRays(map), poses, bearings, predicted);
  EXPECT_EQ(comparison.failure, "");
  EXPECT_LT(comparison.grazing, 5U);
}

TEST(RangePredictor, SeesNothingFromOutsideTheBoxOrFromNowhere) {
  const Triangulation triangulation(PolygonMap({{wallRing({{0, 0}, {4, 0}, {4, 4}, {0, 4}}), {}}}));
  const RangePredictor predictor(triangulation, 0.5, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const BeamPattern beams(fan(36, -kPi, 2 * kPi));
  for (const TPose2D& pose : {TPose2D(100, 2, 0), TPose2D(nan, 2, 0), TPose2D(2, nan, 0),
                              TPose2D(2, 2, nan), TPose2D(2, 2, infinity), TPose2D(-1e300, 2, 0)}) {
    PredictedRanges predicted;
    predictor.predict(pose, beams, predicted);
    EXPECT_EQ(predicted.wall, std::vector<float>(36, kInfinityF));
    EXPECT_EQ(predicted.open, std::vector<float>(36, kInfinityF));
  }
}

TEST(RangePredictor, TakesNoPosesAndNoBeams) {
  const Triangulation triangulation(PolygonMap({{wallRing({{0, 0}, {4, 0}, {4, 4}, {0, 4}}), {}}}));
  const RangePredictor predictor(triangulation, 0.5, 1);
  PredictedRanges predicted{{1, 2, 3}, {4}};
  predictor.predict(std::vector<TPose2D>{}, BeamPattern({0.0}), predicted);
  EXPECT_TRUE(predicted.wall.empty() && predicted.open.empty());
  predictor.predict(TPose2D(1, 1, 0), BeamPattern(std::vector<double>{}), predicted);
  EXPECT_TRUE(predicted.wall.empty() && predicted.open.empty());
}

TEST(RangePredictor, HitsTheCornersOfARoom) {
  // Beams exactly through vertices meet one of the two walls there: never pass between.
  const Triangulation triangulation(PolygonMap({{wallRing({{0, 0}, {4, 0}, {4, 4}, {0, 4}}), {}}}));
  const RangePredictor predictor(triangulation, 0.5, 1);
  const BeamPattern beams(fan(8, -kPi, 2 * kPi));
  for (const double heading : {0.0, kPi / 4, -kPi / 2, kPi, 1000 * kPi, 1e3}) {
    PredictedRanges predicted;
    predictor.predict(TPose2D(2, 2, heading), beams, predicted);
    for (const float range : predicted.wall) {
      EXPECT_GE(range, 1.99999F);
      EXPECT_LE(range, 2.82844F);
    }
  }
}

}  // namespace
}  // namespace mrpt_polyloc
