#include "particle_filter_ini.h"

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/number_text.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc::apps {

std::string particleFilterIni(const Hypothesis& hypothesis) {
  const auto half = [&](int i, double least) {
    return std::max(3.0 * std::sqrt(hypothesis.covariance(i, i)), least);
  };
  const auto& pose = hypothesis.pose_map_robot;
  const double dx = half(0, 0.25), dy = half(1, 0.25);
  const double phi = toDegrees(pose.phi);
  const double dphi = std::min(toDegrees(half(2, toRadians(5.0))), 180.0);
  return formatted(
      "# Start of the particles, found by polyloc-localize: robot at (%.3f, %.3f), %.2f deg.\n"
      "[LocalizationExperiment]\n"
      "# 1: uniform over the box, whatever the map\n"
      "init_PDF_mode=1\n"
      "init_PDF_min_x=%.4f\n"
      "init_PDF_max_x=%.4f\n"
      "init_PDF_min_y=%.4f\n"
      "init_PDF_max_y=%.4f\n"
      "init_PDF_min_yaw_deg=%.3f\n"
      "init_PDF_max_yaw_deg=%.3f\n",
      pose.x, pose.y, phi, pose.x - dx, pose.x + dx, pose.y - dy, pose.y + dy, phi - dphi,
      phi + dphi);
}

}  // namespace mrpt_polyloc::apps
