#pragma once

#include <tbb/task_arena.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <utility>

namespace mrpt_polyloc {

/// A value made when it is first asked for, by whichever thread asks first. If making it throws,
/// the next to ask tries again (std::call_once may hang then).
template <class T>
class Lazy {
 public:
  Lazy() = default;
  explicit Lazy(T value) : value_(std::move(value)), is_made_(true) {}

  /// \param make returns the value. It may run parallel loops: this thread then takes no task of
  /// the caller's, which might ask for the same value and wait for ever.
  template <class Make>
  const T& get(Make&& make) const {
    if (!is_made_.load(std::memory_order_acquire)) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!is_made_.load(std::memory_order_relaxed)) {
        tbb::this_task_arena::isolate([&] { value_.emplace(make()); });
        is_made_.store(true, std::memory_order_release);
      }
    }
    return *value_;
  }

  bool isMade() const { return is_made_.load(std::memory_order_acquire); }
  /// Only if it is made.
  const T& value() const { return *value_; }

 private:
  mutable std::optional<T> value_;
  mutable std::atomic<bool> is_made_{false};
  mutable std::mutex mutex_;
};

}  // namespace mrpt_polyloc
