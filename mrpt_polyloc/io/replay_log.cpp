#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/io/limits.h>
#include <mrpt_polyloc/io/mrpt_archive.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/io/replay_log.h>
#include <mrpt_polyloc/io/sensor_labels.h>

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace mrpt_polyloc {

namespace {

using mrpt::obs::CActionCollection;
using mrpt::obs::CActionRobotMovement2D;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CSensoryFrame;
using mrpt::poses::CPose2D;
using mrpt::serialization::CSerializable;

/// A frame with its scans, before the sensor is chosen.
struct Candidate {
  std::size_t object = 0;
  CSensoryFrame::Ptr frame;
  std::vector<CObservation2DRangeScan::Ptr> scans;
  std::vector<CActionCollection::Ptr> actions;  ///< since the candidate before
  std::optional<CPose2D> odometry;              ///< the last reading before it
  std::optional<std::size_t> pair;              ///< see ReplayStep
};

/// Sorts the objects of a log, in order, into candidates.
class Collector {
 public:
  explicit Collector(std::string path) : path_(std::move(path)) {}

  void add(const CSerializable::Ptr& object, std::size_t index) {
    if (auto log = std::dynamic_pointer_cast<mrpt::obs::CRawlog>(object)) {
      for (std::size_t i = 0; i < log->size(); ++i) add(log->getAsGeneric(i), index);
    } else if (auto action = std::dynamic_pointer_cast<CActionCollection>(object)) {
      requirePlanarMovement(*action, index);
      actions_.push_back(std::move(action));
      is_paired_ = false;
      has_actions = true;
    } else if (auto frame = std::dynamic_pointer_cast<CSensoryFrame>(object)) {
      addFrame(std::move(frame), index);
    } else if (auto odometry = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(object)) {
      requireFinite(odometry->odometry, index);
      odometry_ = odometry->odometry;
    } else if (auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(object)) {
      auto alone = CSensoryFrame::Create();
      alone->insert(scan);
      addFrame(std::move(alone), index);
    }
  }

  std::vector<Candidate> candidates;
  bool has_actions = false;

 private:
  void addFrame(CSensoryFrame::Ptr frame, std::size_t index) {
    Candidate candidate{index, std::move(frame), {}, {}, odometry_, {}};
    if (!is_paired_) candidate.pair = pairs_++;
    is_paired_ = true;
    for (const auto& observation : *candidate.frame) {
      if (auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation)) {
        candidate.scans.push_back(std::move(scan));
      }
    }
    if (candidate.scans.empty()) return;
    candidate.actions.swap(actions_);
    candidates.push_back(std::move(candidate));
  }

  void requireFinite(const CPose2D& pose, std::size_t index) const {
    if (std::isfinite(pose.x()) && std::isfinite(pose.y()) && std::isfinite(pose.phi())) return;
    throw FormatError(path_, "object " + std::to_string(index), "a movement that is not finite");
  }

  void requirePlanarMovement(CActionCollection& action, std::size_t index) const {
    const auto movement = action.getBestMovementEstimation();
    if (!movement || !movement->poseChange) {
      throw FormatError(path_, "object " + std::to_string(index),
                        "an action that does not say how the robot moved in the plane");
    }
    requireFinite(movement->poseChange->getMeanVal(), index);
  }

  std::string path_;
  std::vector<CActionCollection::Ptr> actions_;
  std::optional<CPose2D> odometry_;
  std::size_t pairs_ = 0;
  bool is_paired_ = true;  ///< no action since the last frame
};

CActionCollection::Ptr movementOf(const CPose2D& increment,
                                  const CActionRobotMovement2D::TMotionModelOptions& model) {
  CActionRobotMovement2D movement;
  movement.computeFromOdometry(increment, model);
  auto action = CActionCollection::Create();
  action->insert(movement);
  return action;
}

/// One action as it is recorded; of several, or with another noise, the composed movement.
CActionCollection::Ptr composed(const std::vector<CActionCollection::Ptr>& actions,
                                const CActionRobotMovement2D::TMotionModelOptions* replacement) {
  if (actions.size() == 1 && !replacement) return actions.front();
  CPose2D increment;
  CActionRobotMovement2D::Ptr movement;
  for (const auto& action : actions) {
    movement = action->getBestMovementEstimation();
    increment = increment + movement->poseChange->getMeanVal();
  }
  return movementOf(increment, replacement ? *replacement : movement->motionModelConfiguration);
}

/// The scans that belong to the sensors, of each candidate; of each sensor the first.
std::vector<std::vector<CObservation2DRangeScan::Ptr>> chosenScans(
    const std::string& path, const std::vector<Candidate>& candidates,
    const std::string& sensor_label) {
  std::vector<std::string> labels;
  std::vector<std::pair<std::size_t, CObservation2DRangeScan::Ptr>> scans;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    for (const auto& scan : candidates[i].scans) {
      labels.push_back(scan->sensorLabel);
      scans.emplace_back(i, scan);
    }
  }
  std::vector<std::vector<CObservation2DRangeScan::Ptr>> chosen(candidates.size());
  for (const std::size_t k : selectSensor(path, labels, sensor_label)) {
    auto& of_candidate = chosen[scans[k].first];
    const bool is_new =
        std::none_of(of_candidate.begin(), of_candidate.end(),
                     [&](const auto& scan) { return scan->sensorLabel == labels[k]; });
    if (is_new) of_candidate.push_back(scans[k].second);
  }
  return chosen;
}

