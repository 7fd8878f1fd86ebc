#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <cstdint>
#include <random>
#include <vector>

namespace mrpt_polyloc::test {

/// A generated building: corridors, each with a row of rooms on both sides, and one corridor
/// across that joins them. Lengths in metres.
struct FloorPlanParams {
  int corridors = 1;
  int rooms_per_side = 4;
  double room_width = 4.0;
  double room_depth = 4.5;
  double corridor_width = 2.0;
  double wall = 0.2;
  double door = 0.9;
  int furniture_per_room = 0;  ///< blocks, some against walls, some standing free as holes
  double unknown_share = 0.0;  ///< of rooms with an unknown patch and a window: open edges
  int crossing_walls = 0;      ///< walls beyond that stand anywhere, across other walls too
  double edge_length = 0.0;    ///< if > 0, borders are cut into pieces of about this length
  double jitter = 0.0;         ///< every border vertex is moved by up to this much (at most 0.02)
  double rotation = 0.0;       ///< of the whole [rad]
  TPoint2D offset{0, 0};       ///< added last
};

/// The same map for the same parameters and seed. Where unknown_share > 0 there are walls beyond
/// inside the unknown patches and outside the windows.
PolygonMap floorPlan(const FloorPlanParams& params, std::uint32_t seed);

/// Floor plans by their size: about 110 vertices and 150 m2, about 1,000 and 1,500 m2 (plain, and
/// with furniture standing in the rooms).
FloorPlanParams smallFlat();
FloorPlanParams largeFloor();
FloorPlanParams furnishedFloor();
/// A floor whose borders look as traced from a noisy grid.
FloorPlanParams noisyFloor();

/// Parameters for a small map with everything in it, all drawn from the generator.
FloorPlanParams randomParams(std::mt19937& random);

/// Points drawn evenly from the free space.
std::vector<TPoint2D> randomFreePoints(const PolygonMap& map, std::size_t count,
                                       std::mt19937& random);

/// Points drawn evenly from the map's box grown by `margin`, free or not.
std::vector<TPoint2D> randomPoints(const PolygonMap& map, double margin, std::size_t count,
                                   std::mt19937& random);

}  // namespace mrpt_polyloc::test
