#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>

#include <vector>

namespace mrpt_polyloc {

/// How near two scans must be to say the same. What speaks for one pose against another changes
/// with the place: over a distance d the correlation falls as exp(-d / distance), a turn counting
/// as `distance` metres for each `angle`.
struct POLYLOC_EXPORT ScanCorrelation {
  /// [m]; fitted on short drives of four real sets (see doc/localization.md): maps are off by the
  /// same for scans metres apart.
  double distance = 2.0;
  double angle = 0.7853981633974483;  ///< [rad], 45 degrees

  /// \throws InvalidParamsError naming the bad field.
  void check() const;

  /// Of two scans with this movement between them, in [0, 1].
  double between(const Motion& motion) const;
  /// What a scan adds to the number of independent ones, if the last one before it is this far
  /// away, in [0, 1]: tanh(d / (2 distance)), the same as MomentWeights of a long straight drive.
  double gain(const Motion& motion) const;
};

/// How much the moments of a scan set count. With C the correlations of the moments the best
/// weights of a mean are C^-1 1, and the variance of that mean is that of one moment divided by
/// 1' C^-1 1 (Gauss-Markov): the number of independent moments, 1 for a robot that stands still
/// however often it looks.
struct POLYLOC_EXPORT MomentWeights {
  MomentWeights(const ScanSet& set, const ScanCorrelation& correlation);

  std::vector<double> weights;                    ///< not negative, sum 1
  std::vector<std::vector<double>> correlations;  ///< C
  double independent = 1.0;                       ///< moments
};

}  // namespace mrpt_polyloc
