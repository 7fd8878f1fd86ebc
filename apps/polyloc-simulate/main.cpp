// polyloc-simulate: scans at random poses in a map, with truth. See README.md beside this file.

#include "../common/Cli.h"
#include "../common/OutputFiles.h"
#include "../common/map_input.h"
#include "../common/parsing.h"
#include "../common/simulation_input.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/DriveSimulator.h>
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/io/rawlog_writer.h>

#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace mrpt_polyloc;
using namespace mrpt_polyloc::apps;

struct Options {
  std::string map;
  double scale = 1.0;
  std::string folder;
  SimulationInput simulation;
  std::vector<LaserMount> lasers;  ///< empty: one at the robot's origin
  double step = 0.0;               ///< of a drive [m]
  MotionNoise odometry;
};

/// `LABEL,X,Y,YAW`. \throws UsageError
LaserMount parseLaser(const std::string& text) {
  std::vector<std::string> fields;
  std::istringstream stream(text);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  std::vector<double> numbers;
  for (std::size_t i = 1; i < fields.size(); ++i) {
    if (const auto number = parseNumber(fields[i])) numbers.push_back(*number);
  }
  if (fields.size() != 4 || numbers.size() != 3 || fields[0].empty()) {
    throw UsageError("--laser: '" + text + "' is not LABEL,X,Y,YAW, in metres and degrees");
  }
  return {fields[0], {numbers[0], numbers[1], toRadians(numbers[2])}};
}

void addOptions(CLI::App& cli, Options& options) {
  addText(cli, "--map", options.map, kMapFormats)->required()->type_name("MAP");
  addScaleOption(cli, options.scale);
  addSimulationOptions(cli, options.simulation);
  cli.add_option_function<std::vector<std::string>>(
         "--laser",
         [&options](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) options.lasers.push_back(parseLaser(text));
         },
         "A laser and where it is on the robot, m and deg; may be given several times [default: "
         "LASER,0,0,0]")
      ->allow_extra_args(false)
      ->take_all()
      ->type_name("LABEL,X,Y,YAW");
  addNumber(cli, "--drive", options.step, {0.0, 1e3, true},
            "The scans are of one drive, so far from one to the next, with odometry")
      ->type_name("M");
  cli.add_option_function<std::string>(
         "--odometry-noise",
         [&options](const std::string& text) { options.odometry = parseMotionNoise(text); },
         "Errors of the odometry: m a metre, deg a metre, deg a radian [default: 0.02,1,2]")
      ->type_name("A,B,C");
  addText(cli, "-o", options.folder, "Folder for scans.rawlog and truth.tum")
      ->required()
      ->type_name("DIR");
}

/// The plain robot: one laser at its origin, every scan somewhere else.
bool isPlain(const Options& options) {
  return options.lasers.empty() && options.step == 0.0;
}

/// Writes what robots with several lasers, or with wheels, do and see.
int simulateRobot(const PolygonMap& map, const Options& options) {
  DriveSimulatorParams params;
  params.laser = options.simulation.params();
  if (!options.lasers.empty()) params.lasers = options.lasers;
  params.step = options.step;
  params.odometry = options.odometry;
  std::vector<StampedPose> truth;
  std::vector<RawlogMoment> moments;
  std::vector<mrpt::obs::CObservation2DRangeScan> observations;
  for (SimulatedMoment& moment :
       simulateMoments(map, params, options.simulation.count, options.simulation.seed)) {
    truth.push_back(moment.truth);
    observations.insert(observations.end(), moment.observations.begin(), moment.observations.end());
    moments.push_back({moment.measured, std::move(moment.observations)});
  }
  const std::filesystem::path folder = options.folder;
  makeFolder(options.folder);
  OutputFiles files;
  const std::string rawlog = files.stage(folder / "scans.rawlog");
  if (options.step > 0.0) {
    writeDriveRawlog(rawlog, moments, options.odometry);
  } else {
    writeScansRawlog(rawlog, observations);
  }
  files.add(folder / "truth.tum", toTum(truth));
  files.commit();
  std::cout << moments.size() << " moments, " << observations.size() << " scans in "
            << (folder / "scans.rawlog").string() << ", truth in "
            << (folder / "truth.tum").string() << '\n';
  return kDone;
}

int simulate(const Program& program, const Options& options) {
  const PolygonMap map = loadMapWithWarnings(program, options.map, options.scale).map;
  if (!isPlain(options)) return simulateRobot(map, options);
  std::vector<StampedPose> truth;
  std::vector<mrpt::obs::CObservation2DRangeScan> observations;
  const SimulationInput& simulation = options.simulation;
  for (SimulatedScan& scan :
       simulateScans(map, simulation.params(), simulation.count, simulation.seed)) {
    truth.push_back(scan.truth);
    observations.push_back(std::move(scan.observation));
  }

  const std::filesystem::path folder = options.folder;
  makeFolder(options.folder);
  OutputFiles files;
  writeScansRawlog(files.stage(folder / "scans.rawlog"), observations);
  files.add(folder / "truth.tum", toTum(truth));
  files.commit();
  std::cout << simulation.count << " scans in " << (folder / "scans.rawlog").string()
            << ", truth in " << (folder / "truth.tum").string() << '\n';
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("polyloc-simulate", "Simulates laser scans at random poses in a map.");
  Options options;
  addOptions(program.options(), options);
  return program.run(argc, argv, [&] { return simulate(program, options); });
}
