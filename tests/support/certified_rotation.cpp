// The minimum of the exact polar coordinate metric over rotations, by branch and bound.

#include "certified_rotation.h"

#include "exact_polar_metric.h"
#include <mrpt_polyloc/base/params_check.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <string>

namespace mrpt_polyloc {

namespace {

using Piece = PolarFunction::Piece;

/// What f does in one sector of the circle.
struct SectorRange {
  double least = std::numeric_limits<double>::infinity();
  double greatest = 0.0;
  double variation = 0.0;

  void include(double value) {
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
};

/// The ranges and variations of f over n equal sectors; a jump belongs to the sector after it.
std::vector<SectorRange> sectorRanges(const PolarFunction& f, std::size_t n) {
  std::vector<SectorRange> sectors(n);
  const double width = kTwoPi / static_cast<double>(n);
  const Piece& last = f.pieces().back();
  double previous = last.value(last.end_vector);
  for (const Piece& piece : f.pieces()) {
    auto index = std::min(static_cast<std::size_t>(piece.begin / width), n - 1);
    // A wall falls towards the foot of its normal and rises from there: cut there, it is monotone.
    double foot = piece.begin;
    if (piece.kind == PolarFunction::PieceKind::wall)
      foot = piece.begin +
             std::remainder(std::atan2(piece.normal.y, piece.normal.x) - piece.begin, kTwoPi);
    double position = piece.begin;
    const auto visit = [&](double angle, double value) {
      SectorRange& sector = sectors[index];
      sector.include(previous);
      sector.include(value);
      sector.variation += std::abs(value - previous);
      previous = value;
      position = angle;
    };
    visit(piece.begin, piece.value(piece.begin_vector));
    while (position < piece.end) {
      const double border = index + 1 < n ? width * static_cast<double>(index + 1) : kTwoPi;
      double next = std::min(piece.end, border);
      if (position < foot && foot < next) next = foot;
      const mrpt::math::TPoint2D direction(std::cos(next), std::sin(next));
      visit(next, piece.value(next == piece.end ? piece.end_vector : direction));
      if (next == border && index + 1 < n) sectors[++index].include(previous);
    }
  }
  return sectors;
}

double oscillation(const PolarFunction& f) {
  return f.maximum() - f.minimum();
}

/// How fast the squared metric can change per radian of rotation.
double slopeOfSquare(const PolarFunction& f, const PolarFunction& g) {
  if (f.isComplete() && g.isComplete())
    return std::min(f.totalVariation() * oscillation(g), g.totalVariation() * oscillation(f));
  // The norms over the common domain change as well. The complete one is turned under the other.
  const double greatest_difference = std::max(f.maximum() - g.minimum(), g.maximum() - f.minimum());
  return 2.0 * greatest_difference * (f.isComplete() ? f : g).totalVariation();
}

/// An interval of rotations, with the metric at its ends.
struct Arc {
  double begin, end;
  double at_begin, at_end;
  double bound;  // of the metric in between

  bool operator<(const Arc& other) const { return bound > other.bound; }  // least bound on top
};

class RotationSearch {
 public:
  RotationSearch(const PolarFunction& f, const PolarFunction& g, const CertificateParams& params)
      : f_(f), g_(g), params_(params), slope_(slopeOfSquare(f, g)) {
    if (f.isComplete()) f_modulus_.emplace(f);
    if (g.isComplete()) g_modulus_.emplace(g);
    // Turning changes neither norm: the difference of the norms bounds the metric.
    if (f.isComplete() && g.isComplete())
      norm_bound_ = std::abs(std::sqrt(f.squaredNorm()) - std::sqrt(g.squaredNorm()));
  }

