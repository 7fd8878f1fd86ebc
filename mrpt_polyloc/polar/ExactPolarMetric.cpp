#include <mrpt_polyloc/geometry/angles.h>
#include <mrpt_polyloc/geometry/cpu_dispatch.h>
#include <mrpt_polyloc/geometry/errors.h>
#include <mrpt_polyloc/polar/ExactPolarMetric.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace mrpt_polyloc {

namespace {

using mrpt::math::TPoint2D;
using Piece = PolarFunction::Piece;
using PieceKind = PolarFunction::PieceKind;

// What the walk below calls must be compiled for its machine along with it.
#if defined(__GNUC__)
#define POLYLOC_INLINE inline __attribute__((always_inline))
#else
#define POLYLOC_INLINE inline
#endif

POLYLOC_INLINE double dot(const TPoint2D& a, const TPoint2D& b) {
  return a.x * b.x + a.y * b.y;
}
POLYLOC_INLINE double cross(const TPoint2D& a, const TPoint2D& b) {
  return a.x * b.y - a.y * b.x;
}

POLYLOC_INLINE TPoint2D rotated(const TPoint2D& v, const TPoint2D& rotation) {
  return {rotation.x * v.x - rotation.y * v.y, rotation.y * v.x + rotation.x * v.y};
}

/// Directions [a, b] between two merged breakpoints.
struct Interval {
  TPoint2D a, b;
  double width;
};

/// sin(x) for 0 <= x <= pi / 2, quickly where scans of many beams need it.
POLYLOC_INLINE double sine(double x) {
  const double q = x * x;
  if (q > 0.01) return std::sin(x);
  return x + x * q * ((-1.0 / 6 + q * (1.0 / 120)) + q * q * (-1.0 / 5040 + q * (1.0 / 362880)));
}

/// A piece of either function in the common frame.
struct Side {
  PieceKind kind;
  double distance;
  TPoint2D normal;
  double least_cosine;

