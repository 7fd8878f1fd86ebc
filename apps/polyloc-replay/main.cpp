// polyloc-replay: MRPT's particle filter over a rawlog, started by our search. See README.md.

#include "../common/Cli.h"
#include "../common/OutputFiles.h"
#include "../common/Progress.h"
#include "../common/memory_budget.h"
#include "../common/scan_input.h"
#include "FilterRun.h"
#include "ReplayConfig.h"
#include "TrackerRun.h"
#include "replay_maps.h"
#include "replay_report.h"
#include "replay_scene.h"
#include "replay_statistics.h"
#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/mrpt_bridge/registration.h>

#include <mrpt/random/RandomGenerators.h>
#include <mrpt/system/os.h>

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace mrpt_polyloc;
using namespace mrpt_polyloc::apps;
using namespace mrpt_polyloc::replay;

struct Options {
  std::string config, rawlog, init, truth, libraries, folder;
  std::uint64_t repetitions = 0;  // 0: as the ini says
  std::uint64_t seed = 1;
  ScanFileOptions scans;  // readings: as the ini says where not given
  std::optional<double> scale, max_memory;
};

void addOptions(CLI::App& cli, Options& options) {
  addText(cli, "CONFIG", options.config, "Sections as of pf-localization, and [polyloc]")
      ->required()
      ->type_name("CONFIG.ini");
  addText(cli, "--rawlog", options.rawlog, "The rawlog [default: rawlog_file of the ini]")
      ->type_name("FILE");
  addReadingOptions(cli, options.scans);
  addNumber(
      cli, "--scale", [&options](double scale) { options.scale = scale; }, {0.0, 1e6, true},
      "Metres per unit of the search's map [default: scale of the ini, or 1]")
      ->type_name("F");
  addMemoryOption(cli, options.max_memory);
  addText(
      cli, "--sensor", options.scans.sensor_label,
      "The laser that is searched for and judged; of several the tracker takes all that a frame "
      "holds [default: sensor of the ini]")
      ->type_name("LABEL[,LABEL...]|all");
  addText(cli, "--init", options.init,
          "How the particles start: polyloc [default] or uniform; or tracker: hypotheses are "
          "followed instead of particles")
      ->type_name("NAME")
      ->check([](const std::string& text) {
        const bool is_known = text == "polyloc" || text == "uniform" || text == "tracker";
        return is_known ? "" : "neither polyloc nor uniform nor tracker";
      });
  addText(cli, "--truth", options.truth,
          "True poses: TUM lines, or MRPT's index x y phi [default: ground_truth_path_file]")
      ->type_name("FILE");
  addCount(cli, "--repetitions", options.repetitions, 1, 1'000'000,
           "Runs, with seeds one after the other [default: experimentRepetitions, or 1]")
      ->type_name("N");
  addCount(cli, "--seed", options.seed, 0, std::numeric_limits<std::uint32_t>::max() - 1'000'000,
           "Of the first run [default: 1]")
      ->type_name("S");
  addText(cli, "-l", options.libraries, "Libraries with further classes of MRPT to load")
      ->type_name("A.so,B.so");
  addText(cli, "-o", options.folder, "Folder for summary, trajectory, steps, report and scenes")
      ->required()
      ->type_name("DIR");
}

void loadLibraries(const std::string& libraries) {
  if (libraries.empty()) return;
  std::string errors;
  if (mrpt::system::loadPluginModules(libraries, errors)) return;
  for (char& c : errors) c = c == '\n' ? ' ' : c;
  throw FormatError(libraries, "", "cannot be loaded: " + errors);
}

/// The ini, with what the command line says instead.
ReplayConfig loadConfig(const Program& program, const Options& options) {
  ReplayConfig config = loadReplayConfig(options.config);
  for (const std::string& section : unreadSections(config)) {
    program.warn(options.config + ": section [" + section + "] is not read");
  }
  if (!options.rawlog.empty()) config.rawlog_file = options.rawlog;
  const ReadingOptions& readings = options.scans.readings;
  if (readings.max_range) config.scans.readings.max_range = readings.max_range;
  if (readings.min_range) config.scans.readings.min_range = readings.min_range;
  config.scans.strict = options.scans.strict;
  if (!options.scans.sensor_label.empty()) config.scans.sensor_label = options.scans.sensor_label;
  if (options.scale) config.scale = *options.scale;
  if (!options.truth.empty()) config.truth_file = options.truth;
  if (!options.init.empty()) config.init = parseInit(options.init);
  if (options.repetitions > 0) config.repetitions = options.repetitions;
  if (config.init != Init::polyloc) config.recovers = false;
  if (config.rawlog_file.empty()) {
    throw FormatError(config.path, "[LocalizationExperiment]", "no rawlog_file, and no --rawlog");
  }
  return config;
}

