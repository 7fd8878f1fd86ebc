// wake_up MAP RAWLOG: wakes up, drives along an action/sensory-frame rawlog until it is sure where
// it is, and follows the robot to the end. Prints "sure after N scans" and "pose X Y PHI_DEG" of
// the robot in the map at the end.
#include <mrpt_polyloc/io/map_files.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/travel/HypothesisTracker.h>

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cstdio>
#include <iostream>
#include <stdexcept>
#include <vector>

namespace {

using mrpt::obs::CObservation2DRangeScan;

// begin: wake_up
/// All lasers of a frame, as one moment.
std::vector<mrpt_polyloc::RangeScan> scansOf(const mrpt::obs::CSensoryFrame& frame) {
  std::vector<mrpt_polyloc::RangeScan> scans;
  for (const auto& observation : frame) {
    const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation);
    if (scan) scans.push_back(mrpt_polyloc::toRangeScan(*scan));
  }
  return scans;
}

/// What the robot calls at each step: how it moved, and what it sees now.
const mrpt_polyloc::TrackingState& step(const mrpt::obs::CActionCollection& action,
                                        const mrpt::obs::CSensoryFrame& frame,
                                        mrpt_polyloc::HypothesisTracker& tracker) {
  const auto movement = const_cast<mrpt::obs::CActionCollection&>(action)
                            .getBestMovementEstimation();  // MRPT's is not const
  tracker.move(mrpt_polyloc::measuredMotion(movement->poseChange->getMeanVal().asTPose()));
  return tracker.update(scansOf(frame));
}
// end

void run(const char* map_file, const char* rawlog_file) {
  mrpt::obs::CRawlog rawlog;
  if (!rawlog.loadFromRawLogFile(rawlog_file)) throw std::runtime_error("no rawlog");
  // begin: drive
  const auto index = mrpt_polyloc::MapIndex::build(mrpt_polyloc::loadMap(map_file).map);
  mrpt_polyloc::HypothesisTracker tracker{mrpt_polyloc::GlobalLocalizer(index)};

  tracker.update(scansOf(*rawlog.getAsObservations(1)));  // wakes up: this one is searched
  std::size_t sure_after = 0;
  for (std::size_t i = 2; i + 1 < rawlog.size(); i += 2) {
    const auto& state = step(*rawlog.getAsAction(i), *rawlog.getAsObservations(i + 1), tracker);
    const bool is_sure = state.status == mrpt_polyloc::LocalizationStatus::unique;
    if (is_sure && sure_after == 0) sure_after = state.scans;
  }
  const auto& best = tracker.state().hypotheses.front();  // pose, covariance, weight
  // end
  std::printf("sure after %zu scans\n", sure_after);
  std::printf("pose %.2f %.2f %.1f\n", best.pose_map_robot.x, best.pose_map_robot.y,
              best.pose_map_robot.phi * 180.0 / 3.14159265358979323846);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "usage: wake_up MAP RAWLOG\n";
    return 2;
  }
  run(argv[1], argv[2]);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
