// polyloc-view: a map, a robot in it, and what its scans say. See README.md beside this file.

#include "../common/Cli.h"
#include "../common/map_input.h"
#include "../common/scan_input.h"
#include "LogSession.h"
#include "ViewServer.h"
#include "page_files.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/geometry/validation.h>
#include <mrpt_polyloc/io/wkt.h>

#include <csignal>
#include <filesystem>
#include <iostream>
#include <memory>
#include <pthread.h>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace {

using namespace mrpt_polyloc;
using namespace mrpt_polyloc::apps;

constexpr std::string_view kBuiltInMap = "niches.wkt";

std::string builtInMap() {
  for (const PageFile& file : pageFiles()) {
    if (file.name == kBuiltInMap) return std::string(file.text);
  }
  return {};
}

struct ViewOptions {
  std::string map;
  double scale = 1.0;
  std::string scans;
  std::string truth;
  ScanFileOptions file;
  std::uint64_t port = 8765;
  std::string listen = "127.0.0.1";
};

void addOptions(CLI::App& cli, ViewOptions& options) {
  CLI::Option* const positional = addText(
      cli, "MAP", options.map, std::string(kMapFormats) + " [default: the niches map, built in]");
  addText(cli, "--map", options.map, "The same")->type_name("MAP")->excludes(positional);
  addScaleOption(cli, options.scale);
  CLI::Option* const scans =
      addText(cli, "--scans", options.scans,
              "A log to look through: .rawlog or CARMEN .log/.clf, plain, gzip or zstd")
          ->type_name("FILE");
  addText(cli, "--truth", options.truth, "Where its scans were taken: TUM lines, matched by stamp")
      ->type_name("FILE")
      ->needs(scans);
  addReadingOptions(cli, options.file);
  addText(cli, "--sensor", options.file.sensor_label, "Only scans of the sensor of this label")
      ->type_name("LABEL");
  addNumber(
      cli, "--laser-fov",
      [&options](double degrees) { options.file.laser_fov = toRadians(degrees); },
      {0.0, 360.0, true}, "Field of view of a CARMEN laser, where the log does not say it")
      ->type_name("DEG");
  addCount(cli, "--port", options.port, 0, 65535, "Port to listen on; 0: any that is free [8765]")
      ->type_name("N");
  addText(cli, "--listen", options.listen,
          "Address to listen on, by number; others than this machine's own let anyone who reaches "
          "it ask [127.0.0.1]")
      ->type_name("ADDRESS");
}

PolygonMap loadServedMap(const Program& program, const ViewOptions& options) {
  if (!options.map.empty()) {
    return std::move(loadMapWithWarnings(program, options.map, options.scale).map);
  }
  return repairMap(parseWkt(builtInMap(), std::string(kBuiltInMap))).map;
}

/// Null if none is asked for.
std::unique_ptr<const LogSession> openLog(const Program& program, const ViewOptions& options) {
  if (options.scans.empty()) return nullptr;
  Notes notes;
  auto log = std::make_unique<const LogSession>(options.scans, options.file, options.truth, &notes);
  program.note(options.scans, notes);
  return log;
}

/// Ends the server on SIGINT and SIGTERM. These must be blocked in all threads.
class SignalWatch {
 public:
  SignalWatch(const sigset_t& signals, ViewServer& server)
      : watcher_([signals, &server] {
          int signal = 0;
          sigwait(&signals, &signal);
          server.stop();
        }) {}
  ~SignalWatch() {
    pthread_kill(watcher_.native_handle(), SIGTERM);  // where serving ended by itself
    watcher_.join();
  }

 private:
  std::thread watcher_;
};

int view(const Program& program, const ViewOptions& options) {
  if (options.listen != "localhost" && !isNumericAddress(options.listen)) {
    throw UsageError("--listen: '" + options.listen + "' is not an address by number");
  }
  const std::string address = options.listen == "localhost" ? "127.0.0.1" : options.listen;
  if (!isLoopback(address)) {
    program.warn("--listen " + options.listen +
                 ": whoever reaches this address may see the map and ask for searches");
  }
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // a client that goes away is its own affair

  const std::string name = options.map.empty()
                               ? std::string(kBuiltInMap)
                               : std::filesystem::path(options.map).filename().string();
  PolygonMap map = loadServedMap(program, options);
  const std::unique_ptr<const LogSession> log = openLog(program, options);
  const MapSession session(std::move(map), name);
  DriveStore drives;
  ViewServer server({session, drives, log.get()}, address);
  const int port = server.bind(static_cast<int>(options.port));
  const SignalWatch watch(signals, server);
  const std::string host = address.find(':') == std::string::npos ? address : "[" + address + "]";
  std::cout << "listening on http://" << host << ":" << port << "/" << std::endl;
  server.serve();
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("polyloc-view",
                  "Shows a map in the browser: place a robot in it, see its scan and every pose "
                  "that explains it.\nServes a page and a JSON API on this machine alone.");
  ViewOptions options;
  addOptions(program.options(), options);
  return program.run(argc, argv, [&] { return view(program, options); });
}
