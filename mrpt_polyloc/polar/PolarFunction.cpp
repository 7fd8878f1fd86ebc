#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/polar/PolarFunction.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace mrpt_polyloc {

namespace {

using mrpt::math::TPoint2D;
using Piece = PolarFunction::Piece;
using PieceKind = PolarFunction::PieceKind;

TPoint2D unitVector(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

TPoint2D rotated(const TPoint2D& v, const TPoint2D& rotation) {
  return {rotation.x * v.x - rotation.y * v.y, rotation.y * v.x + rotation.x * v.y};
}

double valueAtBegin(const Piece& piece) {
  return piece.value(piece.begin_vector);
}
double valueAtEnd(const Piece& piece) {
  return piece.value(piece.end_vector);
}

std::string toText(double value) {
  return formatted("%.9g", value);
}

std::string toText(const TPoint2D& point) {
  return "(" + toText(point.x) + ", " + toText(point.y) + ")";
}

Piece makePiece(PieceKind kind, double begin, double end, double distance) {
  Piece piece{};
  piece.begin = begin;
  piece.end = end;
  piece.kind = kind;
  piece.distance = distance;
  return piece;
}

/// Pieces that go once around, in any order and from any turn, as PolarFunction wants them: split
/// at the direction 0, sorted, each ending where the next begins.
std::vector<Piece> assembled(const std::vector<Piece>& pieces) {
  std::vector<Piece> result;
  result.reserve(pieces.size() + 1);
  for (Piece piece : pieces) {
    const double width = piece.end - piece.begin;
    piece.begin = wrapToTwoPi(piece.begin);
    piece.end = piece.begin + width;
    if (piece.end > kTwoPi) {
      Piece rest = piece;
      rest.begin = 0.0;
      rest.end = piece.end - kTwoPi;
      piece.end = kTwoPi;
      result.push_back(rest);
    }
    result.push_back(piece);
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Piece& a, const Piece& b) { return a.begin < b.begin; });
  result.front().begin = 0.0;
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i].end = i + 1 < result.size() ? result[i + 1].begin : kTwoPi;
  result.erase(std::remove_if(result.begin(), result.end(),
                              [](const Piece& piece) { return !(piece.begin < piece.end); }),
               result.end());
  for (Piece& piece : result) {
    piece.begin_vector = unitVector(piece.begin);
    piece.end_vector = unitVector(piece.end);
  }
  return result;
}

/// The least value over a piece: at the foot of the normal if that lies within.
double leastValue(const Piece& piece) {
  if (piece.kind != PieceKind::wall) return piece.distance;
  const bool foot_within =
      cross(piece.begin_vector, piece.normal) > 0.0 && cross(piece.normal, piece.end_vector) > 0.0;
  return foot_within ? piece.distance : std::min(valueAtBegin(piece), valueAtEnd(piece));
}

/// Integral of f^2 over a piece.
double squaredNormOf(const Piece& piece) {
  const double width = piece.end - piece.begin;
  if (piece.kind == PieceKind::unseen) return 0.0;
  if (piece.kind == PieceKind::arc) return piece.distance * piece.distance * width;
  return valueAtBegin(piece) * valueAtEnd(piece) * std::sin(width);  // twice a triangle
}

/// Adds coefficient j of one piece to sums[j] (not yet divided by 2 pi).
void addFourierIntegrals(const Piece& piece, std::vector<std::complex<double>>& sums) {
  using Complex = std::complex<double>;
  // In the wall's own direction x = phi - psi, so that f = d / cos x.
  const bool wall = piece.kind == PieceKind::wall;
  const TPoint2D origin = wall ? piece.normal : TPoint2D(1.0, 0.0);
  const Complex a(dot(origin, piece.begin_vector), -cross(origin, piece.begin_vector));
  const Complex b(dot(origin, piece.end_vector), -cross(origin, piece.end_vector));
  const Complex turn(origin.x, -origin.y);  // exp(-i psi)
  const double width = piece.end - piece.begin;

  Complex previous, current = 0.0;  // I_{j-1}, I_j
  if (wall) {
    const double cos_a = std::max(a.real(), piece.least_cosine);
    const double cos_b = std::max(b.real(), piece.least_cosine);
    // 1 / cos has the integral asinh(tan x), tan x has -log(cos x).
    current = std::asinh(-b.imag() / cos_b) - std::asinh(-a.imag() / cos_a);
    previous = Complex(width, -std::log(cos_b / cos_a));  // I_{-1} = conj(I_1)
  }
  Complex a_power = 1.0, b_power = 1.0, turn_power = 1.0;  // exp(-i j .)
  for (std::size_t j = 0; j < sums.size(); ++j) {
    // Integral of exp(-i j x).
    const Complex plain =
        j == 0 ? Complex(width) : (a_power - b_power) / Complex(0.0, static_cast<double>(j));
    sums[j] += piece.distance * turn_power * (wall ? current : plain);
    if (wall) {
      const Complex next = 2.0 * plain - previous;
      previous = current;
      current = next;
    }
    a_power *= a;
    b_power *= b;
    turn_power *= turn;
  }
}

