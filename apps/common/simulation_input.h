#pragma once

#include "Cli.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/evaluation/Simulator.h>

#include <cstdint>

namespace mrpt_polyloc::apps {

/// What polyloc-simulate and the simulated sets of polyloc-eval ask for.
struct SimulationInput {
  std::uint64_t count = 0;
  std::uint64_t seed = 0;
  std::uint64_t beams = SimulatorParams{}.beams;
  std::uint64_t occluders = 0;
  std::uint64_t boxes = 0;
  double fov_deg = 360.0;
  double wing_turn_deg = 0.0;
  SimulatorParams others;  ///< all but the above

  SimulatorParams params() const;
};

/// Adds -n, --seed, and all that says how scans are simulated.
void addSimulationOptions(CLI::App& cli, SimulationInput& input);

}  // namespace mrpt_polyloc::apps
