#pragma once

#include <cstddef>

namespace mrpt_polyloc {

/// Maps of more vertices, as they come from a file or a grid, are refused: inspectMap().
constexpr std::size_t kMaxMapVertices = 5'000'000;

}  // namespace mrpt_polyloc
