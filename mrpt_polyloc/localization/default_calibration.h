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

constexpr double kMatchIntercept = -14.84391;
constexpr double kLeastMatchProbability = 0.01519767;
constexpr double kWeightDecay = 4.612698;
constexpr double kUniqueProbability = 0.7155625;
constexpr double kPositionFactor = 1.786568;
constexpr double kHeadingFactor = 1.18257;
/// explained, lead, heading, seen
constexpr std::array<double, 4> kMatchWeights = {6.345567, 11.99969, -1.163249, 3.569302};

}  // namespace mrpt_polyloc::default_calibration
