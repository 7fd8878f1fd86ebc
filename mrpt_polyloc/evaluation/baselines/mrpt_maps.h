#pragma once

#include <mrpt_polyloc/geometry/OccupancyBitmap.h>

#include <mrpt/maps/COccupancyGridMap2D.h>

namespace mrpt_polyloc {

/// A bitmap as MRPT's occupancy grid, in the bitmap's own frame (its lower left corner is the
/// origin), with the likelihood field as its likelihood. \param sigma LF_stdHit [m]; hits farther
/// than three of it from walls are all alike
/// \throws InvalidMapError if nothing is occupied
mrpt::maps::COccupancyGridMap2D gridOf(const OccupancyBitmap& bitmap, double sigma);

}  // namespace mrpt_polyloc
