#include "Jobs.h"

#include "ApiError.h"

#include <algorithm>

namespace mrpt_polyloc::apps {

Jobs::Ticket::Ticket(Jobs& jobs, std::string name) : jobs_(jobs), name_(std::move(name)) {
  const std::lock_guard<std::mutex> lock(jobs_.mutex_);
  if (jobs_.is_stopped_) cancelled_ = true;
  for (Ticket* other : jobs_.tickets_) {
    if (!name_.empty() && other->name_ == name_) other->cancelled_ = true;
  }
  jobs_.tickets_.push_back(this);
  jobs_.changed_.notify_all();
}

Jobs::Ticket::~Ticket() {
  const std::lock_guard<std::mutex> lock(jobs_.mutex_);
  jobs_.tickets_.remove(this);
  if (has_slot_) ++jobs_.free_slots_;
  jobs_.changed_.notify_all();
}

void Jobs::Ticket::enter() {
  std::unique_lock<std::mutex> lock(jobs_.mutex_);
  if (has_slot_) return;
  jobs_.waiting_.push_back(this);
  jobs_.changed_.wait(lock, [this] {
    return cancelled_ || (jobs_.free_slots_ > 0 && jobs_.waiting_.front() == this);
  });
  auto& waiting = jobs_.waiting_;
  waiting.erase(std::find(waiting.begin(), waiting.end(), this));
  jobs_.changed_.notify_all();
  if (cancelled_) throw superseded();
  --jobs_.free_slots_;
  has_slot_ = true;
}

void Jobs::Ticket::check() const {
  if (cancelled_) throw superseded();
}

void Jobs::stop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_stopped_ = true;
  for (Ticket* ticket : tickets_) ticket->cancelled_ = true;
  changed_.notify_all();
}

}  // namespace mrpt_polyloc::apps
