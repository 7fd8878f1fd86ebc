#include "TravelOptions.h"

#include "../common/map_input.h"
#include "../common/parsing.h"
#include "../common/scan_input.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/number_text.h>

#include <sstream>
#include <vector>

namespace mrpt_polyloc::apps {
namespace {

/// `A,B,C`: three finite numbers. \throws UsageError
std::vector<double> threeNumbers(const std::string& option, const std::string& text,
                                 const std::string& meaning) {
  std::vector<double> numbers;
  std::istringstream in(text + ",");
  for (std::string part; std::getline(in, part, ',');) {
    const std::optional<double> number = parseNumber(part);
    if (!number) numbers.resize(4);  // a wrong count
    if (number) numbers.push_back(*number);
  }
  if (numbers.size() != 3) throw UsageError(option + ": '" + text + "' is not " + meaning);
  return numbers;
}

void addLaserOptions(CLI::App& cli, TravelOptions& options) {
  addCount(cli, "--beams", options.beams, 1, 100'000, "Beams of a scan [default: 360]")
      ->type_name("N");
  addNumber(cli, "--fov", options.fov_deg, {0.0, 360.0, true}, "Field of view [default: 360]")
      ->type_name("DEG");
  addNumber(cli, "--sigma", options.laser.sigma, {0.0},
            "Standard deviation of a range [default: 0.03]")
      ->type_name("M");
  addNumber(
      cli, "--max-range",
      [&options](double metres) {
        options.laser.max_range = options.planner.max_range = metres;
        options.file.readings.max_range = metres;
      },
      {0.0, 1e6, true}, "Greatest range of the laser [default: 20; --plan: what the log tells]")
      ->type_name("M");
  addNumber(cli, "--dropout", options.laser.dropout, {0.0, 1.0},
            "Probability that a beam becomes a no-return [default: 0]")
      ->type_name("P");
  addNumber(cli, "--short", options.laser.short_beams, {0.0, 1.0},
            "Probability that a beam is cut to a random shorter range [default: 0]")
      ->type_name("P");
  addCount(cli, "--occluders", options.occluders, 0, 1000,
           "People in front of the robot, elsewhere in each scan [default: 0]")
      ->type_name("N");
  addCount(cli, "--clutter", options.clutter, 0, 10'000,
           "Boxes that the map does not have: they stop beams and the robot [default: 0]")
      ->type_name("N");
}

void addRobotOptions(CLI::App& cli, TravelOptions& options) {
  addNumber(cli, "--robot-radius", options.planner.safe.robot_radius, {0.0, 10.0, true},
            "Of a disc that holds the robot however it turns [default: 0.25]")
      ->type_name("M");
  cli.add_option_function<std::string>(
         "--odometry-noise",
         [&options](const std::string& text) {
           const std::vector<double> noise = threeNumbers(
               "--odometry-noise", text, "A,B,C: metres a metre, degrees a metre and a radian");
           options.run.odometry = {noise[0], toRadians(noise[1]), toRadians(noise[2])};
           try {
             options.run.odometry.check();
           } catch (const std::invalid_argument& error) {
             throw UsageError(std::string("--odometry-noise: ") + error.what());
           }
         },
         "Standard deviations: metres a metre, degrees a metre, degrees a radian "
         "[default: 0.02,1,2]")
      ->type_name("A,B,C");
  addNumber(cli, "--max-travel", options.run.most_travel, {0.0, 1e5},
            "A robot that has driven so far gives up [default: 100]")
      ->type_name("M");
  cli.add_option_function<std::string>(
         "--strategy",
         [&options](const std::string& name) {
           const std::optional<TravelStrategy> strategy = travelStrategyFrom(name);
           if (!strategy) {
             throw UsageError("--strategy: '" + name +
                              "' is none of greedy, nearest, majority, random");
           }
           options.planner.strategy = *strategy;
         },
         "greedy, nearest, majority or random [default: greedy]")
      ->type_name("NAME");
}

}  // namespace

void addOptions(CLI::App& cli, TravelOptions& options) {
  addText(cli, "--map", options.map, kMapFormats)->required()->type_name("MAP");
  addScaleOption(cli, options.scale);
  cli.add_option_function<std::string>(
         "--start",
         [&options](const std::string& text) {
           const std::vector<double> pose =
               threeNumbers("--start", text, "X,Y,DEG: a pose in metres and degrees");
           options.start = mrpt::math::TPose2D(pose[0], pose[1], toRadians(pose[2]));
         },
         "One robot, from there")
      ->type_name("X,Y,DEG");
  addCount(cli, "-n", options.count, 1, 1'000'000, "So many robots, from random places")
      ->type_name("N");
  addCount(cli, "--seed", options.seed, 0, UINT64_MAX,
           "The same seed gives the same runs [default: 1]")
      ->type_name("S");
  addLaserOptions(cli, options);
  addRobotOptions(cli, options);
  addText(cli, "--svg", options.svg, "Draw the last run, or the plan")->type_name("PIC.svg");
  addText(cli, "-o", options.folder, "Folder for summary.json and runs.csv")->type_name("DIR");
  cli.add_flag("--plan", options.plans,
               "For a real robot: where to drive next, as JSON on standard output");
  addText(cli, "--scans", options.scans,
          "With --plan: log of the robot's scans, the last one taken now; with its odometry the "
          "whole drive counts")
      ->type_name("FILE");
  addText(cli, "--sensor", options.file.sensor_label, "Only scans of the sensor of this label")
      ->type_name("LABEL");
}

void finishOptions(TravelOptions& options) {
  options.laser.beams = options.beams;
  options.laser.occluders = options.occluders;
  options.laser.fov = toRadians(options.fov_deg);
  if (options.plans) {
    if (options.scans.empty()) throw UsageError("--plan needs --scans");
    if (options.start || options.count > 0 || !options.folder.empty()) {
      throw UsageError("--plan is of a real robot: it does not go with --start, -n or -o");
    }
    return;
  }
  if (!options.scans.empty()) throw UsageError("--scans goes with --plan alone");
  if (options.start.has_value() == (options.count > 0)) {
    throw UsageError("either --start or -n is needed");
  }
  if (options.folder.empty()) throw UsageError("-o is needed");
  // The simulated laser is known to the robot.
  options.planner.max_range = options.laser.max_range;
}

}  // namespace mrpt_polyloc::apps
