#include "exact_polar_metric.h"

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/base/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace mrpt_polyloc {

namespace {

using mrpt::math::TPoint2D;
using Piece = PolarFunction::Piece;
using PieceKind = PolarFunction::PieceKind;

inline TPoint2D rotated(const TPoint2D& v, const TPoint2D& rotation) {
  return {rotation.x * v.x - rotation.y * v.y, rotation.y * v.x + rotation.x * v.y};
}

/// Directions [a, b] between two merged breakpoints.
struct Interval {
  TPoint2D a, b;
  double width;
};

/// sin(x) for 0 <= x <= pi / 2, quickly where scans of many beams need it.
inline double sine(double x) {
  const double q = x * x;
  if (q > 0.01) return std::sin(x);
  return x + x * q * ((-1.0 / 6 + q * (1.0 / 120)) + q * q * (-1.0 / 5040 + q * (1.0 / 362880)));
}

inline double cosineTo(const Piece& wall, const TPoint2D& direction) {
  return std::max(dot(wall.normal, direction), wall.least_cosine);
}

// Below this, polynomials are as good as the logarithm, which loses a factor 3 / square of digits
// and cannot be computed for several at once.
constexpr double kPolynomialSquare = 0.25;

/// Sum of c_i q^i, in pairs: a short chain of operations.
template <std::size_t N>
inline double polynomial(const std::array<double, N>& c, double q) {
  const double q2 = q * q, q4 = q2 * q2;
  const auto four = [&](std::size_t i) {
    return (c[i] + q * c[i + 1]) + q2 * (c[i + 2] + q * c[i + 3]);
  };
  const double low = four(0) + q4 * (four(4) + q4 * four(8));
  return N == 13 ? low + q4 * q4 * q4 * c[N - 1] : low;
}

// Both are Chebyshev approximations over [0, 1/4] (mpmath.chebyfit with 12 and 13 terms, 40
// digits), right to 4e-15.
constexpr std::array<double, 12> kArtanhRest = {
    0.3333333333333321,   0.20000000000141915,  0.1428571425876679,    0.11111113107856016,
    0.09090832971393736,  0.076940110627039984, 0.066426644706095179,  0.061029020618395033,
    0.039305816604741698, 0.099519058254302751, -0.078691754867671743, 0.18584074530320289};
constexpr std::array<double, 13> kShareRest = {
    0.33333333333333586, 0.59999999999658278, 0.71428571504831003, 0.7777777111329764,
    0.81818483289785906, 0.84607305240920634, 0.86804860444121853, 0.86663384046868466,
    1.0158081580542188,  0.27496136922774774, 3.0647136194740553,  -3.5724014711239567,
    5.6713866479912722};

/// (artanh(x) / x - 1) / x^2 = 1/3 + x^2/5 + x^4/7 + ... for x^2 <= kPolynomialSquare.
inline double artanhRest(double square) {
  return polynomial(kArtanhRest, square);
}

/// 1 / (1 - x^2) - 2 artanhRest(x^2) = 1/3 + 3 x^2/5 + 5 x^4/7 + ...
inline double shareRest(double square) {
  return polynomial(kShareRest, square);
}

/// Intervals in which both functions show walls, number by number: so that several are computed at
/// once.
///
/// With T the tangent of the angle from g's normal, f = d1 / ((c + s T) cos) and g = d2 / cos, so
/// the integral is that of (d1 / (c + s T) - d2)^2 dT: about the middle of the T-interval, a
/// quadratic form in d1 / (c + s T) - d2 there and in s, neither of which suffers when the walls
/// are parallel or the same.
class WallPairs {
 public:
  static constexpr std::size_t kMost = 64;

  bool isFull() const { return count_ == kMost; }

  inline void add(const Piece& f, const Piece& g, const TPoint2D& a, const TPoint2D& b) {
    const std::size_t i = count_++;
    a_x_[i] = a.x, a_y_[i] = a.y, b_x_[i] = b.x, b_y_[i] = b.y;
    f_x_[i] = f.normal.x, f_y_[i] = f.normal.y;
    g_x_[i] = g.normal.x, g_y_[i] = g.normal.y;
    f_distance_[i] = f.distance, f_least_[i] = f.least_cosine;
    g_distance_[i] = g.distance, g_least_[i] = g.least_cosine;
  }

  /// The sum of the integrals of (f - g)^2; there are no pairs then.
  inline double takeSum() {
    for (std::size_t i = 0; i < count_; ++i) prepare(i);
    for (std::size_t i = 0; i < count_; ++i) {
      const double q = square_[i];
      value_[i] = integral(i, q, artanhRest(q), shareRest(q));
    }
    std::array<double, 8> lanes{};
    for (std::size_t i = 0; i < count_; ++i) {
      if (square_[i] >= kPolynomialSquare) {
        const double q = square_[i], x = std::sqrt(q);
        const double high = std::max(share_a_[i], share_b_[i]);
        const double low = std::min(share_a_[i], share_b_[i]);
        const double rest = (0.5 * std::log(high / low) / x - 1.0) / q;
        value_[i] = integral(i, q, rest, 1.0 / (low * high) - 2.0 * rest);
      }
      lanes[i % 8] += value_[i];
    }
    count_ = 0;
    return ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) +
           ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
  }

 private:
  using Numbers = std::array<double, kMost>;

  /// What the integral of pair i is computed from, without a branch.
  inline void prepare(std::size_t i) {
    const auto cosine = [](double n_x, double n_y, double x, double y, double least) {
      const double value = n_x * x + n_y * y;
      return value > least ? value : least;
    };
    const double fa = cosine(f_x_[i], f_y_[i], a_x_[i], a_y_[i], f_least_[i]);
    const double fb = cosine(f_x_[i], f_y_[i], b_x_[i], b_y_[i], f_least_[i]);
    const double ga = cosine(g_x_[i], g_y_[i], a_x_[i], a_y_[i], g_least_[i]);
    const double gb = cosine(g_x_[i], g_y_[i], b_x_[i], b_y_[i], g_least_[i]);
    // The less grazing wall measures the interval.
    constexpr double kGrazing = 1e-4;
    const bool swaps = (ga * gb < kGrazing) & (fa * fb > ga * gb);
    const double d1 = swaps ? g_distance_[i] : f_distance_[i];
    const double d2 = swaps ? f_distance_[i] : g_distance_[i];
    const double c1a = swaps ? ga : fa, c1b = swaps ? gb : fb;
    const double c2a = swaps ? fa : ga, c2b = swaps ? fb : gb;
    const double sine = g_x_[i] * f_y_[i] - g_y_[i] * f_x_[i];
    const double s = swaps ? -sine : sine;
    const double turn = a_x_[i] * b_y_[i] - a_y_[i] * b_x_[i];
    const double width = turn > 0.0 ? turn : 0.0;
    // c + s T at both ends, times the product.
    const double product = c2a * c2b, at_a = c1a * c2b, at_b = c1b * c2a;
    const double sum = at_a + at_b;
    const double inverse = 1.0 / (product * sum);
    const double inverse_sum = inverse * product;
    length_[i] = width * (inverse * sum);  // T_b - T_a
    f_middle_[i] = 2.0 * d1 * product * inverse_sum;
    // f_middle - d2, and 0 where the walls are the same.
    const double excess = c2b * (c2a - c1a) + c2a * (c2b - c1b);
    difference_[i] = (d1 - d2) + d1 * excess * inverse_sum;
    share_a_[i] = 2.0 * at_a * inverse_sum;  // of the value in the middle
    share_b_[i] = 2.0 * at_b * inverse_sum;
    const double slope = s * width * inverse_sum;
    // Where it is great it is better found from the ends themselves.
    const double relative = (at_b - at_a) * inverse_sum;
    const double x = slope * slope < kPolynomialSquare ? slope : relative;
    square_[i] = x * x;
  }

  inline double integral(std::size_t i, double square, double rest, double share_rest) const {
    return length_[i] *
           (difference_[i] * difference_[i] +
            f_middle_[i] * square * (2.0 * difference_[i] * rest + f_middle_[i] * share_rest));
  }

  std::size_t count_ = 0;
  Numbers a_x_, a_y_, b_x_, b_y_;
  Numbers f_x_, f_y_, f_distance_, f_least_;
  Numbers g_x_, g_y_, g_distance_, g_least_;
  Numbers length_, difference_, f_middle_, square_, share_a_, share_b_, value_;
};

/// Integral of (f - radius)^2 for a wall and an arc.
inline double wallAgainstArc(const Piece& wall, double radius, const Interval& interval) {
  const double cos_a = cosineTo(wall, interval.a), cos_b = cosineTo(wall, interval.b);
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
  if (y * y < kPolynomialSquare) {
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

/// Integral of (f - g)^2 where one at least is an arc.
inline double squaredDifference(const Piece& f, const Piece& g, const Interval& interval) {
  if (f.kind == PieceKind::wall) return wallAgainstArc(f, g.distance, interval);
  if (g.kind == PieceKind::wall) return wallAgainstArc(g, f.distance, interval);
  const double difference = f.distance - g.distance;
  return difference * difference * interval.width;
}

struct SquaredDistance {
  double value = 0.0;
  bool any = false;  // some direction is seen by both
};

/// The pieces of f turned counterclockwise by `turn` of [0, 2 pi), in order from the direction 0
/// on; the last reaches beyond 2 pi. Valid until the thread's next call.
const std::vector<Piece>& turnedPieces(const PolarFunction& f, double turn) {
  thread_local std::vector<Piece> turned;
  turned.clear();
  const std::vector<Piece>& pieces = f.pieces();
  const TPoint2D rotor(std::cos(turn), std::sin(turn));
  // What f shows at this direction comes to lie at 0.
  const double start = turn == 0.0 ? 0.0 : kTwoPi - turn;
  double shift = turn == 0.0 ? 0.0 : turn - kTwoPi;
  auto piece = std::upper_bound(pieces.begin(), pieces.end(), start,
                                [](double angle, const Piece& p) { return angle < p.begin; }) -
               1;
  for (std::size_t i = 0; i <= pieces.size(); ++i) {
    Piece& p = turned.emplace_back(*piece);
    p.end += shift;
    p.normal = rotated(piece->normal, rotor);
    p.end_vector = rotated(piece->end_vector, rotor);
    if (++piece != pieces.end()) continue;
    piece = pieces.begin();
    shift += kTwoPi;
  }
  turned.back().end = 2.0 * kTwoPi;
  return turned;
}

/// Walks along the pieces of g and of f turned, from one breakpoint of either to the next.
SquaredDistance squaredDistance(const PolarFunction& f_function, const PolarFunction& g_function,
                                double rotation) {
  const Piece* f = turnedPieces(f_function, wrapToTwoPi(rotation)).data();
  const Piece* g = g_function.pieces().data();
  const Piece* const g_end = g + g_function.pieces().size();
  SquaredDistance sum;
  WallPairs walls;
  double position = 0.0;
  Interval interval{{1.0, 0.0}, {1.0, 0.0}, 0.0};
  while (g != g_end) {
    const bool f_ends_first = f->end < g->end;
    const Piece* const ends = f_ends_first ? f : g;
    interval.b = ends->end_vector;
    interval.width = ends->end - position;
    if (interval.width > 0.0 && f->kind != PieceKind::unseen && g->kind != PieceKind::unseen) {
      sum.any = true;
      if (f->kind == PieceKind::wall && g->kind == PieceKind::wall) {
        walls.add(*f, *g, interval.a, interval.b);
        if (walls.isFull()) sum.value += walls.takeSum();
      } else {
        sum.value += squaredDifference(*f, *g, interval);
      }
    }
    position = std::max(position, ends->end);
    interval.a = interval.b;
    f += f_ends_first ? 1 : 0;
    g += f_ends_first ? 0 : 1;
  }
  sum.value += walls.takeSum();
  return sum;
}

}  // namespace

double distance(const PolarFunction& f, const PolarFunction& g, double rotation) {
  if (!std::isfinite(rotation))
    throw InvalidParamsError("rotation = " + formatted("%f", rotation) + " must be finite");
  const SquaredDistance squared = squaredDistance(f, g, rotation);
  if (!squared.any) throw InvalidParamsError("the views have no direction in common");
  return std::sqrt(squared.value);
}

}  // namespace mrpt_polyloc
