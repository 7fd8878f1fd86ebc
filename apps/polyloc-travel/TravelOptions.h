#pragma once

#include "../common/Cli.h"
#include "TravelRun.h"
#include <mrpt_polyloc/evaluation/Simulator.h>
#include <mrpt_polyloc/io/scan_files.h>
#include <mrpt_polyloc/travel/TravelPlannerParams.h>

#include <cstdint>
#include <optional>
#include <string>

namespace mrpt_polyloc::apps {

struct TravelOptions {
  std::string map;
  double scale = 1.0;  ///< metres per unit of the map's file
  std::optional<mrpt::math::TPose2D> start;
  std::uint64_t count = 0;
  std::uint64_t seed = 1;
  std::uint64_t beams = SimulatorParams{}.beams;
  std::uint64_t occluders = 0;
  std::uint64_t clutter = 0;
  double fov_deg = 360.0;
  SimulatorParams laser;
  TravelRunParams run;
  TravelPlannerParams planner;
  std::string folder;
  std::string svg;
  bool plans = false;  ///< for a real robot
  std::string scans;
  ScanFileOptions file;
};

void addOptions(CLI::App& cli, TravelOptions& options);

/// What one option alone cannot tell. \throws UsageError
void finishOptions(TravelOptions& options);

}  // namespace mrpt_polyloc::apps
