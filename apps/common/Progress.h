#pragma once

#include <cstddef>
#include <mutex>
#include <string>

namespace mrpt_polyloc::apps {

/// `WHAT 12/454` on stderr, rewritten in place; silent where stderr is no terminal. Thread-safe.
class Progress {
 public:
  Progress(std::string what, std::size_t total);
  ~Progress();  ///< wipes the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void step();

 private:
  void print() const;

  std::mutex mutex_;
  std::string what_;
  std::size_t total_;
  std::size_t done_ = 0;
  bool visible_;
};

}  // namespace mrpt_polyloc::apps
