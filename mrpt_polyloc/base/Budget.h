#pragma once

#include <mrpt_polyloc/base/Stopwatch.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstddef>

namespace mrpt_polyloc {

/// What an answer may take: wall time from when this was made, a flag by which another thread ends
/// it, and threads.
class Budget {
 public:
  /// On which threads an answer is found: the caller's alone, or all of the TBB arena that it is
  /// in.
  enum class Threads { callers, arenas };

  /// \param time_ms 0: no limit \param cancel null: none
  explicit Budget(double time_ms = 0.0, const std::atomic<bool>* cancel = nullptr,
                  Threads threads = Threads::callers)
      : time_ms_(time_ms), cancel_(cancel), threads_(threads) {}

  bool isSpent() const {
    if (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed)) return true;
    return time_ms_ > 0.0 && 1e3 * watch_.seconds() >= time_ms_;
  }

  /// How many threads there are.
  std::size_t threads() const {
    return threads_ == Threads::callers
               ? 1U
               : static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  }

  /// Calls body(i) for each i below `count`, on all threads, in any order: what the calls do must
  /// not depend on that. One thread takes at least `least` in a row.
  template <class Body>
  void forEach(std::size_t count, std::size_t least, const Body& body) const {
    if (count <= least || threads() == 1) {
      for (std::size_t i = 0; i < count; ++i) body(i);
      return;
    }
    // A thread that waits here must not begin another answer: both would use its workspaces.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, least), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
      });
    });
  }

 private:
  double time_ms_;
  const std::atomic<bool>* cancel_;
  Threads threads_;
  Stopwatch watch_;
};

}  // namespace mrpt_polyloc
