#include "tests/support/constants.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/polar/PolarFunction.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tests/support/star_polygons.h>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPoint2D;
using test::kInfinity;
using test::kNaN;
using test::polygonArea;
using test::randomStarPolygon;
using test::rayToBorder;
using test::StarPolygon;
using test::turnedPolygon;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Kind = PolarFunction::PieceKind;

PolarFunction functionOf(const StarPolygon& polygon) {
  return PolarFunction::fromPolygon(polygon.vertices, polygon.kernel);
}

template <class Call>
std::string paramsErrorOf(Call call) {
  try {
    call();
  } catch (const InvalidParamsError& error) {
    return error.what();
  }
  return "no InvalidParamsError";
}

std::string polygonErrorOf(const std::vector<TPoint2D>& vertices, const TPoint2D& kernel) {
  return paramsErrorOf([&] { PolarFunction::fromPolygon(vertices, kernel); });
}

void expectCoversTheCircle(const PolarFunction& f) {
  ASSERT_FALSE(f.pieces().empty());
  EXPECT_EQ(f.pieces().front().begin, 0.0);
  EXPECT_EQ(f.pieces().back().end, kTwoPi);
  for (std::size_t i = 0; i < f.pieces().size(); ++i) {
    EXPECT_LT(f.pieces()[i].begin, f.pieces()[i].end);
    if (i > 0) {
      EXPECT_EQ(f.pieces()[i].begin, f.pieces()[i - 1].end);
    }
  }
}

const std::vector<TPoint2D> kSquare{{0, 0}, {2, 0}, {2, 2}, {0, 2}};

TEST(PolarFunctionTest, SquareInClosedForm) {
  const auto f = PolarFunction::fromPolygon(kSquare, {1, 1});
  expectCoversTheCircle(f);
  EXPECT_EQ(f.pieces().size(), 5U);  // the wall across the direction 0 is in two
  EXPECT_DOUBLE_EQ(f.value(0.0), 1.0);
  EXPECT_NEAR(f.value(kPi / 4), std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(f.value(-kPi / 3), 1.0 / std::cos(kPi / 6), 1e-14);
  EXPECT_NEAR(f.value(100 * kTwoPi + 0.3), 1.0 / std::cos(0.3), 1e-12);
  EXPECT_NEAR(f.squaredNorm(), 8.0, 1e-13);
  EXPECT_NEAR(f.area(), 4.0, 1e-13);
  EXPECT_NEAR(f.minimum(), 1.0, 1e-15);
  EXPECT_NEAR(f.maximum(), std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(f.totalVariation(), 8.0 * (std::sqrt(2.0) - 1.0), 1e-13);
  EXPECT_TRUE(f.isComplete());
  EXPECT_DOUBLE_EQ(f.seenAngle(), kTwoPi);
}

TEST(PolarFunctionTest, AgreesWithRaysOnRandomPolygons) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-10.0, 10.0);
  for (int round = 0; round < 200; ++round) {
    const StarPolygon polygon = randomStarPolygon(random, 3 + random() % 60);
    const PolarFunction f = functionOf(polygon);
    expectCoversTheCircle(f);
    EXPECT_LE(f.pieces().size(), polygon.vertices.size() + 1);
    EXPECT_NEAR(f.area(), polygonArea(polygon.vertices), 1e-10) << round;
    for (int i = 0; i < 50; ++i) {
      const double phi = angle(random);
      const double expected = rayToBorder(polygon, phi);
      EXPECT_NEAR(f.value(phi), expected, 1e-9 * expected) << round << " " << phi;
      EXPECT_LE(f.minimum(), f.value(phi) + 1e-12);
      EXPECT_GE(f.maximum(), f.value(phi) - 1e-12);
    }
  }
}

TEST(PolarFunctionTest, TotalVariationIsTheLimitOfSampledOnes) {
  std::mt19937 random(2);
  for (int round = 0; round < 20; ++round) {
    const PolarFunction f = functionOf(randomStarPolygon(random, 5 + random() % 20));
    const int n = 200000;
    double variation = 0.0;
    for (int i = 0; i < n; ++i)
      variation += std::abs(f.value(kTwoPi * (i + 1) / n) - f.value(kTwoPi * i / n));
    EXPECT_LE(variation, f.totalVariation() + 1e-9);
    EXPECT_GE(variation, 0.999 * f.totalVariation()) << round;
  }
}

