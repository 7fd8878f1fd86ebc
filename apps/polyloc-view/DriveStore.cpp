#include "DriveStore.h"

#include <algorithm>

namespace mrpt_polyloc::apps {

std::shared_ptr<Drive> DriveStore::get(const std::string& key,
                                       const std::function<std::shared_ptr<Drive>()>& make) {
  const auto find = [&] {
    return std::find_if(drives_.begin(), drives_.end(),
                        [&](const auto& kept) { return kept.first == key; });
  };
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto kept = find();
    if (kept != drives_.end()) {
      drives_.splice(drives_.begin(), drives_, kept);
      return drives_.front().second;
    }
  }
  std::shared_ptr<Drive> made = make();  // others need not wait for it
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto kept = find();
  if (kept != drives_.end()) return kept->second;
  drives_.emplace_front(key, made);
  if (drives_.size() > kMost) drives_.pop_back();
  return made;
}

}  // namespace mrpt_polyloc::apps
