#pragma once

#include <mrpt_polyloc/base/export.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <stdexcept>

namespace mrpt_polyloc {

/// Told the share of a long work that is done, in [0, 1], now and then, by any of the threads that
/// do it; returns false to have it given up.
using ProgressFunction = std::function<bool(double share)>;

/// A work that was given up, as its caller asked.
class POLYLOC_EXPORT CancelledError : public std::runtime_error {
 public:
  CancelledError() : std::runtime_error("cancelled") {}
};

/// A part of a long work, of which the steps are counted by several threads.
class BuildProgress {
 public:
  /// \param tell may be null \param first, last shares of the whole work where this part begins
  /// and ends
  explicit BuildProgress(const ProgressFunction* tell = nullptr, double first = 0.0,
                         double last = 1.0)
      : tell_(tell), first_(first), last_(last) {}

  void begin(std::size_t steps) {
    steps_ = std::max<std::size_t>(steps, 1);
    done_ = 0;
    tell(0);
  }
  /// \throws CancelledError
  void take(std::size_t steps) { tell(done_.fetch_add(steps) + steps); }

 private:
  void tell(std::size_t done) const {
    if (tell_ == nullptr || !*tell_) return;
    const double share = static_cast<double>(done) / static_cast<double>(steps_);
    if (!(*tell_)(first_ + (last_ - first_) * std::min(share, 1.0))) throw CancelledError();
  }

  const ProgressFunction* tell_;
  double first_, last_;
  std::size_t steps_ = 1;
  std::atomic<std::size_t> done_{0};
};

}  // namespace mrpt_polyloc