TEST(PolarFunctionTest, RepeatedAndCollinearVerticesDoNoHarm) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    const StarPolygon polygon = randomStarPolygon(random, 8);
    StarPolygon padded = polygon;
    padded.vertices.clear();
    for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
      const TPoint2D a = polygon.vertices[i];
      const TPoint2D b = polygon.vertices[(i + 1) % polygon.vertices.size()];
      padded.vertices.insert(padded.vertices.end(), {a, a, a + (b - a) * 0.3});
    }
    const PolarFunction f = functionOf(polygon), g = functionOf(padded);
    EXPECT_NEAR(f.squaredNorm(), g.squaredNorm(), 1e-10);
    EXPECT_NEAR(f.totalVariation(), g.totalVariation(), 1e-7);
    for (double phi = 0.05; phi < 6.28; phi += 0.1)
      EXPECT_NEAR(f.value(phi), g.value(phi), 1e-8) << round << " " << phi;
  }
}

TEST(PolarFunctionTest, WindowsAreJumps) {
  // Seen from the origin, the edge (1, 1) - (3, 3) points at the observer.
  const auto f = PolarFunction::fromPolygon({{-2, -2}, {3, -2}, {3, 3}, {1, 1}, {-2, 1}}, {0, 0});
  EXPECT_NEAR(f.value(kPi / 4 - 1e-7), 3.0 * std::sqrt(2.0), 1e-5);
  EXPECT_NEAR(f.value(kPi / 4 + 1e-7), std::sqrt(2.0), 1e-5);
  EXPECT_EQ(f.pieces().size(), 5U);
}

TEST(PolarFunctionTest, ClipsToARange) {
  std::mt19937 random(4);
  for (int round = 0; round < 100; ++round) {
    const StarPolygon polygon = randomStarPolygon(random, 3 + random() % 30);
    const PolarFunction f = functionOf(polygon);
    const double range = 0.3 + 0.1 * static_cast<double>(round);
    const auto g = PolarFunction::fromPolygon(polygon.vertices, polygon.kernel, range);
    expectCoversTheCircle(g);
    EXPECT_LE(g.maximum(), range * (1 + 1e-12));
    for (double phi = 0.013; phi < kTwoPi; phi += 0.05)
      EXPECT_NEAR(g.value(phi), std::min(f.value(phi), range), 1e-7) << round << " " << phi;
    double squares = 0.0;
    for (const auto& piece : g.pieces())
      squares += test::gaussIntegral(piece.begin, piece.end, 40, [&](double phi) {
        const double value = std::min(rayToBorder(polygon, phi), range);
        return value * value;
      });
    EXPECT_NEAR(g.squaredNorm(), squares, 1e-6 * squares) << round;
  }
  const auto disk = PolarFunction::fromPolygon(kSquare, {1, 1}, 0.5);
  EXPECT_NEAR(disk.area(), kPi / 4, 1e-13);
  EXPECT_DOUBLE_EQ(disk.minimum(), 0.5);
  const auto whole = PolarFunction::fromPolygon(kSquare, {1, 1}, kInfinity);
  EXPECT_NEAR(whole.area(), 4.0, 1e-13);
}

TEST(PolarFunctionTest, TurnsAndScales) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-20.0, 20.0);
  for (int round = 0; round < 100; ++round) {
    const StarPolygon polygon = randomStarPolygon(random, 3 + random() % 20);
    const PolarFunction f = functionOf(polygon);
    const double turn = round == 0 ? 0.0 : angle(random);
    const PolarFunction g = f.turned(turn), h = functionOf(turnedPolygon(polygon, turn));
    expectCoversTheCircle(g);
    EXPECT_NEAR(g.squaredNorm(), f.squaredNorm(), 1e-10);
    EXPECT_NEAR(g.totalVariation(), f.totalVariation(), 1e-8);
    const PolarFunction doubled = f.scaled(2.0);
    EXPECT_NEAR(doubled.area(), 4.0 * f.area(), 1e-10);
    for (int i = 0; i < 20; ++i) {
      const double phi = angle(random);
      EXPECT_NEAR(g.value(phi), f.value(phi - turn), 1e-7) << round;
      EXPECT_NEAR(g.value(phi), h.value(phi), 1e-7) << round;
      EXPECT_DOUBLE_EQ(doubled.value(phi), 2.0 * f.value(phi));
    }
  }
  const auto f = PolarFunction::fromPolygon(kSquare, {1, 1});
  EXPECT_THAT(paramsErrorOf([&] { f.scaled(0.0); }), HasSubstr("factor"));
  EXPECT_THAT(paramsErrorOf([&] { f.turned(kNaN); }), HasSubstr("angle"));
}