// Edges narrower than this, seen from the kernel, are windows: computed window ends miss the line
// through the kernel by rounding.
constexpr double kWindowAngle = 1e-9;
// A kernel closer to an edge than this share of the greatest radius is on the border.
constexpr double kBorderShare = 1e-12;

/// Vertices relative to the kernel, checked one by one.
std::vector<TPoint2D> radiusVectors(const std::vector<TPoint2D>& vertices, const TPoint2D& kernel) {
  if (!std::isfinite(kernel.x) || !std::isfinite(kernel.y))
    throw InvalidParamsError("kernel " + toText(kernel) + " is not finite");
  if (vertices.size() < 3)
    throw InvalidParamsError("a polygon of " + std::to_string(vertices.size()) +
                             " vertices around " + toText(kernel) + ": three are needed");
  std::vector<TPoint2D> radii;
  radii.reserve(vertices.size());
  for (const TPoint2D& vertex : vertices) {
    if (!std::isfinite(vertex.x) || !std::isfinite(vertex.y))
      throw InvalidParamsError("vertex " + toText(vertex) + " is not finite");
    radii.push_back(vertex - kernel);
  }
  return radii;
}

/// Why the edges do not go once around the kernel, counterclockwise and without turning back.
[[noreturn]] void throwNotStarShaped(const TPoint2D& kernel, long turns,
                                     const std::string& backward_edge) {
  if (turns == 0)
    throw InvalidParamsError("kernel " + toText(kernel) + " lies outside the polygon");
  if (turns == -1)
    throw InvalidParamsError("the polygon around " + toText(kernel) + " runs clockwise");
  if (backward_edge.empty())
    throw InvalidParamsError("the polygon winds " + std::to_string(turns) + " times around " +
                             toText(kernel));
  throw InvalidParamsError("the polygon is not star-shaped around " + toText(kernel) + ": edge " +
                           backward_edge + " is seen from behind");
}

/// The walls of a star-shaped polygon, in order.
std::vector<Piece> wallsOf(const std::vector<TPoint2D>& vertices, const TPoint2D& kernel) {
  const std::vector<TPoint2D> radii = radiusVectors(vertices, kernel);
  double radius = 0.0;
  for (const TPoint2D& r : radii) radius = std::max(radius, std::hypot(r.x, r.y));

  std::vector<Piece> walls;
  walls.reserve(radii.size());
  double turned_angle = 0.0;
  std::string backward_edge;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const std::size_t j = (i + 1) % radii.size();
    const TPoint2D edge = radii[j] - radii[i];
    const double length = std::hypot(edge.x, edge.y);
    if (length == 0.0) continue;  // a repeated vertex
    const double area = cross(radii[i], radii[j]);
    const auto describe = [&] { return toText(vertices[i]) + " to " + toText(vertices[j]); };
    const bool foot_within = dot(radii[i], edge) <= 0.0 && dot(radii[j], edge) >= 0.0;
    if (foot_within && std::abs(area) <= kBorderShare * radius * length)
      throw InvalidParamsError("kernel " + toText(kernel) + " lies on the edge " + describe());
    const double angle = std::atan2(area, dot(radii[i], radii[j]));
    turned_angle += angle;
    if (angle < -kWindowAngle && backward_edge.empty()) backward_edge = describe();
    if (angle <= kWindowAngle) continue;
    const double begin = std::atan2(radii[i].y, radii[i].x);
    Piece wall = makePiece(PieceKind::wall, begin, begin + angle, area / length);
    wall.normal = TPoint2D(edge.y / length, -edge.x / length);
    wall.least_cosine = wall.distance / std::max(std::hypot(radii[i].x, radii[i].y),
                                                 std::hypot(radii[j].x, radii[j].y));
    walls.push_back(wall);
  }
  const long turns = std::lround(turned_angle / kTwoPi);
  if (turns != 1 || !backward_edge.empty()) throwNotStarShaped(kernel, turns, backward_edge);
  return walls;
}

