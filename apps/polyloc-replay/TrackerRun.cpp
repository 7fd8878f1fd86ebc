#include "TrackerRun.h"

#include "step_motion.h"
#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/travel/HypothesisTracker.h>

#include <algorithm>
#include <time.h>

namespace mrpt_polyloc::replay {
namespace {

void describe(const TrackingState& state, bool with_cloud, StepRecord& record) {
  record.tracking = state.status;
  record.covariance.setZero();
  if (state.has_searched) record.search = state.status;
  record.particles = record.hypotheses = state.hypotheses.size();
  if (state.hypotheses.empty()) return;
  record.estimate = state.hypotheses.front().pose_map_robot;
  record.covariance = state.hypotheses.front().covariance;
  if (!with_cloud) return;
  for (const TrackedHypothesis& h : state.hypotheses) record.cloud.push_back(h.pose_map_robot);
}

}  // namespace

RunRecord runTracker(const ReplaySetup& setup, const std::vector<std::size_t>& replayed,
                     std::uint32_t seed, const std::vector<std::size_t>& reported) {
  HypothesisTracker tracker(setup.localizer);
  RunRecord run;
  run.seed = seed;
  for (std::size_t k = 0; k < replayed.size(); ++k) {
    const ReplayStep& at = setup.steps[replayed[k]];
    StepRecord record;
    record.step = replayed[k];
    record.stamp = at.scan.stamp();
    const Stopwatch watch;
    const double before = threadCpuMs();
    if (k > 0) tracker.move(motionOf(at));
    const TrackingState& state = tracker.update(at.scans);
    record.filter_cpu_ms = threadCpuMs() - before;
    record.filter_ms = 1e3 * watch.seconds();
    describe(state, std::find(reported.begin(), reported.end(), record.step) != reported.end(),
             record);
    run.steps.push_back(std::move(record));
  }
  return run;
}

}  // namespace mrpt_polyloc::replay
