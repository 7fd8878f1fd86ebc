#pragma once

#include <Eigen/Core>
#include <mrpt/math/CMatrixFixed.h>

namespace mrpt_polyloc {

/// A matrix of MRPT's for Eigen to compute with, and back.
inline Eigen::Matrix3d toEigen(const mrpt::math::CMatrixDouble33& matrix) {
  Eigen::Matrix3d result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) result(row, column) = matrix(row, column);
  }
  return result;
}
inline mrpt::math::CMatrixDouble33 fromEigen(const Eigen::Matrix3d& matrix) {
  mrpt::math::CMatrixDouble33 result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) result(row, column) = matrix(row, column);
  }
  return result;
}

}  // namespace mrpt_polyloc
