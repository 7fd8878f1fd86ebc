#pragma once

#include <array>
#include <cstddef>

namespace mrpt_polyloc {

/// What tells, of the best answer, a scan that was taken in the map from one of another building.
/// All are shares or logarithms that do not depend on how many beams a sensor has.
struct MatchFeatures {
  static constexpr std::size_t kCount = 5;
  static constexpr std::array<const char*, kCount> kNames = {"explained", "lead", "heading", "seen",
                                                             "on_walls"};

  /// Share of the hits that lie within 0.2 m of where the map predicts them, along the beam.
  double explained = 0.0;
  /// ln of the second best cost over the best (0.02 m added to both), at most 1: another building
  /// has many poses that are about as bad. Without a second, one of 0.2 m stands for it.
  double lead = 0.0;
  /// ln of the heading's standard deviation [rad] as the refinement gives it, every sector of ten
  /// degrees taken as one observation: a chance fit is held by few walls.
  double heading = 0.0;
  /// Of the view that the map predicts, as far as the longest reading reaches, the share that the
  /// beams really saw: the sum of the ranges over the sum of the predicted ones.
  double seen = 0.0;
  /// How near the points lie to walls of any kind (BeamEvidence::nearness()).
  double on_walls = 0.0;

  /// In the order of kNames.
  std::array<double, kCount> values() const { return {explained, lead, heading, seen, on_walls}; }
};

}  // namespace mrpt_polyloc
