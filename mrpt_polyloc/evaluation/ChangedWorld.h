#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// In what the world differs from its map: what happens to buildings after they were mapped, and
/// what mapping itself gets wrong.
struct POLYLOC_EXPORT WorldChanges {
  /// Boxes that the map does not have, sides of 0.4 to 1.2 m, anywhere in free space and turned
  /// anyhow: moved furniture. One that would stand nearer to the robot than its clearance is left
  /// out of that scan: someone pushed it away.
  std::size_t boxes = 0;
  /// Probability that an obstacle of the map, a hole of at most 4 m2 whose edges are all walls, is
  /// gone.
  double gone = 0.0;
  /// Each wall (edge of a ring) stands aside of where the map has it, along its normal, by a normal
  /// deviate of this standard deviation, at most three of them [m].
  double wall_shift = 0.0;
  /// One wing, the half of the map beyond the middle of its longer side, is longer and wider than
  /// in the map by this share (negative: shorter), seen from the middle of the map ...
  double wing_scale = 0.0;
  double wing_turn = 0.0;  ///< ... and turned around it by this angle [rad]
  /// Probability that a wall is of glass: a beam is sent back only within 15 degrees of its normal,
  /// and else goes on to what stands behind.
  double glass = 0.0;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// The walls of a world that a map tells of, changed; searched one by one in double, see
/// WallSegments. The same map, changes and seed give the same world.
class POLYLOC_EXPORT ChangedWorld {
 public:
  /// \throws InvalidParamsError; InvalidMapError if boxes are asked for and there is no free space
  ChangedWorld(const PolygonMap& map, const WorldChanges& changes, std::uint64_t seed);

  /// Where a pose of the map is in the world: moved with its wing [m, rad].
  mrpt::math::TPose2D worldPose(const mrpt::math::TPose2D& pose_map) const;

  /// Range [m] from a place in the world along a direction to the first wall or box that sends the
  /// beam back; infinity if there is none. \param clearance boxes nearer to the origin than this
  /// [m] are left out
  double range(const TPoint2D& origin, double direction, double clearance) const;

  /// The same, to the last bit, for many beams: along heading + bearings[i]. Walls are held against
  /// those beams alone that point at them: O(walls log(beams) + walls met).
  /// \param bearings rising, over less than a full circle [rad]
  std::vector<double> ranges(const TPoint2D& origin, double heading,
                             const std::vector<double>& bearings, double clearance) const;

  /// Walls of the world [m], for tests and pictures; boxes not among them.
  std::size_t wallCount() const { return walls_.size(); }
  std::size_t boxCount() const { return boxes_.size(); }

 private:
  struct Wall {
    WallSegment segment;
    bool is_glass = false;
  };
  TPoint2D worldPoint(const TPoint2D& point_map) const;
  double rangeToWall(const Wall& wall, const TPoint2D& origin, const TPoint2D& ray) const;
  double nearestWithBoxes(double nearest_wall, const TPoint2D& origin, const TPoint2D& ray,
                          double clearance) const;

  TPoint2D middle_{0, 0};
  bool wing_is_right_ = true;  ///< beyond the middle in x; else in y
  double wing_scale_ = 1.0;
  double wing_turn_ = 0.0;
  std::vector<Wall> walls_;
  std::vector<std::vector<WallSegment>> boxes_;
};

}  // namespace mrpt_polyloc
