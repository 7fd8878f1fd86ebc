// polyloc-simulate: scans at random poses in a map, with truth. See README.md beside this file.

#include "../common/Cli.h"
#include "../common/OutputFiles.h"
#include "../common/map_input.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/evaluation/Simulator.h>
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/io/rawlog_writer.h>

#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace mrpt_polyloc;
using namespace mrpt_polyloc::apps;

struct Options {
  std::string map;
  double scale = 1.0;
  std::string folder;
  std::uint64_t count = 0;
  std::uint64_t seed = 0;
  std::uint64_t beams = SimulatorParams{}.beams;
  std::uint64_t occluders = 0;
  double fov_deg = 360.0;
  SimulatorParams params;
};

void addOptions(CLI::App& cli, Options& options) {
  addText(cli, "--map", options.map, kMapFormats)->required()->type_name("MAP");
  addScaleOption(cli, options.scale);
  addCount(cli, "-n", options.count, 1, 1'000'000, "Number of scans")->required()->type_name("N");
  addCount(cli, "--seed", options.seed, 0, UINT64_MAX, "The same seed gives the same scans")
      ->required()
      ->type_name("S");
  addCount(cli, "--beams", options.beams, 1, 100'000, "Beams of a scan [default: 360]")
      ->type_name("N");
  addNumber(cli, "--fov", options.fov_deg, {0.0, 360.0, true},
            "Field of view; 360: the first direction is not repeated [default: 360]")
      ->type_name("DEG");
  addNumber(cli, "--sigma", options.params.sigma, {0.0},
            "Standard deviation of a range [default: 0.03]")
      ->type_name("M");
  addNumber(cli, "--max-range", options.params.max_range, {0.0, 1e6, true},
            "Greatest range; nothing met within it: a no-return [default: 20]")
      ->type_name("M");
  addNumber(cli, "--dropout", options.params.dropout, {0.0, 1.0},
            "Probability that a beam becomes a no-return [default: 0]")
      ->type_name("P");
  addNumber(cli, "--short", options.params.short_beams, {0.0, 1.0},
            "Probability that a beam is cut to a random shorter range [default: 0]")
      ->type_name("P");
  addCount(cli, "--occluders", options.occluders, 0, 1000,
           "Objects in front of the robot, each 8 to 19 degrees wide [default: 0]")
      ->type_name("N");
  addNumber(cli, "--clearance", options.params.clearance, {0.0},
            "Least distance of the robot's centre to a wall [default: 0.3]")
      ->type_name("M");
  addText(cli, "-o", options.folder, "Folder for scans.rawlog and truth.tum")
      ->required()
      ->type_name("DIR");
}

int simulate(const Program& program, Options& options) {
  options.params.beams = options.beams;
  options.params.occluders = options.occluders;
  options.params.fov = toRadians(options.fov_deg);

  const PolygonMap map = loadMapWithWarnings(program, options.map, options.scale).map;
  std::vector<StampedPose> truth;
  std::vector<mrpt::obs::CObservation2DRangeScan> observations;
  for (SimulatedScan& scan : simulateScans(map, options.params, options.count, options.seed)) {
    truth.push_back(scan.truth);
    observations.push_back(std::move(scan.observation));
  }

  const std::filesystem::path folder = options.folder;
  makeFolder(options.folder);
  OutputFiles files;
  writeScansRawlog(files.stage(folder / "scans.rawlog"), observations);
  files.add(folder / "truth.tum", toTum(truth));
  files.commit();
  std::cout << options.count << " scans in " << (folder / "scans.rawlog").string() << ", truth in "
            << (folder / "truth.tum").string() << '\n';
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("polyloc-simulate", "Simulates laser scans at random poses in a map.");
  Options options;
  addOptions(program.options(), options);
  return program.run(argc, argv, [&] { return simulate(program, options); });
}
