#include "ReplayConfig.h"

#include "../common/parsing.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/mrpt_archive.h>
#include <mrpt_polyloc/mrpt_bridge/IniSection.h>

#include <algorithm>
#include <filesystem>
#include <functional>

namespace mrpt_polyloc::replay {
namespace {

namespace fs = std::filesystem;
using mrpt::config::CConfigFileMemory;

/// Beside the ini if there is such a file, else as it is.
std::string resolved(const std::string& ini, const std::string& path) {
  if (path.empty() || fs::path(path).is_absolute()) return path;
  const fs::path beside = fs::path(ini).parent_path() / path;
  std::error_code ignored;
  return fs::exists(beside, ignored) ? beside.string() : path;
}

bool startsWith(const std::string& text, const std::string& head) {
  return text.compare(0, head.size(), head) == 0;
}

/// The files that maps name for themselves.
void resolveMapFiles(const std::string& ini, CConfigFileMemory& text) {
  std::vector<std::string> sections;
  text.getAllSections(sections);
  for (const std::string& section : sections) {
    if (!startsWith(section, "MetricMap_polygonMap2D_") ||
        !apps::endsWith(section, "_creationOpts")) {
      continue;
    }
    const std::string file = text.read_string(section, "file", "");
    if (!file.empty()) text.write(section, "file", resolved(ini, file));
  }
}

void readExperiment(ReplayConfig& config) {
  // Those of pf-localization that say nothing here are known, too, so that its inis can be used.
  IniSection section(config.text, "LocalizationExperiment",
                     {"map_file",
                      "rawlog_file",
                      "ground_truth_path_file",
                      "rawlog_offset",
                      "experimentRepetitions",
                      "particles_count",
                      "3DSceneFrequency",
                      "logOutput_dir",
                      "use_3D_poses",
                      "init_PDF_mode",
                      "init_PDF_min_x",
                      "init_PDF_max_x",
                      "init_PDF_min_y",
                      "init_PDF_max_y",
                      "init_PDF_min_z",
                      "init_PDF_max_z",
                      "init_PDF_min_yaw_deg",
                      "init_PDF_max_yaw_deg",
                      "init_PDF_min_pitch_deg",
                      "init_PDF_max_pitch_deg",
                      "init_PDF_min_roll_deg",
                      "init_PDF_max_roll_deg",
                      "init_PDF_min_phi",
                      "init_PDF_max_phi",
                      "3DSceneFollowRobot",
                      "experimentTestConvergenceAtStep",
                      "SAVE_STATS_ONLY",
                      "DO_RELIABILITY_ESTIMATE",
                      "DO_SCAN_LIKELIHOOD_DEBUG",
                      "SHOW_PROGRESS_3D_REAL_TIME",
                      "SHOW_PROGRESS_3D_REAL_TIME_DELAY_MS",
                      "STATS_CONF_INTERVAL",
                      "initial_odo_x",
                      "initial_odo_y",
                      "initial_odo_phi"});
  config.map_file = resolved(config.path, section.text("map_file", ""));
  config.rawlog_file = resolved(config.path, section.text("rawlog_file", ""));
  config.truth_file = resolved(config.path, section.text("ground_truth_path_file", ""));
  config.rawlog_offset = section.count("rawlog_offset", 0, 0, 1'000'000'000);
  config.repetitions = section.count("experimentRepetitions", 1, 1, 1'000'000);
  config.uniform_particles = section.count("particles_count", 40'000, 1, 100'000'000);
  config.scene_frequency = static_cast<int>(section.number("3DSceneFrequency", 0, -1, 1e9));
  if (section.flag("use_3D_poses", false)) {
    throw InvalidParamsError("[LocalizationExperiment]: use_3D_poses is not supported");
  }
}

void readFilter(ReplayConfig& config) {
  const IniSection filter(
      config.text, "PF_options",
      {"PF_algorithm", "resamplingMethod", "adaptiveSampleSize", "BETA", "sampleSize", "powFactor",
       "pfAuxFilterOptimal_MaximumSearchSamples", "max_loglikelihood_dyn_range",
       "pfAuxFilterStandard_FirstStageWeightsMonteCarlo", "pfAuxFilterOptimal_MLE"});
  const IniSection kld(config.text, "KLD_options",
                       {"KLD_binSize_PHI_deg", "KLD_binSize_XY", "KLD_delta", "KLD_epsilon",
                        "KLD_maxSampleSize", "KLD_minSampleSize", "KLD_minSamplesPerBin"});
  // MRPT takes words for 0: looked at before it reads them.
  constexpr double kMost = 1e9;
  for (const char* name : {"BETA", "powFactor", "max_loglikelihood_dyn_range"}) {
    filter.number(name, 0.0, 0.0, kMost);
  }
  for (const char* name : {"sampleSize", "pfAuxFilterOptimal_MaximumSearchSamples"}) {
    filter.count(name, 1, 0, static_cast<std::size_t>(kMost));
  }
  for (const char* name : {"KLD_binSize_PHI_deg", "KLD_binSize_XY", "KLD_delta", "KLD_epsilon"}) {
    kld.number(name, 0.0, 0.0, kMost);
  }
  for (const char* name : {"KLD_maxSampleSize", "KLD_minSampleSize"}) {
    kld.count(name, 1, 1, static_cast<std::size_t>(kMost));
  }
  kld.number("KLD_minSamplesPerBin", 0.0, 0.0, kMost);
  const auto load = [&](const char* name, auto& options) {
    try {
      options.loadFromConfigFile(config.text, name);
    } catch (const std::exception& error) {
      throw InvalidParamsError("[" + std::string(name) + "]: " + plainMessage(error));
    }
  };
  if (config.text.sectionExists("PF_options")) load("PF_options", config.filter);
  if (config.text.sectionExists("KLD_options")) load("KLD_options", config.kld);

  IniSection odometry(config.text, "DummyOdometryParams",
                      {"minStdXY", "minStdPHI", "additional_std_XYZ", "additional_std_angle"});
  config.odometry.min_std_xy = odometry.number("minStdXY", config.odometry.min_std_xy, 0, 100);
  config.odometry.min_std_phi =
      toRadians(odometry.number("minStdPHI", toDegrees(config.odometry.min_std_phi), 0, 180));
}

/// "I,J-K".
std::vector<StepRange> parseSteps(const std::string& name, const std::string& text) {
  std::vector<StepRange> ranges;
  if (text.empty()) return ranges;
  try {
    for (const auto& range : apps::parseRows(text)) ranges.push_back({range.first, range.last});
  } catch (const std::exception&) {
    throw InvalidParamsError("[polyloc]: " + name + " = '" + text +
                             "' is not a list of steps, as in 5,10-20");
  }
  return ranges;
}

void readRecovery(IniSection& section, ReplayConfig& config) {
  FilterRecoveryParams& recovery = config.recovery;
  FilterMonitorParams& monitor = recovery.monitor;
  config.recovers = section.flag("recovery", config.recovers);
  recovery.share = section.number("recovery_share", recovery.share, 0, 1);
  recovery.least_gain = section.number("recovery_least_gain", recovery.least_gain, 0, 1e6);
  recovery.sure_weight = section.number("recovery_sure_weight", recovery.sure_weight, 0, 1);
  recovery.patience = section.count("recovery_patience", recovery.patience, 0, 1'000'000);
  recovery.last_metres.length =
      section.number("recovery_accumulate", recovery.last_metres.length, 0, 1e3);
  recovery.judged_particles =
      section.count("judged_particles", recovery.judged_particles, 1, 100'000);
  recovery.least_hits = section.count("judged_least_hits", recovery.least_hits, 1, 100'000);
  monitor.least_steps = section.count("monitor_least_steps", monitor.least_steps, 1, 1'000'000);
  monitor.window = section.count("monitor_window", monitor.window, 1, 1'000'000);
  monitor.deviations = section.number("monitor_deviations", monitor.deviations, 0, 1e6);
  monitor.least_deviation =
      section.number("monitor_least_deviation", monitor.least_deviation, 0, 1e6);
  monitor.patience = section.count("monitor_patience", monitor.patience, 1, 1'000'000);
  recovery.check();
}

void readPolyloc(ReplayConfig& config) {
  IniSection section(config.text, "polyloc",
                     {"map",
                      "scale",
                      "sensor",
                      "max_range",
                      "min_range",
                      "init",
                      "particles",
                      "least_per_hypothesis",
                      "uniform_share",
                      "max_hypotheses",
                      "odometry_noise",
                      "recovery",
                      "recovery_share",
                      "recovery_least_gain",
                      "recovery_sure_weight",
                      "recovery_patience",
                      "recovery_accumulate",
                      "judged_particles",
                      "judged_least_hits",
                      "monitor_least_steps",
                      "monitor_window",
                      "monitor_deviations",
                      "monitor_least_deviation",
                      "monitor_patience",
                      "carried",
                      "report_steps"});
  config.search_map = resolved(config.path, section.text("map", ""));
  config.scale = section.number("scale", 1.0, 1e-6, 1e6);
  config.scans.sensor_label = section.text("sensor", "");
  if (!section.text("max_range", "").empty()) {
    config.scans.readings.max_range = section.number("max_range", 0, 0, 1e6);
  }
  if (!section.text("min_range", "").empty()) {
    config.scans.readings.min_range = section.number("min_range", 0, 0, 1e6);
  }
  config.scans.readings.check();
  namingSection("polyloc",
                [&] { config.init = parseInit(section.text("init", toString(config.init))); });
  config.seeds.particles = section.count("particles", config.seeds.particles, 1, 100'000'000);
  config.seeds.least_per_hypothesis =
      section.count("least_per_hypothesis", config.seeds.least_per_hypothesis, 1, 1'000'000);
  config.seeds.uniform_share = section.number("uniform_share", config.seeds.uniform_share, 0, 1);
  config.recovery.max_hypotheses =
      section.count("max_hypotheses", config.recovery.max_hypotheses, 1, 1'000'000);
  const std::string noise = section.text("odometry_noise", "log");
  if (noise != "log" && noise != "ini") {
    throw InvalidParamsError("[polyloc]: odometry_noise = '" + noise + "' is not log or ini");
  }
  config.odometry.replaces_recorded = noise == "ini";
  readRecovery(section, config);
  config.carried = parseSteps("carried", section.text("carried", ""));
  const std::string steps = section.text("report_steps", "");
  if (!steps.empty()) {
    config.report_steps.clear();
    for (const StepRange& range : parseSteps("report_steps", steps)) {
      if (range.last - range.first > 1000) {
        throw InvalidParamsError("[polyloc]: report_steps names more than 1000 steps");
      }
      for (std::size_t i = range.first; i <= range.last; ++i) config.report_steps.push_back(i);
    }
  }
}

}  // namespace

const char* toString(Init init) {
  if (init == Init::tracker) return "tracker";
  return init == Init::polyloc ? "polyloc" : "uniform";
}

Init parseInit(const std::string& text) {
  if (text == "polyloc") return Init::polyloc;
  if (text == "uniform") return Init::uniform;
  if (text == "tracker") return Init::tracker;
  throw InvalidParamsError("init is '" + text + "', not 'polyloc', 'uniform' or 'tracker'");
}

ReplayConfig loadReplayConfig(const std::string& path) {
  ReplayConfig config;
  config.path = path;
  config.text.setContent(GzInputStream(path).readAll());
  resolveMapFiles(path, config.text);
  try {
    readExperiment(config);
    readFilter(config);
    readPolyloc(config);
  } catch (const InvalidParamsError& error) {
    throw FormatError(path, "", error.what());
  }
  return config;
}

std::vector<std::string> unreadSections(const ReplayConfig& config) {
  std::vector<std::string> sections, unread;
  config.text.getAllSections(sections);
  for (const std::string& section : sections) {
    const bool is_read = section.empty() || section == "LocalizationExperiment" ||
                         section == "PF_options" || section == "KLD_options" ||
                         section == "DummyOdometryParams" || section == "polyloc" ||
                         startsWith(section, "MetricMap");
    if (!is_read) unread.push_back(section);
  }
  return unread;
}

}  // namespace mrpt_polyloc::replay