TEST(PolarFunctionTest, FourierCoefficientsAgreeWithQuadrature) {
  std::mt19937 random(6);
  for (int round = 0; round < 20; ++round) {
    const StarPolygon polygon = randomStarPolygon(random, 3 + random() % 30);
    const auto f = round % 2 == 0
                       ? functionOf(polygon)
                       : PolarFunction::fromPolygon(polygon.vertices, polygon.kernel, 4.0);
    const auto coefficients = f.fourierCoefficients(40);
    ASSERT_EQ(coefficients.size(), 41U);
    double energy = 0.0;
    for (std::size_t j = 0; j <= 40; ++j) {
      double real = 0.0, imaginary = 0.0;
      for (const auto& piece : f.pieces()) {
        const auto x = [&](double phi) { return static_cast<double>(j) * phi; };
        real += test::gaussIntegral(piece.begin, piece.end, 60,
                                    [&](double phi) { return f.value(phi) * std::cos(x(phi)); });
        imaginary -= test::gaussIntegral(piece.begin, piece.end, 60, [&](double phi) {
          return f.value(phi) * std::sin(x(phi));
        });
      }
      EXPECT_NEAR(coefficients[j].real(), real / kTwoPi, 1e-7) << round << " " << j;
      EXPECT_NEAR(coefficients[j].imag(), imaginary / kTwoPi, 1e-7) << round << " " << j;
      energy += (j == 0 ? 1.0 : 2.0) * kTwoPi * std::norm(coefficients[j]);
    }
    EXPECT_LE(energy, f.squaredNorm() * (1 + 1e-12));
    EXPECT_GE(energy, 0.8 * f.squaredNorm());
  }
}

TEST(PolarFunctionTest, NeedlesAndKernelsNearAnEdge) {
  for (const double width : {1e-3, 1e-6, 1e-8}) {
    const std::vector<TPoint2D> needle{{-5, -width}, {5, -width}, {5, width}, {-5, width}};
    const auto f = PolarFunction::fromPolygon(needle, {1, 0});
    expectCoversTheCircle(f);
    EXPECT_NEAR(f.area(), 20.0 * width, 1e-14 * 36 + 1e-6 * width) << width;
    EXPECT_NEAR(f.value(0.0), 4.0, 1e-12);
    EXPECT_NEAR(f.value(kPi / 2), width, 1e-12 * width);
    EXPECT_LE(f.maximum(), std::hypot(6.0, width) * (1 + 1e-12));
    const auto g = PolarFunction::fromPolygon(kSquare, {width, 1});
    EXPECT_NEAR(g.area(), 4.0, 1e-12) << width;
    EXPECT_NEAR(g.value(kPi), width, 1e-12 * width);
    EXPECT_LE(g.maximum(), std::hypot(2, 1) * (1 + 1e-12));
  }
}

TEST(PolarFunctionTest, WhatIsNarrowerThanAWindowIsAJump) {
  // The ends of this needle subtend 5e-10 and 3e-10 rad.
  const auto f =
      PolarFunction::fromPolygon({{-5, -1e-9}, {5, -1e-9}, {5, 1e-9}, {-5, 1e-9}}, {1, 0});
  EXPECT_EQ(f.pieces().size(), 2U);
  EXPECT_NEAR(f.area(), 0.0, 36.0 * 1e-9);
}

