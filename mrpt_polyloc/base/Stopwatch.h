#pragma once

#include <mrpt_polyloc/base/export.h>

#include <chrono>

namespace mrpt_polyloc {

/// Wall time since it was made.
class POLYLOC_EXPORT Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace mrpt_polyloc