/// Fills in the scans of all steps, and tells their observations what the log knows.
/// \param lasers of each step
void convertScans(const std::string& path, const ReadingOptions& options, Notes* notes,
                  const std::vector<std::vector<CObservation2DRangeScan::Ptr>>& lasers,
                  std::vector<ReplayStep>& steps) {
  std::vector<LoggedScan> logged;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::string place = "object " + std::to_string(steps[i].object);
    for (const auto& laser : lasers[i]) {
      try {
        logged.push_back(toLoggedScan(*laser));
      } catch (const std::invalid_argument& error) {
        throw FormatError(path, place, error.what());
      }
      logged.back().place = place;
    }
  }
  const LogSurvey survey(logged, options, notes);
  std::size_t next = 0;
  for (const auto& of_step : lasers) {
    for (const auto& laser : of_step) applyFacts(survey.of(logged[next++]), *laser);
  }
  std::vector<RangeScan> scans = toRangeScans(path, std::move(logged), options, nullptr);
  next = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (std::size_t k = 0; k < lasers[i].size(); ++k) {
      steps[i].scans.push_back(std::move(scans[next++]));
    }
    steps[i].scan = steps[i].scans.front();
  }
}

}  // namespace

void OdometryNoise::check() const {
  requireNotNegative("min_std_xy", min_std_xy);
  requireNotNegative("min_std_phi", min_std_phi);
}

std::vector<ReplayStep> loadReplayLog(const std::string& path, const ScanFileOptions& options,
                                      const OdometryNoise& noise, Notes* notes) {
  noise.check();
  Collector collector(path);
  readObjects(path, options.strict, notes,
              [&](const CSerializable::Ptr& object, std::size_t index) {
                collector.add(object, index);
                requireScans(path, "object " + std::to_string(index), collector.candidates.size(),
                             options.max_scans);
              });
  CActionRobotMovement2D::TMotionModelOptions model;
  model.modelSelection = CActionRobotMovement2D::mmGaussian;
  model.gaussianModel.minStdXY = static_cast<float>(noise.min_std_xy);
  model.gaussianModel.minStdPHI = static_cast<float>(noise.min_std_phi);

  const auto chosen = chosenScans(path, collector.candidates, options.sensor_label);
  std::vector<ReplayStep> steps;
  std::vector<std::vector<CObservation2DRangeScan::Ptr>> lasers;
  std::vector<CActionCollection::Ptr> pending;
  std::optional<CPose2D> last_odometry;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Candidate& candidate = collector.candidates[i];
    pending.insert(pending.end(), candidate.actions.begin(), candidate.actions.end());
    if (chosen[i].empty()) continue;
    ReplayStep step;
    step.object = candidate.object;
    step.pair = collector.has_actions ? candidate.pair : steps.size();
    step.frame = candidate.frame;
    step.laser = chosen[i].front();
    lasers.push_back(chosen[i]);
    if (!steps.empty()) {
      const CPose2D driven =
          candidate.odometry && last_odometry ? *candidate.odometry - *last_odometry : CPose2D();
      step.action = pending.empty() ? movementOf(driven, model)
                                    : composed(pending, noise.replaces_recorded ? &model : nullptr);
    }
    pending.clear();
    if (candidate.odometry) last_odometry = candidate.odometry;
    steps.push_back(std::move(step));
  }
  convertScans(path, options.readings, notes, lasers, steps);
  return steps;
}

}  // namespace mrpt_polyloc
