#include "scan_sets.h"

#include "Progress.h"
#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/errors.h>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <functional>
#include <utility>

namespace mrpt_polyloc::apps {

bool SetOptions::areAsked(const ScanFileOptions& file) const {
  return accumulate > 0.0 || file.sensor_label == "all" ||
         file.sensor_label.find(',') != std::string::npos;
}

void addSetOptions(CLI::App& cli, SetOptions& sets, ScanFileOptions& file) {
  addText(cli, "--sensor", file.sensor_label,
          "Only scans of these sensors; of several the scans of one moment (a frame, or 50 ms) are "
          "one row")
      ->type_name("LABEL[,LABEL...]|all");
  addNumber(cli, "--accumulate", sets.accumulate, {0.0, 1e3},
            "Localize each row with the scans of the last M metres of odometry before it, too "
            "[default: 0, alone]")
      ->type_name("M");
}

DriveLog loadSearchedDrive(const Program& program, const SearchOptions& search,
                           const SetOptions& sets) {
  if (search.method != "certified") {
    throw UsageError("--accumulate, several sensors and several maps need --method certified");
  }
  Notes notes;
  DriveLog drive = loadDrive(search.scans, search.file, sets.noise, &notes);
  program.note(search.scans, notes);
  return drive;
}

std::vector<RangeScan> firstScans(const DriveLog& drive) {
  std::vector<RangeScan> scans;
  for (const Moment& moment : drive.moments) scans.push_back(moment.scans.front());
  return scans;
}

namespace {

/// \throws FormatError naming file and row where the drive is none: stamps that fall
ScanSet lastMetresOf(const DriveLog& drive, std::size_t row, const LastMetresParams& last,
                     const std::string& file) {
  try {
    return lastMetres(drive.moments, row, last);
  } catch (const InvalidParamsError& error) {
    throw FormatError(file, "row " + std::to_string(row), error.what());
  }
}

/// Localizes rows of a drive, so many threads at a time.
std::vector<LocalizedScan> localizeRows(
    const DriveLog& drive, const SetOptions& sets, const std::vector<std::size_t>& rows,
    const SearchOptions& search, const std::function<void(const ScanSet&, LocalizedScan&)>& take,
    const std::function<void(const LocalizedScan&)>& on_done = {}) {
  if (sets.accumulate > 0.0 && !drive.has_odometry) {
    throw FormatError(search.scans, "--accumulate",
                      "the log does not say how the robot moved: there is no odometry in it");
  }
  LastMetresParams last;
  last.length = sets.accumulate;
  last.most_moments = sets.most_moments;
  last.longest_step = sets.longest_step;
  std::vector<LocalizedScan> localized(rows.size());
  std::optional<Progress> progress;
  if (!on_done) progress.emplace("scan", rows.size());
  const auto step = [&](std::size_t i) {
    const ScanSet set = lastMetresOf(drive, rows[i], last, search.scans);
    const Stopwatch watch;
    take(set, localized[i]);
    localized[i].row = rows[i];
    localized[i].stamp = set.now().scans.front().stamp();
    localized[i].ms = 1e3 * watch.seconds();
    if (on_done) on_done(localized[i]);
    if (progress) progress->step();
  };
  if (search.threads > 1) {
    tbb::task_arena arena(static_cast<int>(search.threads));
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, rows.size(), step); });
  } else {
    for (std::size_t i = 0; i < rows.size(); ++i) step(i);
  }
  return localized;
}

}  // namespace

std::vector<LocalizedScan> localizeDrive(const ScanLocalizer& localizer, const DriveLog& drive,
                                         const SetOptions& sets,
                                         const std::vector<std::size_t>& rows,
                                         const PosePrior& prior, const SearchOptions& search,
                                         const std::function<void(const LocalizedScan&)>& on_done) {
  return localizeRows(
      drive, sets, rows, search,
      [&](const ScanSet& set, LocalizedScan& scan) {
        scan.result = localizer.localize_set(set, prior);
      },
      on_done);
}

std::vector<LocalizedScan> localizeDrive(const MultiMapSearch& localize,
                                         const std::vector<std::string>& names,
                                         const DriveLog& drive, const SetOptions& sets,
                                         const std::vector<std::size_t>& rows,
                                         const PosePrior& prior, const SearchOptions& search) {
  return localizeRows(drive, sets, rows, search, [&](const ScanSet& set, LocalizedScan& scan) {
    std::vector<std::size_t> maps;
    scan.result = localize(set, prior, maps);
    for (const std::size_t map : maps) scan.maps.push_back(names[map]);
  });
}

}  // namespace mrpt_polyloc::apps
