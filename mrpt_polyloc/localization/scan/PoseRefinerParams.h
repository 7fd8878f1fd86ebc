#pragma once

#include <mrpt_polyloc/base/export.h>

namespace mrpt_polyloc {

struct POLYLOC_EXPORT PoseRefinerParams {
  int max_iterations = 12;
  double step_tolerance = 1e-4;  ///< ends when a step is shorter than this [m] ...
  double turn_tolerance = 1e-4;  ///< ... and turns by less than this [rad]
  /// Residuals count fully up to about this distance and hardly beyond its double (Cauchy's
  /// weights) [m]: a few cells of a grid map, less than the depth of furniture.
  double residual_scale = 0.1;
  /// Beams that miss the predicted line by more than this take no part [m].
  double gate = 0.8;
  /// Standard deviation of a hit's distance to its wall, sensor and map together [m].
  double sigma = 0.05;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

}  // namespace mrpt_polyloc