  CertifiedMatch run(const RotationRange& range) {
    best_.distance = std::numeric_limits<double>::infinity();
    const double begin = range.center - range.tolerance, end = range.center + range.tolerance;
    constexpr int kFirstArcs = 16;
    double from = begin, at_from = evaluate(begin);
    for (int i = 1; i <= kFirstArcs && range.tolerance > 0.0; ++i) {
      const double to = i == kFirstArcs ? end : begin + (end - begin) * i / kFirstArcs;
      const double at_to = evaluate(to);
      push(from, to, at_from, at_to);
      from = to;
      at_from = at_to;
    }
    best_.lower_bound = best_.distance;
    while (!arcs_.empty()) {
      const Arc arc = arcs_.top();
      best_.lower_bound = std::min(arc.bound, best_.distance);
      if (best_.distance - best_.lower_bound <= params_.tolerance) break;
      const double middle = 0.5 * (arc.begin + arc.end);
      const bool divisible = arc.begin < middle && middle < arc.end;
      if (best_.evaluations >= params_.max_evaluations || !divisible) {
        best_.within_tolerance = false;
        break;
      }
      arcs_.pop();
      const double at_middle = evaluate(middle);
      push(arc.begin, middle, arc.at_begin, at_middle);
      push(middle, arc.end, at_middle, arc.at_end);
    }
    best_.rotation = wrapToTwoPi(best_.rotation);
    return best_;
  }

 private:
  double evaluate(double rotation) {
    ++best_.evaluations;
    const double value = distance(f_, g_, rotation);
    if (value < best_.distance) {
      best_.distance = value;
      best_.rotation = rotation;
    }
    return value;
  }

  void push(double begin, double end, double at_begin, double at_end) {
    const double width = end - begin;
    double change = std::numeric_limits<double>::infinity();
    for (const auto* modulus : {&f_modulus_, &g_modulus_})
      if (*modulus) change = std::min(change, (*modulus)->bound(0.5 * width));
    // Every rotation is within half the width of one end.
    const double by_modulus = std::min(at_begin, at_end) - change;
    const double square = 0.5 * (at_begin * at_begin + at_end * at_end - slope_ * width);
    const double by_slope = std::sqrt(std::max(0.0, square));
    const double bound = std::max({norm_bound_, by_modulus, by_slope});
    arcs_.push({begin, end, at_begin, at_end, bound});
  }

  const PolarFunction& f_;
  const PolarFunction& g_;
  CertificateParams params_;
  double slope_;
  double norm_bound_ = 0.0;
  std::optional<RotationModulus> f_modulus_, g_modulus_;
  std::priority_queue<Arc> arcs_;
  CertifiedMatch best_;
};

}  // namespace

void CertificateParams::check() const {
  requirePositive("tolerance", tolerance);
  if (max_evaluations < 1) throw InvalidParamsError("max_evaluations = 0 must be at least 1");
}

RotationModulus::RotationModulus(const PolarFunction& f) {
  if (!f.isComplete())
    throw InvalidParamsError("a view with unseen directions has no rotation modulus");
  // ||f(. - s) - f|| is at most twice the distance from the constant in the middle of f's range.
  diameter_ = std::sqrt(kTwoPi) * oscillation(f);
  for (const std::size_t n : {8U, 64U, 512U, 4096U}) {
    const auto sectors = sectorRanges(f, n);
    // osc[c]: of f over sector c and the one before, which hold x and x - s for x in c.
    std::vector<double> oscillations(n);
    for (std::size_t c = 0; c < n; ++c) {
      const SectorRange& before = sectors[(c + n - 1) % n];
      oscillations[c] =
          std::max(before.greatest, sectors[c].greatest) - std::min(before.least, sectors[c].least);
    }
    // |f(x - s) - f(x)|^2 <= osc * variation over (x - s, x], integrated over x.
    double slope = 0.0;
    for (std::size_t c = 0; c < n; ++c)
      slope += sectors[c].variation * std::max(oscillations[c], oscillations[(c + 1) % n]);
    levels_.push_back({kTwoPi / static_cast<double>(n), slope});
  }
}

double RotationModulus::bound(double h) const {
  double least = diameter_;
  for (const Level& level : levels_)
    if (h <= level.sector) least = std::min(least, std::sqrt(level.slope * h));
  return least;
}

CertifiedMatch distanceOverRotations(const PolarFunction& f, const PolarFunction& g,
                                     const RotationRange& range, const CertificateParams& params) {
  range.check();
  params.check();
  if (!f.isComplete() && !g.isComplete())
    throw InvalidParamsError(
        "both views are partial: the rotation that leaves them least in common would win");
  return RotationSearch(f, g, params).run(range);
}

}  // namespace mrpt_polyloc
