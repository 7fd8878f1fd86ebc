#include "endpoint_json.h"
#include "endpoints.h"

#include <algorithm>

namespace mrpt_polyloc::apps {

Json answerLog(const Services& services) {
  const LogSession* log = services.log;
  if (log == nullptr) return {{"count", 0}, {"truth", false}, {"path", Json::array()}};
  constexpr std::size_t kMostPoints = 5000;
  const std::size_t count = log->scans().size();
  std::vector<TPoint2D> path;
  const std::size_t points = log->hasTruth() ? std::min(count, kMostPoints) : 0;
  for (std::size_t k = 0; k < points; ++k) {
    const auto pose = log->truth(k * count / points);
    path.emplace_back(pose->x, pose->y);
  }
  return {{"count", count}, {"truth", log->hasTruth()}, {"path", flatPoints(path)}};
}

}  // namespace mrpt_polyloc::apps
