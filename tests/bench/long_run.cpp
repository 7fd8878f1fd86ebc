// long_run MAP SCANS [THREADS=1] [SEED=1]: whether a process that localizes scan after scan grows
// or slows down. Scans are simulated, blocks of them localized at once on so many threads, the way
// a robot's process does for weeks. Prints, twenty times, how many are done, the memory of the
// process [MB] and the time of a scan [ms of CPU, the mean of the block's].
//
// Exits 1 if the memory after the last block exceeds that after the fourth, when all workspaces
// have seen scans, by more than 2 % and 4 MB. A time is only printed.
#include <mrpt_polyloc/evaluation/Simulator.h>
#include <mrpt_polyloc/io/map_files.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>

#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

namespace {

using namespace mrpt_polyloc;

double residentMegabytes() {
  std::ifstream file("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

double cpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

int run(const std::string& path, std::size_t scans, int threads, std::uint64_t seed) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  const GlobalLocalizer localizer(loadMap(path).map);
  constexpr std::size_t kReports = 20, kSettled = 4, kBlock = 100;
  std::printf("%10s %10s %12s %10s\n", "scans", "RSS MB", "CPU ms/scan", "with pose");
  double settled = 0.0, last = 0.0;
  std::size_t done = 0;
  for (std::size_t report = 1; report <= kReports; ++report) {
    double seconds = 0.0;
    std::size_t found = 0, part = 0;
    for (const std::size_t goal = scans * report / kReports; done < goal;) {
      const std::size_t count = std::min(kBlock, goal - done);
      SimulatorParams params;
      params.occluders = done / kBlock % 4;  // some easy, some not
      std::vector<RangeScan> block;
      for (const SimulatedScan& scan : simulateScans(localizer.map(), params, count, seed + done)) {
        block.push_back(toRangeScan(scan.observation));
      }
      const double start = cpuSeconds();
      for (const LocalizationResult& result : localizer.localize(block)) {
        found += result.hypotheses.empty() ? 0 : 1;
      }
      seconds += cpuSeconds() - start;
      done += count;
      part += count;
    }
    last = residentMegabytes();
    if (report == kSettled) settled = last;
    const auto n = static_cast<double>(std::max<std::size_t>(part, 1));
    std::printf("%10zu %10.1f %12.3f %10zu\n", done, last, 1e3 * seconds / n, found);
    std::fflush(stdout);
  }
  if (last <= 1.02 * settled + 4.0) return 0;
  std::printf("the memory grew from %.1f to %.1f MB\n", settled, last);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 5) {
    std::fprintf(stderr, "usage: long_run MAP SCANS [THREADS] [SEED]\n");
    return 2;
  }
  try {
    return run(argv[1], std::stoul(argv[2]), argc > 3 ? std::stoi(argv[3]) : 1,
               argc > 4 ? std::stoul(argv[4]) : 1);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "long_run: %s\n", error.what());
    return 1;
  }
}