/// Steps at which the first run keeps its particles: those of the report and of the scenes.
std::vector<std::size_t> keptSteps(const ReplayConfig& config,
                                   const std::vector<std::size_t>& replayed) {
  std::vector<std::size_t> kept = config.report_steps;
  kept.push_back(replayed.back());
  if (config.scene_frequency > 0) {
    const auto every = static_cast<std::size_t>(config.scene_frequency);
    for (std::size_t k = every - 1; k < replayed.size(); k += every) kept.push_back(replayed[k]);
  }
  return kept;
}

/// DIR/scene.3Dscene of the last step, and one for each n-th step in DIR/3D.
void addScenes(OutputFiles& files, const std::filesystem::path& folder, const ReplayConfig& config,
               const CPolygonMap2D& map, const RunRecord& run, const Truth& truth) {
  writeScene(files.stage(folder / "scene.3Dscene"), map, run, run.steps.size() - 1, truth);
  if (config.scene_frequency < 1) return;
  makeFolder(folder / "3D");
  const auto every = static_cast<std::size_t>(config.scene_frequency);
  for (std::size_t k = every - 1; k < run.steps.size(); k += every) {
    const std::string name = formatted("step_%05zu.3Dscene", run.steps[k].step);
    writeScene(files.stage(folder / "3D" / name), map, run, k, truth);
  }
}

std::string trajectory(const RunRecord& run) {
  std::vector<StampedPose> poses;
  for (const StepRecord& step : run.steps) poses.push_back({step.stamp, step.estimate});
  return toTum(poses);
}

int replayLog(const Program& program, const Options& options) {
  registerClasses();
  loadLibraries(options.libraries);
  const ReplayConfig config = loadConfig(program, options);
  const auto seed = static_cast<std::uint32_t>(options.seed);
  mrpt::random::getRandomGenerator().randomize(seed);  // some motion models draw when composed
  Notes notes;
  const std::vector<ReplayStep> steps =
      loadReplayLog(config.rawlog_file, config.scans, config.odometry, &notes);
  program.note(config.rawlog_file, notes);
  const Truth truth =
      config.truth_file.empty() ? Truth() : loadTruthOfSteps(config.truth_file, steps);
  const std::vector<std::size_t> replayed = replayedSteps(config, steps.size());
  const ReplayMaps maps = loadReplayMaps(config, options.max_memory);
  const std::filesystem::path folder = options.folder;
  makeFolder(options.folder);
  requireWritable(folder / "summary.json");

  const Stopwatch watch;
  const GlobalLocalizer localizer(maps.polygons.index(), config.search);
  const double index_seconds = watch.seconds();
  const ReplaySetup setup{config, maps, localizer, steps};
  ReplayFacts facts{replay::toString(config.init),
                    maps.metric_classes,
                    config.rawlog_file,
                    config.truth_file,
                    replayed.size(),
                    stepsAfterGaps(replayed),
                    index_seconds};
  std::vector<RunRecord> runs;
  std::vector<RunScore> scores;
  {
    Progress progress("run", config.repetitions);
    for (std::uint32_t i = 0; i < config.repetitions; ++i) {
      const auto kept = i == 0 ? keptSteps(config, replayed) : std::vector<std::size_t>();
      runs.push_back(config.init == Init::tracker ? runTracker(setup, replayed, seed + i, kept)
                                                  : runFilter(setup, replayed, seed + i, kept));
      scores.push_back(scoreRun(runs.back(), truth, facts.gaps));
      progress.step();
    }
  }

  const std::string text = replaySummaryText(facts, scores);
  OutputFiles files;
  files.add(folder / "summary.json", replaySummaryJson(facts, runs, scores));
  files.add(folder / "trajectory.tum", trajectory(runs.front()));
  files.add(folder / "steps.csv", stepsCsv(runs, truth));
  files.add(folder / "report.html", replayReport(*maps.polygons.map(), runs.front(), truth, text));
  addScenes(files, folder, config, maps.polygons, runs.front(), truth);
  files.commit();
  std::cout << text;
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("polyloc-replay",
                  "Runs MRPT's particle filter over a rawlog and says whether it found the robot.");
  Options options;
  addOptions(program.options(), options);
  return program.run(argc, argv, [&] { return replayLog(program, options); });
}
