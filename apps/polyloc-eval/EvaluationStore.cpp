#include "EvaluationStore.h"

#include <mrpt_polyloc/base/errors.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <unistd.h>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPose2D;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kWayOut =
    "written by another version of polyloc-eval. Go on with that version, or run anew into another "
    "folder (-o); nothing here was changed";

/// A field that a version which wrote the file did not know.
struct MissingField : std::runtime_error {
  explicit MissingField(const std::string& name)
      : std::runtime_error("has no '" + name + "': " + kWayOut) {}
};

template <class Json>
const Json& field(const Json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end()) throw MissingField(name);
  return *found;
}

json toJson(const TPose2D& pose) {
  return {pose.x, pose.y, pose.phi};
}

TPose2D poseOf(const json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

/// JSON has no NaN; the library writes null.
double numberOf(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

LocalizationStatus statusOf(const std::string& name) {
  for (int i = 0; i < 4; ++i) {
    const auto status = static_cast<LocalizationStatus>(i);
    if (name == toString(status)) return status;
  }
  throw std::runtime_error("unknown status '" + name + "'");
}

ordered_json toJson(const EvaluatedScan& scan) {
  const ScanRecord& record = scan.record;
  ordered_json line;
  line["row"] = record.row;
  line["stamp"] = record.stamp;
  line["truth"] = toJson(record.truth);
  line["status"] = toString(record.score.status);
  line["rank"] = record.score.right_rank;
  line["in_ellipse"] = record.score.in_ellipse;
  line["n"] = record.hypotheses;
  line["error"] = {record.score.error_m, record.score.error_rad};
  line["ms"] = record.score.ms;
  line["match"] = scan.match;
  if (record.answer) {
    line["pose"] = toJson(record.answer->pose_map_robot);
    line["cost"] = record.answer->cost;
    line["weight"] = record.answer->weight;
  }
  if (scan.right) {
    line["right"] = toJson(scan.right->pose_map_robot);
    line["right_z"] = scan.right->z_score;
    line["right_weight"] = scan.right->weight;
  }
  const ScanTraits& t = scan.traits;
  line["traits"] = {t.fov, t.hits, t.clutter, t.passed, t.outside};
  if (!scan.hits.empty()) {  // centimetres: for pictures
    std::vector<long> points;
    for (const auto& hit : scan.hits) {
      points.push_back(std::lround(100.0 * hit.x));
      points.push_back(std::lround(100.0 * hit.y));
    }
    line["points"] = points;
  }
  return line;
}

EvaluatedScan scanOf(const json& line) {
  EvaluatedScan scan;
  ScanRecord& record = scan.record;
  record.row = field(line, "row");
  record.stamp = field(line, "stamp");
  record.truth = poseOf(field(line, "truth"));
  record.score.status = statusOf(field(line, "status"));
  record.score.right_rank = field(line, "rank");
  record.score.in_ellipse = field(line, "in_ellipse");
  record.hypotheses = field(line, "n");
  record.score.error_m = numberOf(field(line, "error").at(0));
  record.score.error_rad = numberOf(field(line, "error").at(1));
  record.score.ms = field(line, "ms");
  scan.match = field(line, "match");
  if (line.contains("pose")) {
    record.answer.emplace();
    record.answer->pose_map_robot = poseOf(field(line, "pose"));
    record.answer->cost = numberOf(field(line, "cost"));
    record.answer->weight = field(line, "weight");
  }
  if (line.contains("right")) {
    scan.right = {poseOf(field(line, "right")), numberOf(field(line, "right_z")),
                  field(line, "right_weight")};
  }
  const json& traits = field(line, "traits");
  scan.traits = {traits.at(0), traits.at(1), traits.at(2), traits.at(3), numberOf(traits.at(4))};
  if (line.contains("points")) {
    const json& points = field(line, "points");
    for (std::size_t i = 0; i + 1 < points.size(); i += 2) {
      scan.hits.push_back({0.01 * points[i].get<double>(), 0.01 * points[i + 1].get<double>()});
    }
  }
  return scan;
}

std::string readWhole(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// \throws FormatError
ordered_json readStored(const std::string& path, const std::vector<const char*>& fields) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FormatError(path, "", "cannot be read: no run of polyloc-eval is here");
  ordered_json stored;
  try {
    stored = ordered_json::parse(in);
  } catch (const std::exception& error) {
    throw FormatError(path, "", std::string("is damaged: ") + error.what());
  }
  try {
    for (const char* name : fields) field(stored, name);
  } catch (const MissingField& error) {
    throw FormatError(path, "", error.what());
  }
  return stored;
}

}  // namespace

bool EvaluatedScan::isRight() const {
  return record.score.right_rank == 1 && record.score.status != LocalizationStatus::no_match &&
         record.score.status != LocalizationStatus::too_few_beams;
}

void EvaluationJob::add(const EvaluationJob& other, const std::string& place) {
  if (other.identity != identity) {
    std::string differs;
    for (const auto& item : identity.items()) {
      if (!other.identity.contains(item.key()) || other.identity[item.key()] != item.value()) {
        differs += (differs.empty() ? "" : ", ") + item.key();
      }
    }
    throw FormatError(place, "",
                      "is of another run: it differs in " + differs + " (-o: another folder)");
  }
  for (const auto& [row, scan] : other.scans) {
    if (!scans.emplace(row, scan).second) {
      throw FormatError(place, "", "row " + std::to_string(row) + " is there a second time");
    }
  }
}

JobFile::~JobFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::optional<EvaluationJob> JobFile::read() const {
  std::error_code ignored;
  if (!std::filesystem::exists(path_, ignored)) return std::nullopt;
  if (!std::filesystem::is_regular_file(path_, ignored)) {
    throw FormatError(path_, "", "is no regular file");
  }
  const std::string text = readWhole(path_);
  EvaluationJob job;
  bool has_header = false;
  std::size_t number = 1;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;  // torn by a kill
    try {
      const auto line = ordered_json::parse(text.begin() + static_cast<std::ptrdiff_t>(begin),
                                            text.begin() + static_cast<std::ptrdiff_t>(end));
      if (!has_header) {
        job.identity = field(line, "identity");
        job.index = {field(line, "index_build_s"), field(line, "index_mb")};
        job.cold_start_s = field(line, "cold_start_s");
        has_header = true;
      } else {
        EvaluatedScan scan = scanOf(line);
        const std::size_t row = scan.record.row;
        if (!job.scans.emplace(row, std::move(scan)).second) {
          throw std::runtime_error("row " + std::to_string(row) + " a second time");
        }
      }
    } catch (const MissingField& error) {
      throw FormatError(path_, "line " + std::to_string(number), error.what());
    } catch (const std::exception& error) {
      throw FormatError(path_, "line " + std::to_string(number),
                        std::string("is not of polyloc-eval: ") + error.what());
    }
    begin = end + 1;
  }
  if (!has_header) return std::nullopt;
  return job;
}

