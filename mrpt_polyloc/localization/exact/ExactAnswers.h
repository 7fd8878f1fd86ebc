#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// All poses from which exactly a given polygon is seen.
struct ExactAnswers {
  std::vector<mrpt::math::TPose2D> poses;  ///< of the robot in the map, by x, y and heading
  std::size_t positions = 0;  ///< embeddings of skeleton classes that were looked at, if any were
  std::size_t evaluated = 0;  ///< views computed and compared
};

}  // namespace mrpt_polyloc
