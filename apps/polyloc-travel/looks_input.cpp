#include "looks_input.h"

#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/replay_log.h>
#include <mrpt_polyloc/io/scan_files.h>

#include <mrpt/obs/CActionRobotMovement2D.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

bool isRawlog(const std::string& path) {
  return std::filesystem::path(path).filename().string().find(".rawlog") != std::string::npos;
}

}  // namespace

std::vector<Look> loadLooks(const Program& program, const TravelOptions& options) {
  Notes notes;
  std::vector<Look> looks;
  if (isRawlog(options.scans)) {
    for (const ReplayStep& step : loadReplayLog(options.scans, options.file, {}, &notes)) {
      Look look{{0, 0, 0}, step.scan};
      const auto movement = step.action ? step.action->getBestMovementEstimation() : nullptr;
      if (movement) look.moved = movement->poseChange->getMeanVal().asTPose();
      looks.push_back(std::move(look));
    }
  } else {
    for (RangeScan& scan : loadScans(options.scans, options.file, &notes)) {
      looks.push_back({{0, 0, 0}, std::move(scan)});
    }
  }
  program.note(options.scans, notes);
  for (std::size_t i = 1; i < looks.size(); ++i) {
    const double before = looks[i - 1].scan.stamp(), stamp = looks[i].scan.stamp();
    if (stamp != 0.0 && stamp < before) {
      throw FormatError(options.scans, "scan " + std::to_string(i),
                        "it was taken before the one that it follows, by its stamp");
    }
  }
  const bool has_moved = std::any_of(looks.begin(), looks.end(), [](const Look& look) {
    return std::hypot(look.moved.x, look.moved.y) > 1e-6 || std::abs(look.moved.phi) > 1e-6;
  });
  if (!has_moved && looks.size() > 1) {
    looks.erase(looks.begin(), looks.end() - 1);
  }
  return looks;
}

}  // namespace mrpt_polyloc::apps
