#include "tests/support/BruteForceRays.h"
#include "tests/support/random_maps.h"
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
using test::RayHit;

constexpr double kPi = 3.14159265358979323846;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Equal up to single precision: of the range, and of coordinates on maps of up to 100 m.
bool close(double a, double b) {
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
    if (close(row[i], value)) return true;
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
  if (close(wall, hit.wall) && close(open, hit.open)) return;
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
    const BruteForceRays rays(map);
    const Triangulation triangulation(map);
    const double cell_size = seed % 3 == 0 ? 0.2 : seed % 3 == 1 ? 0.5 : 1.7;
    const RangePredictor predictor(triangulation, cell_size, 1);
    for (int i = 0; i < 6; ++i) {
      const std::vector<double> bearings = randomBearings(random);
      const std::vector<TPose2D> poses = randomPoses(map, 12, random);
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

}  // namespace
}  // namespace mrpt_polyloc
