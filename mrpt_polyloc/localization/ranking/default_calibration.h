#pragma once

#include <array>

/// Written by polyloc-calibrate; do not edit.
/// polyloc-calibrate SETS --own 1000000 --cluttered 60 --foreign 40
///   --lost 0.001 --unique-right 0.995 --clutter-weight 0.1, on the sets
///   intel (454 scans)
///   fr079 (299 scans)
///   csail (202 scans)
///   aces (220 scans)
///   gh25_sim (68 scans)
///   malaga_fac (49 scans)
///   locdemo (37 scans)
namespace mrpt_polyloc::default_calibration {

constexpr double kMatchIntercept = -19.12686;
constexpr double kLeastMatchProbability = 0.03716707;
constexpr double kWeightDecay = 5.485084;
constexpr double kUniqueProbability = 0.6347036;
constexpr double kPositionFactor = 1.790487;
constexpr double kHeadingFactor = 1.181889;
/// explained, lead, heading, seen, on_walls
constexpr std::array<double, 5> kMatchWeights = {0.276987, 10.46386, -1.188876, 3.162485, 11.56857};

}  // namespace mrpt_polyloc::default_calibration
