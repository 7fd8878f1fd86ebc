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

constexpr double kMatchIntercept = -20.18455;
constexpr double kLeastMatchProbability = 0.04895297;
constexpr double kWeightDecay = 8.508405;
constexpr double kUniqueProbability = 0.9154947;
constexpr double kPositionFactor = 1.727113;
constexpr double kHeadingFactor = 1.179686;
/// explained, lead, heading, seen, on_walls
constexpr std::array<double, 5> kMatchWeights = {0.7423029, 10.62254, -1.220501, 4.096399, 10.65564};
/// of kLostShares
constexpr std::array<double, 8> kLostThresholds = {5.230246e-05, 0.04895297, 0.1125124, 0.2621482, 0.376029, 0.5362039, 0.6458777, 0.7643518};

}  // namespace mrpt_polyloc::default_calibration
