#pragma once

#include <mrpt_polyloc/base/export.h>

#include <optional>

namespace mrpt_polyloc {

/// What is known of the robot's pose before the search; empty means nothing.
struct POLYLOC_EXPORT PosePrior {
  struct Compass {
    double heading;    ///< of the robot in the map [rad]
    double tolerance;  ///< greatest error of it [rad], in [0, pi]
  };
  struct Disk {
    double x, y;    ///< of the ROBOT in the map [m]
    double radius;  ///< [m]
  };
  std::optional<Compass> compass;
  std::optional<Disk> near;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

}  // namespace mrpt_polyloc
