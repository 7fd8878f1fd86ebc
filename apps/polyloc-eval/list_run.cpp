#include "list_run.h"

#include "../common/OutputFiles.h"
#include "EvaluationList.h"
#include "EvaluationRun.h"
#include "EvaluationStore.h"
#include "PreparedDataset.h"
#include "list_results.h"
#include <mrpt_polyloc/base/Checksum.h>
#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/result_json.h>
#include <mrpt_polyloc/version.h>

#include <algorithm>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <sys/file.h>
#include <unistd.h>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Rows that go to one share together: enough that an index built twice costs little.
constexpr std::size_t kRowsOfBlock = 100;

/// One line on a terminal: where the run is, and how long it may still take.
class RunProgress {
 public:
  explicit RunProgress(std::size_t jobs) : jobs_(jobs), visible_(::isatty(STDERR_FILENO) == 1) {}
  ~RunProgress() {
    if (visible_) std::cerr << "\r\033[K" << std::flush;
  }

  void begin(std::string name, std::size_t scans) {
    name_ = std::move(name);
    scans_ = scans;
    done_ = 0;
  }
  void step() {
    ++done_;
    print();
  }
  /// \param ran whether anything was left to do
  void end(bool ran) {
    ++finished_;
    if (ran) ++ran_;
  }

 private:
  void print() {
    if (!visible_ || since_print_.seconds() < 0.1) return;
    since_print_ = Stopwatch();
    const double part =
        static_cast<double>(done_) / static_cast<double>(std::max<std::size_t>(1, scans_));
    const double share = static_cast<double>(ran_) + part;
    const double left = watch_.seconds() / share * (static_cast<double>(jobs_ - finished_) - part);
    std::fprintf(stderr, "\r\033[K%zu/%zu %s: scan %zu/%zu, about %.0f min %02d s left",
                 finished_ + 1, jobs_, name_.c_str(), done_, scans_, std::floor(left / 60.0),
                 static_cast<int>(left) % 60);
  }

  std::size_t jobs_, finished_ = 0, ran_ = 0;
  std::string name_;
  std::size_t scans_ = 0, done_ = 0;
  Stopwatch watch_, since_print_;
  bool visible_;
};

/// Keeps two runs out of one folder.
class FolderLock {
 public:
  explicit FolderLock(const std::string& folder) {
    const std::string path = folder + "/parts/lock";
    descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw FormatError(path, "", "cannot be written");
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      ::close(descriptor_);
      throw FormatError(folder, "", "another run is writing here");
    }
  }
  ~FolderLock() { ::close(descriptor_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

ordered_json describe(const EvaluationList& list, const std::string& shard) {
  ordered_json run;
  run["format"] = kStoreFormat;
  run["version"] = kVersion;
  run["shard"] = shard;
  for (const DatasetEntry& dataset : list.datasets) run["datasets"].push_back(dataset.name);
  for (const MethodEntry& method : list.methods) {
    run["methods"].push_back(
        {{"name", method.name}, {"method", method.method}, {"options", method.arguments}});
  }
  return run;
}

/// What a killed program had not yet put in its place.
void removeTemporaries(const std::string& folder) {
  for (const std::string& place : {folder, folder + "/parts", folder + "/estimates"}) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(place, error)) {
      if (entry.path().filename().string().rfind(".tmp-", 0) == 0) fs::remove(entry, error);
    }
  }
}

/// \throws FormatError unless the folder is new, or holds this very run and may be gone on with
void openRun(const ListRunOptions& options, const ordered_json& run) {
  const std::string path = runPath(options.folder);
  std::error_code error;
  if (!fs::exists(path, error)) {
    writeFile(path, run.dump(1) + "\n");
    return;
  }
  if (!options.resume) {
    throw FormatError(options.folder, "", "holds a run already: --resume goes on with it");
  }
  const ordered_json there = readRunEntry(options.folder);
  for (const auto& item : run.items()) {
    if (!there.contains(item.key()) || there[item.key()] != item.value()) {
      throw FormatError(options.folder, "",
                        "holds another run, which cannot be gone on with: it differs in " +
                            item.key() +
                            "; with the old list it can, the new one needs another folder");
    }
  }
}

/// The options of a data set, but for what its hashes speak of.
std::vector<std::string> withoutFiles(const std::vector<std::string>& arguments) {
  std::vector<std::string> options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& name = arguments[i];
    if (name == "--map" || name == "--scans" || name == "--truth" || name == "--good") {
      ++i;  // its path, which another machine may have elsewhere
    } else {
      options.push_back(name);
    }
  }
  return options;
}

/// Empty for no file.
std::string hashOfFile(const std::string& path) {
  if (path.empty()) return "";
  const std::string text = GzInputStream(path).readAll();
  Checksum sum;
  sum.add(text.data(), text.size());
  return hashText(sum.value());
}