  double cosine(const TPoint2D& direction) const {
    return std::max(dot(normal, direction), least_cosine);
  }
};

// Below this the series is as good as the logarithm, which loses a factor 3 / square of digits.
constexpr double kSeriesSquare = 0.01;

/// (artanh(x) / x - 1) / x^2 = 1/3 + x^2/5 + x^4/7 + ... for x^2 <= kSeriesSquare.
POLYLOC_INLINE double artanhRest(double square) {
  const double q = square, q2 = q * q;
  return (1.0 / 3 + q * (1.0 / 5)) + q2 * (1.0 / 7 + q * (1.0 / 9)) +
         q2 * q2 * ((1.0 / 11 + q * (1.0 / 13)) + q2 * (1.0 / 15 + q * (1.0 / 17)));
}

/// Integral of (f - g)^2 for two walls.
///
/// With T the tangent of the angle from g's normal, f = d1 / ((c + s T) cos) and g = d2 / cos, so
/// the integral is that of (d1 / (c + s T) - d2)^2 dT: about the middle of the T-interval, a
/// quadratic form in d1 / (c + s T) - d2 there and in s, neither of which suffers when the walls
/// are parallel or the same.
POLYLOC_INLINE double wallAgainstWall(const Side& f, const Side& g, const Interval& interval) {
  double fa = f.cosine(interval.a), fb = f.cosine(interval.b);
  double ga = g.cosine(interval.a), gb = g.cosine(interval.b);
  double f_distance = f.distance, g_distance = g.distance;
  double s = cross(g.normal, f.normal);
  constexpr double kGrazing = 1e-4;
  if (ga * gb < kGrazing && fa * fb > ga * gb) {  // the less grazing wall measures the interval
    std::swap(fa, ga);
    std::swap(fb, gb);
    std::swap(f_distance, g_distance);
    s = -s;
  }
  const double inverse = 1.0 / (ga * gb);
  const double length = std::max(0.0, cross(interval.a, interval.b)) * inverse;  // T_b - T_a
  const double at_a = fa * gb * inverse, at_b = fb * ga * inverse;               // c + s T
  const double middle = 0.5 * (at_a + at_b);
  const double inverse_middle = 1.0 / middle;
  const double f_middle = f_distance * inverse_middle;
  const double difference = f_middle - g_distance;
  const double half_slope = 0.5 * s * length * inverse_middle;
  double square = half_slope * half_slope, rest, inverse_share;
  if (square < kSeriesSquare) {
    rest = artanhRest(square);
    inverse_share = 1.0 / (1.0 - square);
  } else {
    const double relative = 0.5 * (at_b - at_a) * inverse_middle;
    square = relative * relative;
    rest = (0.5 * std::log(at_b / at_a) / relative - 1.0) / square;
    inverse_share = middle * middle / (at_a * at_b);
  }
  return length *
         (difference * difference +
          f_middle * square * (2.0 * difference * rest + f_middle * (inverse_share - 2.0 * rest)));
}

/// Integral of (f - radius)^2 for a wall and an arc.
POLYLOC_INLINE double wallAgainstArc(const Side& wall, double radius, const Interval& interval) {
  const double cos_a = wall.cosine(interval.a), cos_b = wall.cosine(interval.b);
  const double sin_a = cross(wall.normal, interval.a), sin_b = cross(wall.normal, interval.b);
  // From the width, not from the vectors: the errors of neighbours must cancel, for here the small
  // is the difference of the large.
  const double half_sine = sine(0.5 * interval.width);
  const double half_cosine = std::sqrt(std::max(0.0, 1.0 - half_sine * half_sine));
  const double width_sine = 2.0 * half_sine * half_cosine;
  const double versine = 2.0 * half_sine * half_sine;
  // The integral of 1 / cos is artanh(sin), a difference of which is artanh(y).
  const double y = (width_sine * cos_a - versine * sin_a) / (versine + cos_a * cos_b);
  double secant_integral;
  if (y * y < kSeriesSquare) {
    secant_integral = y + y * y * y * artanhRest(y * y);
  } else {
    const auto exponential = [](double s, double c) {
      return s >= 0.0 ? (1.0 + s) / c : c / (1.0 - s);
    };
    secant_integral = std::log(exponential(sin_b, cos_b) / exponential(sin_a, cos_a));
  }
  const double d = wall.distance;
  return std::max(0.0, d * d * width_sine / (cos_a * cos_b) - 2.0 * radius * d * secant_integral +
                           radius * radius * interval.width);
}

POLYLOC_INLINE double squaredDifference(const Side& f, const Side& g, const Interval& interval) {
  if (f.kind == PieceKind::wall)
    return g.kind == PieceKind::wall ? wallAgainstWall(f, g, interval)
                                     : wallAgainstArc(f, g.distance, interval);
  if (g.kind == PieceKind::wall) return wallAgainstArc(g, f.distance, interval);
  const double difference = f.distance - g.distance;
  return difference * difference * interval.width;
}

struct SquaredDistance {
  double value = 0.0;
  bool any = false;  // some direction is seen by both
};

/// Walks along the pieces of g and of f turned, from one breakpoint of either to the next.
POLYLOC_HOT_LOOP
SquaredDistance squaredDistance(const PolarFunction& f, const PolarFunction& g, double rotation) {
  const double turn = wrapToTwoPi(rotation);
  const TPoint2D rotor(std::cos(turn), std::sin(turn));
  const auto& f_pieces = f.pieces();
  // What f shows at this direction comes to lie at 0.
  const double start = turn == 0.0 ? 0.0 : kTwoPi - turn;
  double shift = turn == 0.0 ? 0.0 : turn - kTwoPi;
  auto f_piece = std::upper_bound(f_pieces.begin(), f_pieces.end(), start,
                                  [](double angle, const Piece& p) { return angle < p.begin; }) -
                 1;
  const auto turnedSide = [&rotor](const Piece& p) {
    return Side{p.kind, p.distance, rotated(p.normal, rotor), p.least_cosine};
  };
  Side f_side = turnedSide(*f_piece);

  SquaredDistance sum;
  double position = 0.0;
  Interval interval{{1.0, 0.0}, {1.0, 0.0}, 0.0};
  for (const Piece& g_piece : g.pieces()) {
    const Side g_side{g_piece.kind, g_piece.distance, g_piece.normal, g_piece.least_cosine};
    while (position < g_piece.end) {
      const double f_end = f_piece->end + shift;
      const bool f_ends_first = f_end < g_piece.end;
      const double end = f_ends_first ? f_end : g_piece.end;
      interval.b = f_ends_first ? rotated(f_piece->end_vector, rotor) : g_piece.end_vector;
      interval.width = end - position;
      if (interval.width > 0.0 && f_side.kind != PieceKind::unseen &&
          g_side.kind != PieceKind::unseen) {
        sum.value += squaredDifference(f_side, g_side, interval);
        sum.any = true;
      }
      position = std::max(position, end);
      interval.a = interval.b;
      if (!f_ends_first) continue;
      if (++f_piece == f_pieces.end()) {
        f_piece = f_pieces.begin();
        shift += kTwoPi;
      }
      f_side = turnedSide(*f_piece);
    }
  }
  return sum;
}

}  // namespace

double distance(const PolarFunction& f, const PolarFunction& g, double rotation) {
  if (!std::isfinite(rotation))
    throw InvalidParamsError("rotation = " + std::to_string(rotation) + " must be finite");
  const SquaredDistance squared = squaredDistance(f, g, rotation);
  if (!squared.any) throw InvalidParamsError("the views have no direction in common");
  return std::sqrt(squared.value);
}

}  // namespace mrpt_polyloc