void JobFile::open(const EvaluationJob& job) {
  const std::string text = readWhole(path_);
  const std::size_t whole = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0 || ::ftruncate(descriptor_, static_cast<off_t>(whole)) != 0) {
    throw FormatError(path_, "", std::string("cannot be written: ") + std::strerror(errno));
  }
  if (whole > 0) return;
  ordered_json header;
  header["identity"] = job.identity;
  header["index_build_s"] = job.index.build_s;
  header["index_mb"] = job.index.mb;
  header["cold_start_s"] = job.cold_start_s;
  write(header.dump() + "\n");
}

void JobFile::append(const EvaluatedScan& scan) {
  write(toJson(scan).dump() + "\n");
}

void JobFile::sync() {
  if (::fsync(descriptor_) != 0) {
    throw FormatError(path_, "", std::string("cannot be written: ") + std::strerror(errno));
  }
}

void JobFile::write(const std::string& line) {
  // One call a line: a kill leaves whole lines, but for the last.
  for (std::size_t done = 0; done < line.size();) {
    const ssize_t count = ::write(descriptor_, line.data() + done, line.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      throw FormatError(path_, "", std::string("cannot be written: ") + std::strerror(errno));
    }
    done += static_cast<std::size_t>(count);
  }
}

std::string jobPath(const std::string& folder, const std::string& dataset,
                    const std::string& method) {
  return folder + "/parts/" + dataset + "@" + method + ".jsonl";
}

std::string mapPath(const std::string& folder, const std::string& dataset) {
  return folder + "/parts/" + dataset + ".map.json";
}

std::string runPath(const std::string& folder) {
  return folder + "/parts/run.json";
}

ordered_json readRunEntry(const std::string& folder) {
  const std::string path = runPath(folder);
  ordered_json run = readStored(path, {"format", "version", "shard", "datasets", "methods"});
  if (run["format"] != kStoreFormat) {
    throw FormatError(path, "",
                      "format " + run["format"].dump() + ", not " + std::to_string(kStoreFormat) +
                          ": " + kWayOut);
  }
  return run;
}

ordered_json readMapEntry(const std::string& folder, const std::string& dataset) {
  return readStored(mapPath(folder, dataset), {"statistics", "simulated", "good", "stretches",
                                               "tolerance_m", "tolerance_deg", "outline"});
}

}  // namespace mrpt_polyloc::apps
