#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/ranking/Hypothesis.h>
#include <mrpt_polyloc/travel/ClearanceField.h>
#include <mrpt_polyloc/travel/Sight.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

struct POLYLOC_EXPORT SafeSetParams {
  double robot_radius = 0.25;  ///< of a disc that holds the robot however it turns [m]
  /// Kept free beside the robot [m]: what a small robot strays from its way in a metre, and what
  /// ClearanceField rounds.
  double margin = 0.05;
  /// Where there is so much more room beside the robot it drives freely [m]; ways keep to such
  /// places where they can, and through doors the robot goes in short legs.
  double comfort = 0.15;
  /// Added for each hypothesis: so many standard deviations of its position ...
  double deviations = 2.0;
  double most_uncertainty = 0.06;  ///< ... up to here [m], or no door could be passed
  double square = 0.1;             ///< side of the squares that are moved on [m]
  double reach = 40.0;             ///< nothing farther away along the way is looked at [m]
  /// Share of the hypotheses' weight that must call a place free. 1: all of them, the safe set;
  /// 0.5: the majority-rule map of Koenig, Mitchell, Mudgal and Tovey, in which a way may be
  /// planned but not driven beyond what is seen.
  double quorum = 1.0;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// Where a robot that may be at any of several poses can drive, in its own frame: the squares that
/// it reaches through places whose disc of the robot's size is free in the map of every hypothesis
/// (the map moved by its pose), or was seen free by a scan, and in which no scan hit anything.
///
/// Where the robot stands closer to something than its margin, it may leave, not come closer.
class POLYLOC_EXPORT SafeSet {
 public:
  /// \param hypotheses of the robot now; their weights count only where the quorum is below 1
  /// \param sight in the robot's frame
  /// Cost: O(squares reached * (hypotheses + log)).
  SafeSet(const ClearanceField& field, const std::vector<Hypothesis>& hypotheses,
          const Sight& sight, const SafeSetParams& params);

  struct Place {
    TPoint2D point;   ///< in the robot's frame [m]
    double distance;  ///< along squares [m]: up to 8 % more than that of its way
  };

  /// Whether the robot touches nothing where it stands.
  bool isStartFree() const { return is_start_free_; }

  /// One place of each block of squares about so wide [m], the nearest of it; by distance.
  std::vector<Place> places(double spacing) const;
  /// The squares reached; nearest first, where tight places count as farther.
  const std::vector<Place>& reached() const { return reached_; }
  bool isReached(const TPoint2D& point) const;
  /// Whether a place is reached, and has room beside it: SafeSetParams::comfort.
  bool isRoomy(const TPoint2D& point) const;

  /// A way from the robot to a place reached: corners, the first at the robot. Straightened where
  /// the straight line is safe. Empty for a place that is not reached.
  std::vector<TPoint2D> pathTo(const TPoint2D& place) const;

 private:
  struct Square {
    float cost;         ///< of the way to it: metres, tight ones counted several times
    float distance;     ///< [m]
    std::int32_t from;  ///< the square before it on the way
    std::int8_t state;  ///< unknown yet, safe, or not
    bool is_near_hit;   ///< too near to be roomy
  };
  std::size_t index(const TPoint2D& point) const;  ///< squares_.size(): outside
  TPoint2D centre(std::size_t square) const;
  bool isSafe(std::size_t square);
  /// Whether the robot may be there, with so much more room [m].
  bool mayBe(const TPoint2D& point, double room) const;
  void block(const Sight& sight);
  void spread();
  bool isStraightSafe(const TPoint2D& a, const TPoint2D& b) const;

  const ClearanceField* field_;
  const std::vector<Hypothesis>* hypotheses_;
  const Sight* sight_;
  SafeSetParams params_;
  std::size_t side_ = 0;  ///< squares on a side
  double half_ = 0.0;     ///< half a side [m]
  bool is_start_free_ = true;
  double start_hit_ = 0.0;             ///< distance of the nearest hit at the start [m]
  std::vector<double> needed_;         ///< clearance, for each hypothesis [m]
  std::vector<double> needed_nearby_;  ///< the same beside the start
  std::vector<Square> squares_;
  std::vector<Place> reached_;
};

/// Clearance [m] of a place of the robot's frame in the map as a hypothesis has it.
POLYLOC_EXPORT double clearanceAt(const ClearanceField& field,
                                  const mrpt::math::TPose2D& pose_map_robot, const TPoint2D& place);

}  // namespace mrpt_polyloc
