// polyloc-simulate: scans at random poses in a map, with truth. See README.md beside this file.

#include "../common/Cli.h"
#include "../common/OutputFiles.h"
#include "../common/map_input.h"
#include "../common/simulation_input.h"
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
  SimulationInput simulation;
};

void addOptions(CLI::App& cli, Options& options) {
  addText(cli, "--map", options.map, kMapFormats)->required()->type_name("MAP");
  addScaleOption(cli, options.scale);
  addSimulationOptions(cli, options.simulation);
  addText(cli, "-o", options.folder, "Folder for scans.rawlog and truth.tum")
      ->required()
      ->type_name("DIR");
}

int simulate(const Program& program, const Options& options) {
  const PolygonMap map = loadMapWithWarnings(program, options.map, options.scale).map;
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
