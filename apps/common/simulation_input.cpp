#include "simulation_input.h"

namespace mrpt_polyloc::apps {
namespace {

void addSensorOptions(CLI::App& cli, SimulationInput& input) {
  addCount(cli, "--beams", input.beams, 1, 100'000, "Beams of a scan [default: 360]")
      ->type_name("N");
  addNumber(cli, "--fov", input.fov_deg, {0.0, 360.0, true},
            "Field of view; 360: the first direction is not repeated [default: 360]")
      ->type_name("DEG");
  addNumber(cli, "--sigma", input.others.sigma, {0.0},
            "Standard deviation of a range [default: 0.03]")
      ->type_name("M");
  addNumber(cli, "--max-range", input.others.max_range, {0.0, 1e6, true},
            "Greatest range; nothing met within it: a no-return [default: 20]")
      ->type_name("M");
  addNumber(cli, "--dropout", input.others.dropout, {0.0, 1.0},
            "Probability that a beam becomes a no-return [default: 0]")
      ->type_name("P");
  addNumber(cli, "--short", input.others.short_beams, {0.0, 1.0},
            "Probability that a beam is cut to a random shorter range [default: 0]")
      ->type_name("P");
  addCount(cli, "--occluders", input.occluders, 0, 1000,
           "Objects in front of the robot, each 8 to 19 degrees wide [default: 0]")
      ->type_name("N");
  addNumber(cli, "--clearance", input.others.clearance, {0.0},
            "Least distance of the robot's centre to a wall [default: 0.3]")
      ->type_name("M");
}

void addWorldOptions(CLI::App& cli, SimulationInput& input) {
  WorldChanges& world = input.others.world;
  addCount(cli, "--boxes", input.boxes, 0, 100'000,
           "Boxes of 0.4 to 1.2 m in the world that the map does not have [default: 0]")
      ->type_name("N");
  addNumber(cli, "--gone", world.gone, {0.0, 1.0},
            "Probability that an obstacle of the map of at most 4 m2 is gone [default: 0]")
      ->type_name("P");
  addNumber(cli, "--wall-shift", world.wall_shift, {0.0, 10.0},
            "Standard deviation by which each wall stands aside of the map's [default: 0]")
      ->type_name("M");
  addNumber(cli, "--wing-scale", world.wing_scale, {-0.5, 0.5},
            "One half of the world is larger than the map by this share [default: 0]")
      ->type_name("SHARE");
  addNumber(cli, "--wing-turn", input.wing_turn_deg, {-90.0, 90.0},
            "One half of the world is turned around the middle [default: 0]")
      ->type_name("DEG");
  addNumber(cli, "--glass", world.glass, {0.0, 1.0},
            "Probability that a wall is of glass, seen only straight on [default: 0]")
      ->type_name("P");
}

}  // namespace

SimulatorParams SimulationInput::params() const {
  SimulatorParams params = others;
  params.beams = beams;
  params.occluders = occluders;
  params.fov = toRadians(fov_deg);
  params.world.boxes = boxes;
  params.world.wing_turn = toRadians(wing_turn_deg);
  return params;
}

void addSimulationOptions(CLI::App& cli, SimulationInput& input) {
  addCount(cli, "-n", input.count, 1, 1'000'000, "Number of scans")->required()->type_name("N");
  addCount(cli, "--seed", input.seed, 0, UINT64_MAX, "The same seed gives the same scans")
      ->required()
      ->type_name("S");
  addSensorOptions(cli, input);
  addWorldOptions(cli, input);
}

}  // namespace mrpt_polyloc::apps
