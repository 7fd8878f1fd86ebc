#pragma once

#include "Drive.h"

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace mrpt_polyloc::apps {

/// The drives that were asked for last, so that a further step costs one step. Nothing depends on
/// whether a drive is still kept: made anew it comes out the same. Thread-safe.
class DriveStore {
 public:
  /// Each may hold a table of the map's clearances and two hundred steps.
  static constexpr std::size_t kMost = 4;

  /// \param key all that the drive depends on, as a text
  std::shared_ptr<Drive> get(const std::string& key,
                             const std::function<std::shared_ptr<Drive>()>& make);

 private:
  std::mutex mutex_;
  std::list<std::pair<std::string, std::shared_ptr<Drive>>> drives_;  ///< the last asked for first
};

}  // namespace mrpt_polyloc::apps