ordered_json identityOf(const DatasetEntry& entry, const MethodEntry& method,
                        const PreparedDataset& dataset) {
  ordered_json identity;
  identity["dataset"] = entry.name;
  identity["method"] = method.name;
  identity["version"] = kVersion;
  identity["map_hash"] = hashText(dataset.map.hash());
  identity["inputs_hash"] = dataset.inputs_hash;
  identity["dataset_options"] = withoutFiles(entry.arguments);
  identity["options"] = method.arguments;
  identity["calibration_hash"] = hashOfFile(optionsOf(entry, method).search.calibration_file);
  identity["kind"] = method.method;
  identity["every"] = entry.every;
  identity["rows"] = dataset.rows.size();
  return identity;
}

EvaluatedScan evaluated(const LocalizedScan& scan, const PreparedDataset& dataset,
                        const ScanJudge& judge, const Tolerance& tolerance) {
  const RangeScan& observed = dataset.inputs.scans[scan.row];
  EvaluatedScan result;
  result.record = scoreLocalized(scan, dataset.inputs.truth[scan.row], tolerance);
  result.match = scan.result.match_probability;
  result.traits = judge.traits(observed, result.record.truth);
  const std::size_t rank = result.record.score.right_rank;
  if (rank > 1) {
    const Hypothesis& right = scan.result.hypotheses[rank - 1];
    result.right = {right.pose_map_robot, right.z_score, right.weight};
  }
  if (result.isRight()) return result;
  for (const Beam& beam : observed.beams()) {
    if (beam.kind != BeamKind::hit) continue;
    result.hits.push_back({observed.sensor().x + beam.range * std::cos(beam.bearing),
                           observed.sensor().y + beam.range * std::sin(beam.bearing)});
  }
  return result;
}

/// Runs a list's jobs, data set by data set, so that a map is read once.
class ListRun {
 public:
  ListRun(const Program& program, const ListRunOptions& options, const EvaluationList& list)
      : program_(program),
        options_(options),
        list_(list),
        progress_(list.datasets.size() * list.methods.size()) {}

  /// \throws FormatError for a part of another version or run, before anything is run or written
  void readParts() {
    for (const DatasetEntry& dataset : list_.datasets) {
      for (const MethodEntry& method : list_.methods) {
        const std::string path = jobPath(options_.folder, dataset.name, method.name);
        if (auto part = JobFile(path).read()) parts_.emplace(path, *std::move(part));
      }
    }
  }

  void run() {
    for (std::size_t d = 0; d < list_.datasets.size(); ++d) runDataset(d);
  }

 private:
  void runDataset(std::size_t d) {
    const DatasetEntry& entry = list_.datasets[d];
    const EvaluationOptions common = optionsOf(entry, list_.methods.front());
    const PreparedDataset dataset = prepareDataset(program_, entry, common);
    std::vector<EvaluationJob> jobs;
    for (const MethodEntry& method : list_.methods) {
      EvaluationJob& job = jobs.emplace_back();
      job.identity = identityOf(entry, method, dataset);
      const std::string path = jobPath(options_.folder, entry.name, method.name);
      const auto part = parts_.find(path);
      if (part == parts_.end()) continue;
      job.add(part->second, path);
      parts_.erase(part);
    }
    writeFile(mapPath(options_.folder, entry.name),
              dataset.description(entry, common.tolerance).dump() + "\n");
    std::unique_ptr<const ScanJudge> judge;
    for (std::size_t m = 0; m < list_.methods.size(); ++m) {
      const MethodEntry& method = list_.methods[m];
      EvaluationJob& job = jobs[m];
      JobFile file(jobPath(options_.folder, entry.name, method.name));
      std::vector<std::size_t> rows = shareOf(dataset.rows, d + m);
      if (!job.scans.empty()) {
        rows.erase(std::remove_if(rows.begin(), rows.end(),
                                  [&](std::size_t row) { return job.scans.count(row) > 0; }),
                   rows.end());
      }
      const bool has_rows = !rows.empty();
      if (has_rows) {
        if (!judge) judge = std::make_unique<ScanJudge>(dataset.map);
        runJob(entry, method, dataset, *judge, rows, file, job);
      }
      progress_.end(has_rows);
    }
  }

