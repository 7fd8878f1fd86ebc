// polyloc-dataset: a data set from a log with poses. See README.md beside this file.

#include "../common/Cli.h"
#include "../common/OutputFiles.h"
#include "../common/scan_input.h"
#include "dataset_building.h"
#include <mrpt_polyloc/base/errors.h>
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
  std::string log, poses, folder;
  ScanFileOptions file;
  double resolution = 0.05, block = 10.0, most_jump = 3.0;
};

void addOptions(CLI::App& cli, Options& options) {
  addText(cli, "--log", options.log,
          "The drive: CARMEN .log/.clf, MRPT .simplemap, or, with --poses, .rawlog")
      ->required()
      ->type_name("FILE");
  addText(cli, "--poses", options.poses,
          "Where the robot was at each scan [default: the poses of a corrected CARMEN log or a "
          "simplemap]")
      ->type_name("TRUTH.tum");
  addText(cli, "--sensor", options.file.sensor_label, "Scans of this sensor alone")
      ->type_name("LABEL");
  addReadingOptions(cli, options.file);
  addNumber(cli, "--resolution", options.resolution, {0.001, 10.0},
            "Side of the map's cells [default: 0.05]")
      ->type_name("M");
  addNumber(cli, "--block", options.block, {0.0, 1e6, true},
            "Stretches of so much way make map and scans in turn [default: 10]")
      ->type_name("M");
  addNumber(cli, "--max-jump", options.most_jump, {0.0, 1e6, true},
            "Longest step between two scans of one drive [default: 3]")
      ->type_name("M");
  addText(cli, "-o", options.folder,
          "Folder for map.yaml, map.pgm, scans.rawlog, truth.tum, good.txt")
      ->required()
      ->type_name("DIR");
}

int build(const Program& program, const Options& options) {
  Notes notes;
  const PosedScans drive =
      loadPosedScans(options.log, options.poses, options.file, options.most_jump, notes);
  program.note(options.log, notes);
  const DriveParts parts = partsOf(drive, options.block);
  if (parts.scans.empty()) {
    throw FormatError(options.log, "", "the drive is shorter than --block: no scan is left over");
  }
  const OccupancyBitmap bitmap = mapOf(drive, parts.mapping, options.resolution, options.log);

  constexpr double kFirstStamp = 1e9;  // synthetic: stamps of logs repeat
  std::vector<StampedPose> truth;
  std::vector<mrpt::obs::CObservation2DRangeScan> observations;
  for (const std::size_t row : parts.scans) {
    const double stamp = kFirstStamp + static_cast<double>(truth.size());
    truth.push_back({stamp, drive.poses[row]});
    observations.push_back(observationOf(drive.scans[row], stamp, options.log, row));
  }
  const std::vector<std::size_t> good = goodRows(drive, parts.scans, bitmap);
  std::string good_text = "# rows whose scan agrees with the map, by polyloc-dataset\n";
  for (const std::size_t row : good) good_text += std::to_string(row) + "\n";

  const std::filesystem::path folder = options.folder;
  makeFolder(options.folder);
  OutputFiles files;
  files.add(folder / "map.pgm", toPgm(bitmap));
  files.add(folder / "map.yaml", toRosYaml(bitmap, "map.pgm"));
  writeScansRawlog(files.stage(folder / "scans.rawlog"), observations);
  files.add(folder / "truth.tum", toTum(truth));
  files.add(folder / "good.txt", good_text);
  files.commit();
  std::cout << "map of " << parts.mapping.size() << " scans in " << (folder / "map.yaml").string()
            << "; " << parts.scans.size() << " scans with truth, " << good.size()
            << " of them agree with the map\n";
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("polyloc-dataset", "Makes a data set (map, scans, truth) of a log with poses.");
  Options options;
  addOptions(program.options(), options);
  return program.run(argc, argv, [&] { return build(program, options); });
}
