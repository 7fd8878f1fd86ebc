#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace mrpt_polyloc {
namespace {

std::vector<Moment> oneMoment(std::vector<RangeScan> scans) {
  std::vector<Moment> moments(1);
  moments.front().scans = std::move(scans);
  return moments;
}

std::vector<RangeScan> oneScan(RangeScan scan) {
  std::vector<RangeScan> scans;
  scans.push_back(std::move(scan));
  return scans;
}

/// Whether both stamps are known and the later moment is before the earlier one.
bool isFalling(const Moment& before, const Moment& after) {
  const double first = before.scans.front().stamp(), second = after.scans.front().stamp();
  return first != 0.0 && second != 0.0 && second < first;
}

}  // namespace

ScanSet::ScanSet(RangeScan scan) : ScanSet(oneScan(std::move(scan))) {}

ScanSet::ScanSet(std::vector<RangeScan> scans) : ScanSet(oneMoment(std::move(scans))) {}

ScanSet::ScanSet(std::vector<Moment> moments) : moments_(std::move(moments)) {
  if (moments_.empty()) throw InvalidParamsError("scan set: there is no moment in it");
  for (std::size_t i = 0; i < moments_.size(); ++i) {
    const std::string name = "scan set: moment " + std::to_string(i);
    if (moments_[i].scans.empty()) throw InvalidParamsError(name + " has no scan");
    scan_count_ += moments_[i].scans.size();
    for (const RangeScan& scan : moments_[i].scans) hit_count_ += scan.hitCount();
    if (i == 0) continue;
    if (moments_[i].is_after_gap) throw InvalidParamsError(name + " comes after a gap");
    moments_[i].since_before.check();
    if (isFalling(moments_[i - 1], moments_[i])) {
      throw InvalidParamsError(name + " is before the one that it follows, by its stamp");
    }
  }
  from_now_.resize(moments_.size());
  for (std::size_t i = moments_.size() - 1; i > 0; --i) {
    from_now_[i - 1] = from_now_[i] + inverse(moments_[i].since_before);
  }
}

const RangeScan* ScanSet::single() const {
  return scan_count_ == 1 ? &moments_.front().scans.front() : nullptr;
}

void LastMetresParams::check() const {
  requireNotNegative("length", length);
  requireNotNegative("spacing", spacing);
  requireNotNegative("turn", turn);
  requireInRange("most_moments", static_cast<double>(most_moments), 1.0, 1e3);
  requirePositive("longest_step", longest_step);
}

ScanSet lastMetres(const std::vector<Moment>& drive, std::size_t now,
                   const LastMetresParams& params) {
  std::vector<Moment> kept{drive[now]};
  Motion since_kept;  // from the moment looked at to the last one kept
  double way = 0.0;
  for (std::size_t i = now; i > 0 && params.length > 0.0; --i) {
    const Motion& step = drive[i].since_before;
    if (drive[i].is_after_gap || step.length() > params.longest_step) break;
    way += step.length();
    if (way > params.length || kept.size() >= params.most_moments) break;
    since_kept = step + since_kept;
    if (since_kept.length() < params.spacing &&
        std::abs(since_kept.pose_before_after.phi) < params.turn) {
      continue;
    }
    kept.back().since_before = since_kept;
    kept.push_back(drive[i - 1]);
    since_kept = Motion();
  }
  std::reverse(kept.begin(), kept.end());
  kept.front().is_after_gap = false;
  return ScanSet(std::move(kept));
}

ScanAccumulator::ScanAccumulator(const LastMetresParams& params) : params_(params) {
  params_.check();
}

ScanSet ScanAccumulator::add(std::vector<RangeScan> scans, const Motion& since_before) {
  drive_.push_back({std::move(scans), since_before, false});
  double way = 0.0;
  std::size_t first = drive_.size() - 1;
  while (first > 0 && way <= params_.length) {
    const double step = drive_[first].since_before.length();
    if (drive_[first].is_after_gap || step > params_.longest_step) break;
    way += step;
    --first;
  }
  drive_.erase(drive_.begin(), drive_.begin() + static_cast<std::ptrdiff_t>(first));
  return lastMetres(drive_, drive_.size() - 1, params_);
}

}  // namespace mrpt_polyloc
