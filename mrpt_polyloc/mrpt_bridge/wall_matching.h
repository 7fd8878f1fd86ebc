#pragma once

#include <mrpt_polyloc/geometry/NearestWalls.h>

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/tfest/TMatchingPair.h>

namespace mrpt_polyloc {

/// Pairs the points of another map with the nearest points of walls, as ICP asks for. Walls stand
/// upright: heights do not count, and the point on the wall has the height of its partner. At most
/// one pair a point, so `onlyKeepTheClosest` and `onlyUniqueRobust` hold by themselves, if two
/// points may share a wall.
/// \param other_pose of the other map in this one
/// \throws std::invalid_argument if the other map is not a points map
void matchWalls(const NearestWalls& walls, const mrpt::maps::CMetricMap& other,
                const mrpt::poses::CPose3D& other_pose, const mrpt::maps::TMatchingParams& params,
                mrpt::tfest::TMatchingPairList& pairs, mrpt::maps::TMatchingExtraResults& results);

/// The share of the points of another map, in [0, 1], that are within a distance [m] of a wall; 0
/// if it has none. \throws std::invalid_argument if the other map is not a points map
float wallMatchingRatio(const NearestWalls& walls, const mrpt::maps::CMetricMap& other,
                        const mrpt::poses::CPose3D& other_pose, double distance);

}  // namespace mrpt_polyloc
