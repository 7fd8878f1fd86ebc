#pragma once

#include <array>

/// Written by polyloc-calibrate; do not edit.
/// polyloc-calibrate SETS --own 1000000 --cluttered 60 --foreign 40
///   --lost 0.005 --unique-right 0.995 --clutter-weight 0.1, on the sets
///   intel (454 scans)
///   fr079 (299 scans)
///   csail (202 scans)
///   aces (220 scans)
///   gh25_sim (68 scans)
///   malaga_fac (49 scans)
///   locdemo (37 scans)
namespace mrpt_polyloc::default_calibration {

constexpr double kMatchIntercept = -15.52541;
constexpr double kLeastMatchProbability = 0.1301946;
constexpr double kWeightDecay = 4.450008;
constexpr double kUniqueProbability = 0.9394047;
constexpr double kPositionFactor = 1.779973;
constexpr double kHeadingFactor = 1.186275;
/// explained, lead, heading, seen
constexpr std::array<double, 4> kMatchWeights = {6.658213, 10.69987, -1.216751, 3.892782};

}  // namespace mrpt_polyloc::default_calibration
