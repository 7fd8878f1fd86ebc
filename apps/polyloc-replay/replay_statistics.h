#pragma once

#include "FilterRun.h"
#include <mrpt_polyloc/evaluation/Summary.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc::replay {

/// The true pose at each step of a log; null where it is not known.
using Truth = std::vector<std::optional<mrpt::math::TPose2D>>;

/// Success: within 0.5 m and 10 degrees.
constexpr Tolerance kSuccess{0.5, 0.17453292519943295};

/// The truth of all steps of a log: TUM lines, matched by stamp, each step exactly once; or MRPT's
/// `index x y phi`, the index being the number of the pair of action and frame, see ReplayStep.
/// \throws FormatError naming file and line, scan or pose
Truth loadTruthOfSteps(const std::string& path, const std::vector<ReplayStep>& steps);

/// Of one step against the truth.
struct StepError {
  double m = 0.0, rad = 0.0;
};
std::optional<StepError> errorOf(const StepRecord& step, const Truth& truth);

/// How one run went.
struct RunScore {
  std::optional<std::size_t> step;  ///< number of the first replayed step from which all are right
  double error_m = 0.0;             ///< root mean square over these [m]; 0 if there are none
  double error_rad = 0.0;           ///< [rad]
  double search_ms = 0.0;           ///< of the first search, at the first step
  double first_step_ms = 0.0;       ///< of the filter
  double total_ms = 0.0;            ///< of the filter, all steps
  double first_step_cpu_ms = 0.0;   ///< the first step in CPU time
  double total_cpu_ms = 0.0;        ///< all steps in CPU time
  double max_step_ms = 0.0;         ///< of the filter
  double recovery_ms = 0.0;         ///< judging the fits, and searches after the first
  std::size_t first_particles = 0;
  double mean_particles = 0.0;
  std::size_t searches = 0;  ///< after the first
  std::size_t mixes = 0;     ///< of these, those whose hypotheses were mixed in
  /// Of the tracker: the first replayed step at which its status is unique; how many are, and how
  /// many of those that can be judged are right. None and 0 with particles.
  std::optional<std::size_t> unique_step;
  std::size_t unique_steps = 0, unique_judged = 0, unique_right = 0;
  /// For each gap, after how many scans the robot was found: 1 means that the first estimate after
  /// it is right, and all on to the next gap (or the end) are. Null if it was not.
  std::vector<std::optional<std::size_t>> found_after;
};

/// Scores a run. A step without truth says nothing; a run none of whose steps can be judged is no
/// success. Steps are counted among the replayed ones from 0, those without truth too.
RunScore scoreRun(const RunRecord& run, const Truth& truth, const std::vector<std::size_t>& gaps);

/// What summary.json and the table say beside the scores.
struct ReplayFacts {
  std::string init, maps, rawlog, truth_file;
  std::size_t steps = 0;
  std::vector<std::size_t> gaps;  ///< steps before which the robot was carried
  double index_build_s = 0.0;
};

/// The text of summary.json. Without truth, success, median_step and errors are null.
std::string replaySummaryJson(const ReplayFacts& facts, const std::vector<RunRecord>& runs,
                              const std::vector<RunScore>& scores);
/// The same for people, a few lines.
std::string replaySummaryText(const ReplayFacts& facts, const std::vector<RunScore>& scores);

/// A line per run and step:
/// `run,seed,step,stamp,x,y,phi_deg,std_x,std_y,std_phi_deg,particles,fit,`
/// `health,search,hypotheses,best_fit,mixed_in,error_m,error_deg,filter_ms,filter_cpu_ms,search_ms,`
/// `monitor_ms`; what does not exist
/// is empty.
std::string stepsCsv(const std::vector<RunRecord>& runs, const Truth& truth);

}  // namespace mrpt_polyloc::replay
