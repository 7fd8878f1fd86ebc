#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <list>
#include <mutex>
#include <string>

namespace mrpt_polyloc::apps {

/// Who computes, and who waits: so many at once, in the order of their coming. A request of a named
/// job cancels the older ones of that name, for whoever asked has moved on.
class Jobs {
 public:
  /// \param at_once how many may compute
  explicit Jobs(std::size_t at_once) : free_slots_(at_once) {}

  /// A request from its coming to its end.
  class Ticket {
   public:
    /// \param name of its job; empty: none
    Ticket(Jobs& jobs, std::string name);
    ~Ticket();
    Ticket(const Ticket&) = delete;
    Ticket& operator=(const Ticket&) = delete;

    /// Waits for its turn, if it has not had it. \throws ApiError if it is cancelled before
    void enter();
    const std::atomic<bool>& cancelled() const { return cancelled_; }
    /// \throws ApiError if it is cancelled
    void check() const;

   private:
    friend class Jobs;
    Jobs& jobs_;
    std::string name_;
    std::atomic<bool> cancelled_{false};
    bool has_slot_ = false;
  };

  /// Cancels all, and all that will come.
  void stop();

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Ticket*> tickets_;
  std::deque<Ticket*> waiting_;
  std::size_t free_slots_;
  bool is_stopped_ = false;
};

}  // namespace mrpt_polyloc::apps