  /// Blocks of rows go around among the shares; methods and data sets begin at different ones, so
  /// that no share gets all the dear ones.
  std::vector<std::size_t> shareOf(const std::vector<std::size_t>& rows, std::size_t first) const {
    std::vector<std::size_t> mine;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::size_t block = i / kRowsOfBlock + first;
      if (block % options_.shards == options_.shard - 1) mine.push_back(rows[i]);
    }
    return mine;
  }

  void runJob(const DatasetEntry& entry, const MethodEntry& method, const PreparedDataset& dataset,
              const ScanJudge& judge, const std::vector<std::size_t>& rows, JobFile& file,
              EvaluationJob& job) {
    EvaluationOptions options = optionsOf(entry, method);
    options.search.threads = options_.threads;
    const Stopwatch watch;
    const ScanLocalizer localizer =
        method.baseline ? makeBaseline(dataset.map, dataset.bitmap(entry, method.baseline->cell),
                                       *method.baseline)
                        : makeLocalizer(dataset.map, options.search, dataset.inputs.scans.size());
    job.index = {dataset.map_s + watch.seconds(), static_cast<double>(localizer.index_bytes) / 1e6};
    progress_.begin(entry.name + " " + method.name, rows.size());
    std::mutex mutex;
    bool is_open = false;
    const auto on_done = [&](const LocalizedScan& scan) {
      const EvaluatedScan done = evaluated(scan, dataset, judge, options.tolerance);
      const std::lock_guard<std::mutex> lock(mutex);
      if (!is_open) {
        job.cold_start_s = job.index.build_s + 1e-3 * scan.ms;
        file.open(job);
        is_open = true;
      }
      file.append(done);
      progress_.step();
    };
    const EvaluationInputs& inputs = dataset.inputs;
    if (options.sets.areAsked(options.search.file) && localizer.localize_set) {
      const DriveLog drive =
          inputs.drive ? *inputs.drive : loadDriveOf(program_, options, inputs.truth);
      localizeDrive(localizer, drive, options.sets, rows, {}, options.search, on_done);
    } else {
      localizeScans(localizer, inputs.scans, rows, {}, options.search, on_done);
    }
    file.sync();
  }

  const Program& program_;
  const ListRunOptions& options_;
  const EvaluationList& list_;
  std::map<std::string, EvaluationJob> parts_;  ///< by path: what an earlier run left
  RunProgress progress_;
};

}  // namespace

int runList(const Program& program, const ListRunOptions& options) {
  const EvaluationList list = loadEvaluationList(options.list);
  makeFolder(options.folder);
  makeFolder(options.folder + "/parts");
  const FolderLock lock(options.folder);
  const std::string shard = std::to_string(options.shard) + "/" + std::to_string(options.shards);
  openRun(options, describe(list, shard));
  ListRun run(program, options, list);
  run.readParts();
  removeTemporaries(options.folder);
  run.run();
  if (options.shards > 1) {
    std::cout << "share " << shard << " is done in " << options.folder
              << "; put all together with polyloc-eval merge DIR... -o OUT\n";
    return kDone;
  }
  writeResults(options.folder, options.command, options.threads);
  return kDone;
}

int mergeRuns(const Program&, const std::vector<std::string>& folders, const std::string& folder,
              const std::string& command) {
  ordered_json run;
  std::vector<std::pair<std::string, std::string>> files;  // path there, text
  std::map<std::string, EvaluationJob> jobs;
  std::map<std::string, std::string> maps;
  for (const std::string& part : folders) {
    ordered_json there = readRunEntry(part);
    there.erase("shard");
    if (run.is_null()) run = there;
    for (const auto& item : run.items()) {
      if (!there.contains(item.key()) || there[item.key()] != item.value()) {
        throw FormatError(part, "", "is of another run: it differs in " + item.key());
      }
    }
    for (const auto& dataset : run.at("datasets")) {
      const std::string name = dataset.get<std::string>();
      const std::string map = readMapEntry(part, name).dump() + "\n";
      if (!maps.emplace(name, map).second && maps[name] != map) {
        throw FormatError(mapPath(part, name), "", "is another map than in another share");
      }
      for (const auto& method : run.at("methods")) {
        const std::string path = jobPath(part, name, method.at("name"));
        const auto job = JobFile(path).read();
        if (!job) continue;
        const std::string key = name + "@" + method.at("name").get<std::string>();
        const auto [entry, is_new] = jobs.emplace(key, *job);
        if (!is_new) entry->second.add(*job, path);
      }
    }
  }
  for (const auto& dataset : run.at("datasets")) {
    for (const auto& method : run.at("methods")) {
      const std::string key =
          dataset.get<std::string>() + "@" + method.at("name").get<std::string>();
      const auto job = jobs.find(key);
      requireWhole(job == jobs.end() ? nullptr : &job->second, key);
    }
  }
  if (fs::exists(runPath(folder))) {
    throw FormatError(folder, "", "holds a run already: -o must be a new folder");
  }
  makeFolder(folder);
  makeFolder(folder + "/parts");
  run["shard"] = "1/1";
  for (const auto& [name, text] : maps) writeFile(mapPath(folder, name), text);
  for (const auto& [key, job] : jobs) {
    const std::size_t at = key.find('@');
    const std::string path = jobPath(folder, key.substr(0, at), key.substr(at + 1));
    fs::remove(path);
    JobFile file(path);
    file.open(job);
    for (const auto& entry : job.scans) file.append(entry.second);
    file.sync();
  }
  writeFile(runPath(folder), run.dump(1) + "\n");
  writeResults(folder, command, 0);
  return kDone;
}

}  // namespace mrpt_polyloc::apps
