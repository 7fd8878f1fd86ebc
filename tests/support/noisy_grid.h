#pragma once

#include <mrpt_polyloc/geometry/OccupancyBitmap.h>

#include <cstdint>

namespace mrpt_polyloc::test {

/// A synthetic occupancy grid as a robot would leave it, cells of 0.05 m: rooms with doors in an
/// unknown surrounding, a part of them turned by a slant, furniture, ragged walls, occupied specks
/// and unknown patches. Seeded.
OccupancyBitmap noisyGrid(int width, int height, std::uint32_t seed);

}  // namespace mrpt_polyloc::test
