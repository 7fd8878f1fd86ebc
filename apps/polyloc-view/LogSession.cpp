#include "LogSession.h"

#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/evaluation/truth.h>

namespace mrpt_polyloc::apps {

LogSession::LogSession(const std::string& path, const ScanFileOptions& options,
                       const std::string& truth, Notes* notes)
    : scans_(path, options, notes) {
  if (truth.empty()) return;
  // Only the stamps count.
  std::vector<RangeScan> stamps;
  stamps.reserve(scans_.size());
  for (std::size_t row = 0; row < scans_.size(); ++row) {
    stamps.emplace_back(std::vector<Beam>{}, mrpt::math::TPoint2D(0, 0), scans_.stamp(row));
  }
  truth_ = matchTruth(stamps, loadTum(truth), truth);
}

std::optional<mrpt::math::TPose2D> LogSession::truth(std::size_t row) const {
  if (truth_.empty()) return std::nullopt;
  return truth_.at(row);
}

std::string LogSession::outcome(std::size_t row, const LocalizationResult& result) const {
  if (!hasTruth() || result.hypotheses.empty()) return toString(result.status);
  return isRight(result.hypotheses.front().pose_map_robot, truth_.at(row)) ? "right" : "wrong";
}

bool LogSession::isMiss(const std::string& outcome) const {
  return outcome != (hasTruth() ? "right" : "unique");
}

}  // namespace mrpt_polyloc::apps
