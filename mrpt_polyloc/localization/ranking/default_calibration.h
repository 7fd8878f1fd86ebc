#pragma once

#include <array>

// clang-format off
/// Written by polyloc-calibrate; do not edit.
/// polyloc-calibrate SETS --own 1000000 --cluttered 60 --foreign 40
///   --lost 0.001 --unique-right 0.994 --foreign-unique 0.003 --clutter-weight 0.1
/// on the sets
///   intel (454 scans)
///   intel/2 (454 scans)
///   intel/4 (454 scans)
///   fr079 (299 scans)
///   fr079/2 (299 scans)
///   fr079/4 (299 scans)
///   csail (202 scans)
///   csail/2 (202 scans)
///   csail/4 (202 scans)
///   aces (220 scans)
///   aces/2 (220 scans)
///   aces/4 (220 scans)
///   gh25_sim (68 scans)
///   malaga_fac (49 scans)
///   locdemo (37 scans)
///   office3/180/office3.wkt (150 scans)
///   office3/180/office3-0.05.yaml (150 scans)
///   office3/180/office3-0.1.yaml (150 scans)
///   office3/180/office3-0.2.yaml (150 scans)
///   office3/360/office3.wkt (150 scans)
///   office3/360/office3-0.05.yaml (150 scans)
///   office3/360/office3-0.1.yaml (150 scans)
///   office3/360/office3-0.2.yaml (150 scans)
///   office5/180/office5.wkt (150 scans)
///   office5/180/office5-0.05.yaml (150 scans)
///   office5/180/office5-0.1.yaml (150 scans)
///   office5/180/office5-0.2.yaml (150 scans)
///   office5/360/office5.wkt (150 scans)
///   office5/360/office5-0.05.yaml (150 scans)
///   office5/360/office5-0.1.yaml (150 scans)
///   office5/360/office5-0.2.yaml (150 scans)
///   office8/180/office8.wkt (150 scans)
///   office8/180/office8-0.05.yaml (150 scans)
///   office8/180/office8-0.1.yaml (150 scans)
///   office8/180/office8-0.2.yaml (150 scans)
///   office8/360/office8.wkt (150 scans)
///   office8/360/office8-0.05.yaml (150 scans)
///   office8/360/office8-0.1.yaml (150 scans)
///   office8/360/office8-0.2.yaml (150 scans)
namespace mrpt_polyloc::default_calibration {

constexpr double kMatchIntercept = -20.82632;
constexpr double kLeastMatchProbability = 0.04130132;
constexpr double kWeightDecay = 9.334537;
constexpr double kUniqueProbability = 0.9298051;
constexpr double kPositionFactor = 1.790434;
constexpr double kHeadingFactor = 1.178409;
/// explained, lead, heading, seen, on_walls
constexpr std::array<double, 5> kMatchWeights = {1.228101, 10.6242, -1.292114, 3.643382, 11.14023};
/// of kLostShares
constexpr std::array<double, 8> kLostThresholds = {2.838163e-05, 0.04130132, 0.07736818, 0.1971761, 0.3913548, 0.5241123, 0.6291104, 0.7631415};

}  // namespace mrpt_polyloc::default_calibration
