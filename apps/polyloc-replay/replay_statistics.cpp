#include "replay_statistics.h"

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/truth.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc::replay {
namespace {

bool isRight(const StepError& error) {
  return error.m <= kSuccess.distance && error.rad <= kSuccess.angle;
}

/// The first step in [begin, end) from which on every one that can be judged is right; it is
/// judged itself.
std::optional<std::size_t> rightFrom(const RunRecord& run, const Truth& truth, std::size_t begin,
                                     std::size_t end) {
  std::optional<std::size_t> from;
  for (std::size_t k = end; k-- > begin;) {
    const auto error = errorOf(run.steps[k], truth);
    if (!error) continue;
    if (!isRight(*error)) break;
    from = k;
  }
  return from;
}

void addErrors(const RunRecord& run, const Truth& truth, RunScore& score) {
  double metres = 0.0, radians = 0.0, count = 0.0;
  for (std::size_t k = *score.step; k < run.steps.size(); ++k) {
    const auto error = errorOf(run.steps[k], truth);
    if (!error) continue;
    metres += error->m * error->m;
    radians += error->rad * error->rad;
    count += 1.0;
  }
  score.error_m = std::sqrt(metres / count);
  score.error_rad = std::sqrt(radians / count);
}

void addGaps(const RunRecord& run, const Truth& truth, const std::vector<std::size_t>& gaps,
             RunScore& score) {
  const auto position = [&](std::size_t step) {
    const auto at = std::find_if(run.steps.begin(), run.steps.end(),
                                 [step](const StepRecord& record) { return record.step == step; });
    return static_cast<std::size_t>(at - run.steps.begin());
  };
  for (std::size_t g = 0; g < gaps.size(); ++g) {
    const std::size_t begin = position(gaps[g]);
    const std::size_t end = g + 1 < gaps.size() ? position(gaps[g + 1]) : run.steps.size();
    const auto from = rightFrom(run, truth, begin, end);
    score.found_after.push_back(from ? std::optional<std::size_t>(*from - begin + 1)
                                     : std::nullopt);
  }
}

/// Counts the steps at which the tracker was sure.
void addUnique(const RunRecord& run, const Truth& truth, RunScore& score) {
  for (std::size_t k = 0; k < run.steps.size(); ++k) {
    if (run.steps[k].tracking != LocalizationStatus::unique) continue;
    if (!score.unique_step) score.unique_step = k;
    ++score.unique_steps;
    const auto error = errorOf(run.steps[k], truth);
    if (!error) continue;
    ++score.unique_judged;
    score.unique_right += isRight(*error) ? 1 : 0;
  }
}

}  // namespace

Truth loadTruthOfSteps(const std::string& path, const std::vector<ReplayStep>& steps) {
  Truth truth;
  if (!isIndexedTruth(path)) {
    std::vector<RangeScan> scans;
    for (const ReplayStep& step : steps) scans.push_back(step.scan);
    for (const auto& pose : matchTruth(scans, loadTum(path), path)) truth.emplace_back(pose);
    return truth;
  }
  std::size_t pairs = 0;
  for (const ReplayStep& step : steps) {
    if (step.pair) pairs = *step.pair + 1;
  }
  const auto by_pair = loadIndexedTruth(path, pairs);
  for (const ReplayStep& step : steps) {
    truth.push_back(step.pair ? by_pair[*step.pair] : std::nullopt);
  }
  return truth;
}

std::optional<StepError> errorOf(const StepRecord& step, const Truth& truth) {
  if (step.step >= truth.size() || !truth[step.step]) return std::nullopt;
  const auto& at = *truth[step.step];
  return StepError{std::hypot(step.estimate.x - at.x, step.estimate.y - at.y),
                   std::abs(std::remainder(step.estimate.phi - at.phi, kTwoPi))};
}

RunScore scoreRun(const RunRecord& run, const Truth& truth, const std::vector<std::size_t>& gaps) {
  RunScore score;
  score.step = rightFrom(run, truth, 0, run.steps.size());
  if (score.step) addErrors(run, truth, score);
  if (!truth.empty()) addGaps(run, truth, gaps, score);
  double particles = 0.0;
  for (std::size_t k = 0; k < run.steps.size(); ++k) {
    const StepRecord& step = run.steps[k];
    score.total_ms += step.filter_ms;
    score.total_cpu_ms += step.filter_cpu_ms;
    score.max_step_ms = std::max(score.max_step_ms, step.filter_ms);
    score.recovery_ms += step.monitor_ms + (k > 0 ? step.search_ms : 0.0);
    if (k > 0 && step.search) ++score.searches;
    if (step.mixed_in) ++score.mixes;
    particles += static_cast<double>(step.particles);
  }
  addUnique(run, truth, score);
  if (run.steps.empty()) return score;
  score.search_ms = run.steps.front().search_ms;
  score.first_step_ms = run.steps.front().filter_ms;
  score.first_step_cpu_ms = run.steps.front().filter_cpu_ms;
  score.first_particles = run.steps.front().particles;
  score.mean_particles = particles / static_cast<double>(run.steps.size());
  return score;
}

}  // namespace mrpt_polyloc::replay
