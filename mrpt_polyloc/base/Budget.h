#pragma once

#include <mrpt_polyloc/base/Stopwatch.h>

#include <atomic>

namespace mrpt_polyloc {

/// What an answer may take: wall time from when this was made, and a flag by which another thread
/// ends it.
class Budget {
 public:
  /// \param time_ms 0: no limit \param cancel null: none
  explicit Budget(double time_ms = 0.0, const std::atomic<bool>* cancel = nullptr)
      : time_ms_(time_ms), cancel_(cancel) {}

  bool isSpent() const {
    if (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed)) return true;
    return time_ms_ > 0.0 && 1e3 * watch_.seconds() >= time_ms_;
  }

 private:
  double time_ms_;
  const std::atomic<bool>* cancel_;
  Stopwatch watch_;
};

}  // namespace mrpt_polyloc
