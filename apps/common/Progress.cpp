#include "Progress.h"

#include <iostream>
#include <unistd.h>
#include <utility>

namespace mrpt_polyloc::apps {

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)), total_(total), visible_(::isatty(STDERR_FILENO) == 1) {
  print();
}

Progress::~Progress() {
  if (visible_) std::cerr << "\r\033[K" << std::flush;
}

void Progress::step() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++done_;
  print();
}

void Progress::print() const {
  if (visible_) std::cerr << '\r' << what_ << ' ' << done_ << '/' << total_ << std::flush;
}

}  // namespace mrpt_polyloc::apps