/// Appends a wall cut off at a range: up to two arcs with the near part of the wall between.
void appendClipped(const Piece& wall, double max_range, std::vector<Piece>& pieces) {
  const double reach = wall.distance < max_range ? std::acos(wall.distance / max_range) : 0.0;
  const double normal_angle = std::atan2(wall.normal.y, wall.normal.x);
  // Directions are compared as angles from the normal, which are within a right angle.
  const double begin = std::remainder(wall.begin - normal_angle, kTwoPi);
  const double end = begin + (wall.end - wall.begin);
  const double near_begin = std::clamp(-reach, begin, end);
  const double near_end = std::clamp(reach, begin, end);
  const auto append = [&](PieceKind kind, double from, double to) {
    if (!(from < to)) return;
    Piece piece = kind == PieceKind::wall ? wall : makePiece(kind, 0.0, 0.0, max_range);
    piece.begin = wall.begin + (from - begin);
    piece.end = wall.begin + (to - begin);
    if (kind == PieceKind::wall)
      piece.least_cosine = std::max(wall.least_cosine, wall.distance / max_range);
    pieces.push_back(piece);
  };
  append(PieceKind::arc, begin, near_begin);
  append(PieceKind::wall, near_begin, near_end);
  append(PieceKind::arc, std::max(near_begin, near_end), end);
}

/// Indices of the beams by bearing in [0, 2 pi), once they are checked.
std::vector<std::pair<double, double>> sortedBeams(const std::vector<double>& bearings,
                                                   const std::vector<double>& ranges) {
  if (bearings.size() != ranges.size())
    throw InvalidParamsError(std::to_string(bearings.size()) + " bearings but " +
                             std::to_string(ranges.size()) + " ranges");
  if (bearings.size() < 2)
    throw InvalidParamsError(std::to_string(bearings.size()) + " beams: two are needed");
  std::vector<std::pair<double, double>> beams;
  beams.reserve(bearings.size());
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    if (!std::isfinite(bearings[i]))
      throw InvalidParamsError("bearing of beam " + std::to_string(i) + " is not finite");
    if (!std::isfinite(ranges[i]) || !(ranges[i] > 0.0))
      throw InvalidParamsError("range of beam " + std::to_string(i) + " = " + toText(ranges[i]) +
                               " must be positive and finite");
    beams.emplace_back(wrapToTwoPi(bearings[i]), ranges[i]);
  }
  std::stable_sort(beams.begin(), beams.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  return beams;
}

/// The lower median of the spacings above zero.
double usualSpacing(std::vector<double> gaps) {
  gaps.erase(std::remove(gaps.begin(), gaps.end(), 0.0), gaps.end());
  if (gaps.size() < 2) throw InvalidParamsError("all beams have the same bearing");
  const auto median = gaps.begin() + static_cast<std::ptrdiff_t>((gaps.size() - 1) / 2);
  std::nth_element(gaps.begin(), median, gaps.end());
  return *median;
}

}  // namespace

