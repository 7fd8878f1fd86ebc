#include "lower_bounds.h"

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace mrpt_polyloc {
namespace {

using Coefficients = std::vector<std::complex<double>>;

void checkComplete(const PolarFunction& f, const PolarFunction& g) {
  if (!f.isComplete() || !g.isComplete())
    throw InvalidParamsError("a view with unseen directions has no lower bound");
}

/// 2 pi Sum_{|j| <= order} |F_j|^2.
double lowSquaredNorm(const Coefficients& f) {
  double sum = 0.0;
  for (std::size_t j = 0; j < f.size(); ++j) sum += (j == 0 ? 1.0 : 2.0) * std::norm(f[j]);
  return kTwoPi * sum;
}

/// C(t) = 2 pi Sum_{|j| <= order} F_j exp(-i j t) conj(G_j), real.
class Correlation {
 public:
  Correlation(const Coefficients& f, const Coefficients& g) {
    for (std::size_t j = 0; j < f.size(); ++j) {
      products_.push_back((j == 0 ? kTwoPi : 2.0 * kTwoPi) * f[j] * std::conj(g[j]));
    }
  }

  double operator()(double t) const {
    const std::complex<double> turn(std::cos(t), -std::sin(t));
    std::complex<double> sum = 0.0;  // Horner's scheme
    for (std::size_t j = products_.size(); j-- > 0;) sum = sum * turn + products_[j];
    return sum.real();
  }

  /// At least its maximum over the range.
  double maximumBound(const RotationRange& range) const {
    if (products_.size() == 1) return products_[0].real();
    const auto order = static_cast<double>(products_.size() - 1);
    constexpr double kPerPeriod = 16.0;
    const double tolerance = std::min(range.tolerance, kPi);
    const auto steps = static_cast<int>(std::ceil(2.0 * tolerance * order * kPerPeriod / kTwoPi));
    const double half = steps > 0 ? tolerance / steps : 0.0;  // of the spacing
    double greatest = (*this)(range.center - tolerance);
    for (int i = 1; i <= steps; ++i) {
      greatest = std::max(greatest, (*this)(range.center - tolerance + 2.0 * half * i));
    }
    double norm = 0.0;  // of C, at least its greatest magnitude
    for (const auto& product : products_) norm += std::abs(product);
    return greatest + 0.5 * half * half * order * order * norm;
  }

 private:
  Coefficients products_;  // of exp(-i j t); their real parts sum up to C
};

/// Integral of a piece between two directions within it.
double integralOf(const PolarFunction::Piece& piece, double from, double to) {
  if (piece.kind == PolarFunction::PieceKind::arc) return piece.distance * (to - from);
  const auto antiderivative = [&](double phi) {
    const double x = std::cos(phi), y = std::sin(phi);
    const double cosine = std::max(piece.normal.x * x + piece.normal.y * y, piece.least_cosine);
    return std::asinh((piece.normal.x * y - piece.normal.y * x) / cosine);
  };
  return piece.distance * (antiderivative(to) - antiderivative(from));
}

/// Integrals over equal bins.
std::vector<double> binIntegrals(const PolarFunction& f, std::size_t bins) {
  std::vector<double> integrals(bins);
  const double width = kTwoPi / static_cast<double>(bins);
  std::size_t bin = 0;
  for (const PolarFunction::Piece& piece : f.pieces()) {
    for (double from = piece.begin; from < piece.end;) {
      const double border = bin + 1 < bins ? width * static_cast<double>(bin + 1) : kTwoPi;
      const double to = std::min(piece.end, border);
      if (to > from) integrals[bin] += integralOf(piece, from, to);
      from = std::max(from, to);
      if (to == border && bin + 1 < bins) ++bin;
    }
  }
  return integrals;
}

}  // namespace

double normBound(const PolarFunction& f, const PolarFunction& g) {
  checkComplete(f, g);
  return std::abs(std::sqrt(f.squaredNorm()) - std::sqrt(g.squaredNorm()));
}

double meanBound(const PolarFunction& f, const PolarFunction& g) {
  return binMeansBound(f, g, 1);
}

double lowPassBound(const PolarFunction& f, const PolarFunction& g, std::size_t order,
                    const RotationRange& range) {
  checkComplete(f, g);
  range.check();
  const Coefficients f_low = f.fourierCoefficients(order), g_low = g.fourierCoefficients(order);
  const double f_norm = lowSquaredNorm(f_low), g_norm = lowSquaredNorm(g_low);
  const double low = f_norm + g_norm - 2.0 * Correlation(f_low, g_low).maximumBound(range);
  const double rest = std::sqrt(std::max(0.0, f.squaredNorm() - f_norm)) -
                      std::sqrt(std::max(0.0, g.squaredNorm() - g_norm));
  return std::sqrt(std::max(0.0, low) + rest * rest);
}

double binMeansBound(const PolarFunction& f, const PolarFunction& g, std::size_t bins) {
  checkComplete(f, g);
  if (bins == 0) throw InvalidParamsError("bins = 0 must be at least 1");
  const std::vector<double> f_bins = binIntegrals(f, bins), g_bins = binIntegrals(g, bins);
  double sum = 0.0;
  for (std::size_t b = 0; b < bins; ++b) {
    sum += (f_bins[b] - g_bins[b]) * (f_bins[b] - g_bins[b]);
  }
  // Of a bin of width w: w ((integral f - integral g) / w)^2.
  return std::sqrt(sum * static_cast<double>(bins) / kTwoPi);
}

}  // namespace mrpt_polyloc
