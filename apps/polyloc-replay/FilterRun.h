#pragma once

#include "ReplayConfig.h"
#include "replay_maps.h"
#include <mrpt_polyloc/io/replay_log.h>

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mrpt_polyloc::replay {

/// What the filter, or the tracker, said after a step, and what that took.
struct StepRecord {
  std::size_t step = 0;                      ///< number of the scan in the log
  double stamp = 0.0;                        ///< [s]
  mrpt::math::TPose2D estimate{0, 0, 0};     ///< mean of the particles [m, rad]
  mrpt::math::CMatrixDouble33 covariance;    ///< of the particles
  std::size_t particles = 0;                 ///< that were weighed
  std::optional<double> fit;                 ///< see filterFit(); none if it was not judged
  std::optional<FilterHealth> health;        ///< none without recovery
  std::optional<LocalizationStatus> search;  ///< if a search was made at this step
  /// Of the tracker after this step; none with particles.
  std::optional<LocalizationStatus> tracking;
  std::optional<double> best_fit;  ///< of the best hypothesis, see FilterRecovery
  bool mixed_in = false;           ///< whether hypotheses were mixed in
  std::size_t hypotheses = 0;      ///< that it found
  double filter_cpu_ms = 0.0;      ///< the same in CPU time, which other programs do not change
  double filter_ms = 0.0;          ///< MRPT's filter [wall ms]
  double search_ms = 0.0;          ///< search, if there was one
  double monitor_ms = 0.0;         ///< judging the fit, and mixing in
  std::vector<mrpt::math::TPose2D> cloud;  ///< the particles, at steps to be reported
};

/// One repetition.
struct RunRecord {
  std::uint32_t seed = 0;
  std::vector<StepRecord> steps;
};

/// All that the repetitions share; what the references name must outlive it.
struct ReplaySetup {
  const ReplayConfig& config;
  const ReplayMaps& maps;
  const GlobalLocalizer& localizer;
  const std::vector<ReplayStep>& steps;  ///< of the whole log
};

/// Which steps are replayed: from `rawlog_offset` on, without those that the robot is carried over.
/// \throws FormatError naming the ini if none is left
std::vector<std::size_t> replayedSteps(const ReplayConfig& config, std::size_t count);

/// The replayed steps before which the robot was carried: the first of each gap.
std::vector<std::size_t> stepsAfterGaps(const std::vector<std::size_t>& replayed);

/// Runs MRPT's particle filter over the log in a thread of its own, whose random numbers start from
/// the seed: the same seed gives the same poses, whatever ran before.
///
/// The particles start at the first scan, as `init` says, and are weighed with it: step 0. At each
/// further one the filter moves them by the action and weighs them with the frame. A gap in
/// `replayed` is a robot that is carried: no action is applied across it but the one that the first
/// step after it has.
/// \param reported steps at which the particles are kept
/// \throws FormatError naming the rawlog and the scan if MRPT's filter throws
RunRecord runFilter(const ReplaySetup& setup, const std::vector<std::size_t>& replayed,
                    std::uint32_t seed, const std::vector<std::size_t>& reported);

}  // namespace mrpt_polyloc::replay
