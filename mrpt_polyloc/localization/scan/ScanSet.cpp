#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>

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

void ScanAccumulatorParams::check() const {
  requireNotNegative("length", length);
  requireNotNegative("spacing", spacing);
  requireNotNegative("turn", turn);
  requireInRange("most_moments", static_cast<double>(most_moments), 1.0, 1e3);
  requirePositive("longest_step", longest_step);
}

ScanAccumulator::ScanAccumulator(const ScanAccumulatorParams& params) : params_(params) {
  params_.check();
}

ScanSet ScanAccumulator::add(std::vector<RangeScan> scans, const Motion& since_before) {
  if (!moments_.empty() && since_before.length() > params_.longest_step) moments_.clear();
  Moment now{std::move(scans), since_before};
  if (!moments_.empty()) {
    // The last one stays only if it is far enough from the one before it, whichever comes next.
    const Motion& last = moments_.back().since_before;
    const bool is_near =
        last.length() < params_.spacing && std::abs(last.pose_before_after.phi) < params_.turn;
    if (moments_.size() > 1 && is_near) {
      now.since_before = last + since_before;
      moments_.pop_back();
    }
  }
  moments_.push_back(std::move(now));
  // What lies farther back than the length of the way is forgotten.
  double way = 0.0;
  std::size_t first = moments_.size() - 1;
  while (first > 0) {
    way += moments_[first].since_before.length();
    if (way > params_.length || moments_.size() - first >= params_.most_moments) break;
    --first;
  }
  moments_.erase(moments_.begin(), moments_.begin() + static_cast<std::ptrdiff_t>(first));
  return ScanSet(moments_);
}

}  // namespace mrpt_polyloc