double PolarFunction::Piece::value(const TPoint2D& direction) const {
  switch (kind) {
    case PieceKind::wall:
      return distance / std::max(dot(normal, direction), least_cosine);
    case PieceKind::arc:
      return distance;
    case PieceKind::unseen:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

PolarFunction::PolarFunction(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {
  minimum_ = std::numeric_limits<double>::infinity();
  const Piece* previous = nullptr;
  const Piece* first = nullptr;
  for (const Piece& piece : pieces_) {
    if (piece.kind == PieceKind::unseen) {
      seen_angle_is_full_ = false;
      continue;
    }
    const double begin = valueAtBegin(piece), end = valueAtEnd(piece), least = leastValue(piece);
    seen_angle_ += piece.end - piece.begin;
    squared_norm_ += squaredNormOf(piece);
    minimum_ = std::min(minimum_, least);
    maximum_ = std::max({maximum_, begin, end});
    total_variation_ += (begin - least) + (end - least);
    if (previous != nullptr) total_variation_ += std::abs(begin - valueAtEnd(*previous));
    if (first == nullptr) first = &piece;
    previous = &piece;
  }
  // Across the direction 0.
  total_variation_ += std::abs(valueAtBegin(*first) - valueAtEnd(*previous));
  if (seen_angle_is_full_) seen_angle_ = kTwoPi;
}

PolarFunction PolarFunction::fromPolygon(const std::vector<TPoint2D>& vertices,
                                         const TPoint2D& kernel, std::optional<double> max_range) {
  if (max_range && !(*max_range > 0.0))
    throw InvalidParamsError("max_range = " + toText(*max_range) + " must be positive");
  const std::vector<Piece> walls = wallsOf(vertices, kernel);
  if (!max_range || std::isinf(*max_range)) return PolarFunction(assembled(walls));
  std::vector<Piece> pieces;
  for (const Piece& wall : walls) appendClipped(wall, *max_range, pieces);
  return PolarFunction(assembled(pieces));
}

PolarFunction PolarFunction::fromBeams(const std::vector<double>& bearings,
                                       const std::vector<double>& ranges,
                                       std::optional<double> max_gap) {
  if (max_gap && !(*max_gap > 0.0))
    throw InvalidParamsError("max_gap = " + toText(*max_gap) + " must be positive");
  const auto beams = sortedBeams(bearings, ranges);
  const std::size_t n = beams.size();
  std::vector<double> gaps(n);  // from each beam to the next
  for (std::size_t i = 0; i + 1 < n; ++i) gaps[i] = beams[i + 1].first - beams[i].first;
  gaps[n - 1] = beams[0].first + kTwoPi - beams[n - 1].first;
  const double spacing = usualSpacing(gaps);
  const double greatest_gap = max_gap.value_or(1.5 * spacing);
  const auto reach = [&](double gap) {
    return gap <= greatest_gap ? 0.5 * gap : 0.5 * std::min(gap, std::min(spacing, greatest_gap));
  };

  std::vector<Piece> pieces;
  pieces.reserve(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const double before = reach(gaps[(i + n - 1) % n]), after = reach(gaps[i]);
    const auto [bearing, range] = beams[i];
    if (before + after > 0.0)
      pieces.push_back(makePiece(PieceKind::arc, bearing - before, bearing + after, range));
    if (2.0 * after < gaps[i])
      pieces.push_back(
          makePiece(PieceKind::unseen, bearing + after, bearing + gaps[i] - after, 0.0));
  }
  return PolarFunction(assembled(pieces));
}

std::vector<double> PolarFunction::breakpoints() const {
  std::vector<double> angles;
  angles.reserve(pieces_.size());
  for (const Piece& piece : pieces_) angles.push_back(piece.begin);
  return angles;
}

double PolarFunction::value(double phi) const {
  const double angle = wrapToTwoPi(phi);
  const auto after =
      std::upper_bound(pieces_.begin(), pieces_.end(), angle,
                       [](double value, const Piece& piece) { return value < piece.begin; });
  return (after - 1)->value(unitVector(angle));
}

PolarFunction PolarFunction::turned(double angle) const {
  if (!std::isfinite(angle)) throw InvalidParamsError("angle = " + toText(angle));
  const double turn = wrapToTwoPi(angle);
  const TPoint2D rotation = unitVector(turn);
  std::vector<Piece> pieces = pieces_;
  for (Piece& piece : pieces) {
    piece.begin += turn;
    piece.end += turn;
    piece.normal = rotated(piece.normal, rotation);
  }
  return PolarFunction(assembled(pieces));
}

PolarFunction PolarFunction::scaled(double factor) const {
  requirePositive("factor", factor);
  std::vector<Piece> pieces = pieces_;
  for (Piece& piece : pieces) piece.distance *= factor;
  return PolarFunction(std::move(pieces));
}

std::vector<std::complex<double>> PolarFunction::fourierCoefficients(std::size_t order) const {
  std::vector<std::complex<double>> coefficients(order + 1);
  for (const Piece& piece : pieces_)
    if (piece.kind != PieceKind::unseen) addFourierIntegrals(piece, coefficients);
  for (auto& coefficient : coefficients) coefficient /= kTwoPi;
  return coefficients;
}

}  // namespace mrpt_polyloc
