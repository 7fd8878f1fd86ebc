#include <mrpt_polyloc/base/matrices.h>
#include <mrpt_polyloc/localization/ranking/WheelDoubt.h>

#include <Eigen/Dense>

#include <cmath>

namespace mrpt_polyloc {
namespace {

/// -ln of the likelihood of what the movements are off by, constants left out.
double againstScale(const std::vector<MovementError>& movements, double scale) {
  constexpr double kFreedom = 3.0;
  double against = kFreedom * std::log(scale);  // of the movement that was as the wheels said
  for (const MovementError& movement : movements) {
    const Eigen::Matrix3d covariance =
        scale * scale * toEigen(movement.wheels) + toEigen(movement.scans);
    const Eigen::LLT<Eigen::Matrix3d> factor(covariance);
    const Eigen::Vector3d off(movement.off.data());
    against += factor.matrixLLT().diagonal().array().log().sum();  // half of ln det
    against += 0.5 * off.dot(factor.solve(off));
  }
  return against;
}

}  // namespace

WheelDoubt doubtWheels(const std::vector<MovementError>& movements) {
  constexpr double kMost = 100.0, kFiner = 1.1;  // nobody needs it to more than ten percent
  WheelDoubt doubt{1.0, againstScale(movements, 1.0)};
  for (double scale = kFiner; scale < kMost && !movements.empty(); scale *= kFiner) {
    const double against = againstScale(movements, scale);
    if (against < doubt.against) doubt = {scale, against};
  }
  return doubt;
}

}  // namespace mrpt_polyloc
