#pragma once

#include <array>

/// Written by polyloc-calibrate; do not edit.
/// polyloc-calibrate SETS --own 1000000 --cluttered 60 --foreign 40
///   --lost 0.003 --unique-right 0.995 --clutter-weight 0.1, on the sets
///   intel (454 scans)
///   fr079 (299 scans)
///   csail (202 scans)
///   aces (220 scans)
///   gh25_sim (68 scans)
///   malaga_fac (49 scans)
///   locdemo (37 scans)
namespace mrpt_polyloc::default_calibration {

constexpr double kMatchIntercept = -15.44549;
constexpr double kLeastMatchProbability = 0.01652169;
constexpr double kWeightDecay = 4.840728;
constexpr double kUniqueProbability = 0.6227145;
constexpr double kPositionFactor = 1.780324;
constexpr double kHeadingFactor = 1.173026;
/// explained, lead, heading, seen, on_walls
constexpr std::array<double, 5> kMatchWeights = {6.54571, 11.23423, -1.255878, 3.657063, 0.0};

}  // namespace mrpt_polyloc::default_calibration
