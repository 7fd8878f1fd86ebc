#pragma once

#include <mrpt_polyloc/evaluation/ScanTraits.h>
#include <mrpt_polyloc/evaluation/summary_json.h>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// Of what is kept in the folder of a run. To be raised whenever a field comes, goes or means
/// something else: an older run is then refused rather than mixed with, or misread.
constexpr int kStoreFormat = 2;

/// All that is kept of a scan that a method was given.
struct EvaluatedScan {
  ScanRecord record;
  /// Where a hypothesis other than the first is the first right one.
  struct Right {
    mrpt::math::TPose2D pose_map_robot;
    double z_score = 0.0;
    double weight = 0.0;
  };
  std::optional<Right> right;
  double match = 0.0;  ///< probability that the scan was taken in the map
  ScanTraits traits;
  /// The hits in the robot frame [m], of misses alone: for their pictures.
  std::vector<mrpt::math::TPoint2D> hits;

  /// Whether the first answer is right and not withdrawn by its status.
  bool isRight() const;
};

/// A data set and a method: what was run, and what came out so far.
struct EvaluationJob {
  /// What results hang on: names, options, version, the map's and the inputs' hash, numbers of
  /// scans. Two parts belong together exactly if these are equal.
  nlohmann::ordered_json identity;
  IndexFigures index;
  double cold_start_s = 0.0;                   ///< loading, index, first answer
  std::map<std::size_t, EvaluatedScan> scans;  ///< by row

  /// Another run's share of the same job. \param place of it, for messages
  /// \throws FormatError if it is another job, or a row is there twice
  void add(const EvaluationJob& other, const std::string& place);
};

/// The file of a job: a line of JSON that says what it is, then one a scan, in the order in which
/// they were done. What a killed run leaves is whole lines and perhaps a torn last one, which is
/// dropped; the file is appended to and never written anew, so that nothing is lost.
class JobFile {
 public:
  explicit JobFile(std::string path) : path_(std::move(path)) {}
  ~JobFile();
  JobFile(const JobFile&) = delete;
  JobFile& operator=(const JobFile&) = delete;

  /// What is there; none if there is no whole line. \throws FormatError naming file and line
  std::optional<EvaluationJob> read() const;
  /// Opens for appending, without a torn last line; a new file gets its first line.
  /// \throws FormatError naming the file
  void open(const EvaluationJob& job);
  /// Appends a scan. Thread-safe where the caller locks. \throws FormatError if the disk is full
  void append(const EvaluatedScan& scan);
  /// Has the system write everything out.
  void sync();

 private:
  void write(const std::string& line);

  std::string path_;
  int descriptor_ = -1;
};

/// Where a job is kept below the folder of a run.
std::string jobPath(const std::string& folder, const std::string& dataset,
                    const std::string& method);
/// Where the map of a data set is kept: {statistics, rings, kinds, beyond}, in centimetres.
std::string mapPath(const std::string& folder, const std::string& dataset);
/// Where it is kept what the run is: {format, version, shard, datasets, methods}.
std::string runPath(const std::string& folder);

/// What the two hold. \throws FormatError naming file and field if it is not there, damaged, or
/// written by another version of polyloc-eval
nlohmann::ordered_json readRunEntry(const std::string& folder);
nlohmann::ordered_json readMapEntry(const std::string& folder, const std::string& dataset);

}  // namespace mrpt_polyloc::apps
