#include "memory_budget.h"

#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>

#include <fstream>
#include <sys/resource.h>

namespace mrpt_polyloc::apps {

void addMemoryOption(CLI::App& cli, std::optional<double>& megabytes) {
  addNumber(
      cli, "--max-memory", [&megabytes](double given) { megabytes = given; }, {0.0, 1e9, true},
      "Most memory for the index of a map; one that would take more is refused before it is built "
      "[default: half of what is free]")
      ->type_name("MB");
}

std::optional<double> freeMegabytes() {
  std::ifstream file("/proc/meminfo");
  for (std::string key; file >> key;) {
    double kilobytes = 0.0;
    if (key == "MemAvailable:" && file >> kilobytes) return kilobytes / 1e3;
  }
  return std::nullopt;
}

void limitMemory() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const std::optional<double> free = freeMegabytes();
  rlimit limit{};
  if (!free || getrlimit(RLIMIT_DATA, &limit) != 0) return;
  const auto most = static_cast<rlim_t>(1e6 * *free);
  if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur <= most) return;
  limit.rlim_cur = most;
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

void requireMemory(const std::string& path, const PolygonMap& map, const MapIndexParams& params,
                   const std::optional<double>& allowed, const std::string& another_way) {
  const MapIndexEstimate estimate = MapIndex::estimate(map, params);
  const double needed = estimate.bytes / 1e6;
  const std::optional<double> free = allowed ? std::nullopt : freeMegabytes();
  if (!allowed && !free) return;
  const double most = allowed ? *allowed : 0.5 * *free;
  if (needed <= most) return;
  throw FormatError(
      path, "",
      formatted("the index of %.0f m2 would take about %.0f MB of memory and %.2g s on one core; "
                "%.0f MB are allowed (%s). Allow more by --max-memory MB; ",
                map.area(), needed, estimate.cpu_seconds, most,
                allowed ? "--max-memory" : "half of what is free") +
          another_way +
          "cut the map to where the robot can be; or, if it is not in metres, say so by --scale F");
}

}  // namespace mrpt_polyloc::apps
