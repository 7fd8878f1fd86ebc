#pragma once

#include <mrpt/math/TPoint2D.h>

#include <complex>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// The polar function of a view: f(phi) is how far one sees in direction phi.
///
/// A view is a star-shaped set around its kernel point (the observer), or a scan. f is made of
/// pieces: d / cos(phi - psi) along a wall whose line lies at distance d with normal direction psi,
/// a constant along an arc (range limit, scan sector), and nothing where the view does not reach
/// (a scan that does not look all round). Where an edge points at the kernel, f jumps.
///
/// Immutable. Angles in radians, lengths in metres, frame: the observer's, not turned.
class PolarFunction {
 public:
  enum class PieceKind : std::uint8_t { wall, arc, unseen };

  /// f over the directions [begin, end].
  struct Piece {
    double begin, end;  ///< 0 <= begin < end <= 2 pi
    PieceKind kind;
    double distance;                    ///< of a wall's line from the kernel; an arc's radius
    mrpt::math::TPoint2D normal;        ///< of a wall's line, of length 1, away from the kernel
    mrpt::math::TPoint2D begin_vector;  ///< (cos begin, sin begin)
    mrpt::math::TPoint2D end_vector;    ///< (cos end, sin end)
    /// Of a wall: the least normal . u(phi) over the piece, that is distance / greatest value.
    /// Rounding must not take a cosine below it.
    double least_cosine;

    /// f in the direction of a unit vector within the piece; NaN if unseen.
    double value(const mrpt::math::TPoint2D& direction) const;
  };

  /// The function of a polygon that is star-shaped around `kernel`.
  ///
  /// Edges that point at the kernel within 1e-9 rad (windows) become jumps. Repeated and collinear
  /// vertices do no harm. \param max_range cuts f off [m]: what lies beyond becomes an arc.
  /// \throws InvalidParamsError with coordinates if there are fewer than three vertices, if a
  /// coordinate is not finite, if the kernel lies outside or on the border, if the polygon runs
  /// clockwise or is not star-shaped around the kernel, or if max_range is not positive.
  /// O(n).
  static PolarFunction fromPolygon(const std::vector<mrpt::math::TPoint2D>& vertices,
                                   const mrpt::math::TPoint2D& kernel,
                                   std::optional<double> max_range = std::nullopt);

  /// The function of a scan: a step function, each beam a sector that reaches half way to its
  /// neighbours on either side.
  ///
  /// Steps rather than hits joined by lines: joining invents walls across every jump in range,
  /// and two beams pi apart join through the sensor. Where a neighbour is farther than `max_gap`
  /// (the edge of the field of view, beams left out), the sector reaches half a usual spacing (the
  /// lower median of the spacings above zero), and what is left between is unseen.
  /// \param bearings any order, any number of turns \param ranges positive, one per bearing; for
  /// a beam that returned nothing, the maximum range \param max_gap default 1.5 usual spacings
  /// \throws InvalidParamsError naming the beam if there are fewer than two beams, if the numbers
  /// of bearings and ranges differ, if a value is not finite, a range or max_gap not positive, or
  /// if all bearings are the same.
  /// O(n log n).
  static PolarFunction fromBeams(const std::vector<double>& bearings,
                                 const std::vector<double>& ranges,
                                 std::optional<double> max_gap = std::nullopt);

  /// The pieces in order; together they cover [0, 2 pi] without gaps, unseen sectors included.
  const std::vector<Piece>& pieces() const { return pieces_; }

  /// Where pieces begin, ascending from 0.
  std::vector<double> breakpoints() const;

  /// f(phi) for any angle; at a jump, the value towards greater angles; NaN where unseen.
  /// O(log n).
  double value(double phi) const;

  bool isComplete() const { return seen_angle_is_full_; }  ///< no direction is unseen
  double seenAngle() const { return seen_angle_; }         ///< measure of the domain [rad]
  double squaredNorm() const { return squared_norm_; }     ///< integral of f^2 [m2]
  double area() const { return 0.5 * squared_norm_; }      ///< of what is seen [m2]
  double minimum() const { return minimum_; }              ///< over the domain [m]
  double maximum() const { return maximum_; }              ///< over the domain [m]
  /// Total variation around the circle, jumps included (those at unseen sectors taken as if the
  /// sector were not there) [m].
  double totalVariation() const { return total_variation_; }

  /// This function turned counterclockwise: phi -> f(phi - angle).
  PolarFunction turned(double angle) const;
  /// This function of a view `factor` times as large. \throws InvalidParamsError unless it is
  /// positive and finite.
  PolarFunction scaled(double factor) const;

  /// F_j = 1/(2 pi) Integral f(phi) exp(-i j phi) dphi for j = 0..order, over the domain; the
  /// others are F_{-j} = conj(F_j).
  ///
  /// Exact piece by piece, by the recursion I_{j+1} = 2 Integral exp(-i j x) - I_{j-1} for
  /// I_j = Integral exp(-i j x) / cos x; rounding below 1e-14 (order + 1) pieces maximum().
  /// O(pieces * order).
  std::vector<std::complex<double>> fourierCoefficients(std::size_t order) const;

 private:
  explicit PolarFunction(std::vector<Piece> pieces);

  std::vector<Piece> pieces_;
  bool seen_angle_is_full_ = true;
  double seen_angle_ = 0.0;
  double squared_norm_ = 0.0;
  double minimum_ = 0.0;
  double maximum_ = 0.0;
  double total_variation_ = 0.0;
};

}  // namespace mrpt_polyloc