TEST(PolarFunctionTest, RefusesWhatIsNotStarShaped) {
  EXPECT_THAT(polygonErrorOf({{0, 0}, {1, 0}}, {0, 0}), HasSubstr("2 vertices"));
  EXPECT_THAT(polygonErrorOf({{0, 0}, {1, kNaN}, {0, 1}}, {0.1, 0.1}), HasSubstr("(1, nan)"));
  EXPECT_THAT(polygonErrorOf(kSquare, {kNaN, 0}), HasSubstr("kernel (nan, 0)"));
  EXPECT_THAT(polygonErrorOf(kSquare, {3, 1}), AllOf(HasSubstr("(3, 1)"), HasSubstr("outside")));
  EXPECT_THAT(polygonErrorOf(kSquare, {2, 1}),
              AllOf(HasSubstr("(2, 1)"), HasSubstr("lies on the edge (2, 0) to (2, 2)")));
  EXPECT_THAT(polygonErrorOf(kSquare, {2, 2}), HasSubstr("lies on the edge"));
  EXPECT_THAT(polygonErrorOf(kSquare, {2, 3}), HasSubstr("outside"));  // in line with an edge
  EXPECT_THAT(polygonErrorOf({{0, 2}, {2, 2}, {2, 0}, {0, 0}}, {1, 1}), HasSubstr("clockwise"));
  // An L, seen from the far end of one leg.
  EXPECT_THAT(polygonErrorOf({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, {3.5, 0.5}),
              AllOf(HasSubstr("not star-shaped around (3.5, 0.5)"), HasSubstr("(1, 1) to (1, 4)")));
  EXPECT_THAT(polygonErrorOf({{1, 1}, {1, 1}, {1, 1}}, {0, 0}), HasSubstr("outside"));
  std::vector<TPoint2D> twice = kSquare;
  twice.insert(twice.end(), kSquare.begin(), kSquare.end());
  EXPECT_THAT(polygonErrorOf(twice, {1, 1}), HasSubstr("winds 2 times"));
  for (const double range : {0.0, -1.0, kNaN})
    EXPECT_THAT(paramsErrorOf([&] {
                  PolarFunction::fromPolygon(kSquare, {1, 1}, range);
                }),
                HasSubstr("max_range"));
}

TEST(PolarFunctionTest, BeamsBecomeSectors) {
  const auto f = PolarFunction::fromBeams({0.0, 0.2, 0.1, -0.1}, {1.0, 3.0, 2.0, 4.0});
  expectCoversTheCircle(f);
  EXPECT_FALSE(f.isComplete());
  EXPECT_NEAR(f.seenAngle(), 0.4, 1e-12);
  EXPECT_DOUBLE_EQ(f.value(0.04), 1.0);
  EXPECT_DOUBLE_EQ(f.value(-0.04), 1.0);
  EXPECT_DOUBLE_EQ(f.value(0.06), 2.0);
  EXPECT_DOUBLE_EQ(f.value(0.24), 3.0);
  EXPECT_DOUBLE_EQ(f.value(-0.14), 4.0);
  EXPECT_TRUE(std::isnan(f.value(0.26)));
  EXPECT_TRUE(std::isnan(f.value(kPi)));
  EXPECT_NEAR(f.squaredNorm(), 0.1 * (1 + 4 + 9 + 16), 1e-12);
  EXPECT_DOUBLE_EQ(f.minimum(), 1.0);
  EXPECT_DOUBLE_EQ(f.maximum(), 4.0);
  EXPECT_NEAR(f.totalVariation(), 3 + 1 + 1 + 1, 1e-12);
}

TEST(PolarFunctionTest, AFullTurnOfBeamsHasNoGap) {
  std::vector<double> bearings, ranges;
  for (int i = 0; i < 360; ++i) {
    bearings.push_back(-kPi + kTwoPi * i / 360);
    ranges.push_back(1.0 + i % 7);
  }
  const auto f = PolarFunction::fromBeams(bearings, ranges);
  EXPECT_TRUE(f.isComplete());
  for (std::size_t i = 0; i < 360; ++i) EXPECT_EQ(f.value(bearings[i]), ranges[i]);
  // Twice the first bearing, once at either end.
  bearings.push_back(kPi);
  ranges.push_back(9.0);
  const auto g = PolarFunction::fromBeams(bearings, ranges);
  EXPECT_TRUE(g.isComplete());
  EXPECT_NEAR(g.seenAngle(), kTwoPi, 1e-12);
}

TEST(PolarFunctionTest, AMissingBeamLeavesAGap) {
  std::vector<double> bearings, ranges;
  for (int i = 0; i < 100; ++i) {
    if (i == 50) continue;
    bearings.push_back(0.01 * i);
    ranges.push_back(2.0);
  }
  const auto f = PolarFunction::fromBeams(bearings, ranges);
  EXPECT_TRUE(std::isnan(f.value(0.50)));
  EXPECT_EQ(f.value(0.494), 2.0);
  EXPECT_NEAR(f.seenAngle(), 0.99, 1e-9);
  const auto g = PolarFunction::fromBeams(bearings, ranges, 0.025);
  EXPECT_EQ(g.value(0.50), 2.0);
  EXPECT_NEAR(g.seenAngle(), 1.0, 1e-9);
}

TEST(PolarFunctionTest, RefusesWrongBeams) {
  const auto errorOf = [](std::vector<double> bearings, std::vector<double> ranges,
                          std::optional<double> max_gap = std::nullopt) {
    return paramsErrorOf([&] { PolarFunction::fromBeams(bearings, ranges, max_gap); });
  };
  EXPECT_THAT(errorOf({}, {}), HasSubstr("0 beams"));
  EXPECT_THAT(errorOf({1}, {1}), HasSubstr("1 beams"));
  EXPECT_THAT(errorOf({1, 2}, {1}), HasSubstr("2 bearings but 1 ranges"));
  EXPECT_THAT(errorOf({1, kNaN}, {1, 1}), HasSubstr("bearing of beam 1"));
  EXPECT_THAT(errorOf({1, 2}, {0, 1}), HasSubstr("range of beam 0"));
  EXPECT_THAT(errorOf({1, 2}, {1, kInfinity}), HasSubstr("range of beam 1"));
  EXPECT_THAT(errorOf({1, 1, 1}, {1, 2, 3}), HasSubstr("same bearing"));
  EXPECT_THAT(errorOf({1, 2}, {1, 2}, 0.0), HasSubstr("max_gap"));
}

}  // namespace
}  // namespace mrpt_polyloc
