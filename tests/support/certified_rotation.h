#pragma once

#include <mrpt_polyloc/polar/PolarFunction.h>
#include <mrpt_polyloc/polar/RotationRange.h>

#include <cstddef>
#include <vector>

/// The exact metric without a compass, with a proof: what the sampled one and its bounds are held
/// against. No program needs it, so it is not in the library.
namespace mrpt_polyloc {

/// How closely a minimum over rotations is to be certified.
struct CertificateParams {
  /// Greatest difference between the distance found and the lower bound [m rad^(1/2)]. A
  /// centimetre all around makes 0.025.
  double tolerance = 0.01;
  /// Integrals computed at most. Where it ends the search, the bound is what is proved so far.
  std::size_t max_evaluations = 100000;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// A minimum over rotations and the proof of it: the true minimum is in [lower_bound, distance],
/// up to rounding.
struct CertifiedMatch {
  double distance = 0.0;     ///< when f is turned by `rotation` [m rad^(1/2)]
  double rotation = 0.0;     ///< f turned counterclockwise by this fits g best [rad], [0, 2 pi)
  double lower_bound = 0.0;  ///< for all rotations in the range [m rad^(1/2)]
  std::size_t evaluations = 0;
  bool within_tolerance = true;  ///< false if max_evaluations ended the search
};

/// The polar coordinate metric without a compass: the least distance(f, g, rotation), by branch and
/// bound over the rotations of `range`, with a certificate.
///
/// Bounds on an interval of rotations: the metric changes by at most ||g(. + h) - g|| when turning
/// by h, which is bounded from the variation of g in small sectors (and likewise f), and its square
/// changes by at most h TV(f) (max g - min g). One of the views must be complete; a partial one is
/// compared where it sees.
/// \throws InvalidParamsError if both views are partial, or range or params are bad.
/// O((p + q) evaluations).
CertifiedMatch distanceOverRotations(const PolarFunction& f, const PolarFunction& g,
                                     const RotationRange& range = {},
                                     const CertificateParams& params = {});

/// An upper bound of ||f(. - s) - f|| over all |s| <= h, that shrinks like h^(1/2) (like h where f
/// does not jump): the modulus of continuity of f under rotation.
class RotationModulus {
 public:
  /// \throws InvalidParamsError if f is partial. O(pieces + 4681).
  explicit RotationModulus(const PolarFunction& f);

  /// [m rad^(1/2)], for h >= 0.
  double bound(double h) const;

 private:
  struct Level {
    double sector;  // valid for h up to this
    double slope;   // bound^2 <= slope h
  };
  std::vector<Level> levels_;
  double diameter_;  // no rotation changes f by more
};

}  // namespace mrpt_polyloc
