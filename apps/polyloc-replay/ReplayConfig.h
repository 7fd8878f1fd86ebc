#pragma once

#include <mrpt_polyloc/io/replay_log.h>
#include <mrpt_polyloc/mrpt_bridge/FilterRecovery.h>
#include <mrpt_polyloc/mrpt_bridge/ParticleSeeder.h>

#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/slam/TKLDParams.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mrpt_polyloc::replay {

/// How the particles start.
enum class Init {
  polyloc,  ///< from a search for the first scan
  uniform,  ///< anywhere in the free space
  tracker   ///< there are none: HypothesisTracker follows what the search finds
};

/// "polyloc", "uniform" or "tracker".
const char* toString(Init init);
/// \throws InvalidParamsError for another text
Init parseInit(const std::string& text);

/// Steps from `first` to `last`, both included, counted from 0.
struct StepRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// What an ini of pf-localization says, and its section [polyloc]. README.md lists every option.
struct ReplayConfig {
  std::string path;                      ///< of the ini
  mrpt::config::CConfigFileMemory text;  ///< all of it, its paths made absolute

  // [LocalizationExperiment]
  std::string map_file;  ///< a simplemap or gridmap that MRPT's own maps are made of; or empty
  std::string rawlog_file;
  std::string truth_file;  ///< or empty
  std::size_t rawlog_offset = 0;
  std::size_t repetitions = 1;
  std::size_t uniform_particles = 40'000;
  int scene_frequency = 0;  ///< every n-th step gets a scene of its own; below 1: none

  // [PF_options], [KLD_options], [DummyOdometryParams]
  mrpt::bayes::CParticleFilter::TParticleFilterOptions filter;
  mrpt::slam::TKLDParams kld;
  OdometryNoise odometry;

  // [polyloc]
  std::string search_map;  ///< or empty: see loadReplayMaps()
  double scale = 1.0;      ///< metres per unit of search_map
  ScanFileOptions scans;   ///< sensor, max_range, min_range
  Init init = Init::polyloc;
  GlobalLocalizerParams search;
  ParticleSeederParams seeds;
  bool recovers = true;
  FilterRecoveryParams recovery;
  std::vector<StepRange> carried;  ///< cut out: the robot is carried over them
  std::vector<std::size_t> report_steps = {0, 1, 2, 5, 10};
};

/// Reads an ini. A path in it that is not absolute is looked for beside the ini, then in the
/// current folder.
/// \throws FormatError naming ini and section: a file that cannot be read, an option that is not
/// known, misses, or is out of range
ReplayConfig loadReplayConfig(const std::string& path);

/// Names of sections of the ini that are not read.
std::vector<std::string> unreadSections(const ReplayConfig& config);

}  // namespace mrpt_polyloc::replay
