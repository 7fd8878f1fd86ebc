#pragma once

#include <mrpt_polyloc/geometry/validation.h>

#include <cstddef>

namespace mrpt_polyloc {

/// Maps of more vertices, as they come from a file or a grid, are refused: inspectMap().
constexpr std::size_t kMaxMapVertices = 5'000'000;

/// Of all rings and walls beyond.
std::size_t vertexCount(const RawMap& raw);

}  // namespace mrpt_polyloc
