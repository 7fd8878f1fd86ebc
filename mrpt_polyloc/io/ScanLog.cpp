#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/ScanLog.h>
#include <mrpt_polyloc/io/file_extension.h>
#include <mrpt_polyloc/io/scan_stream.h>
#include <mrpt_polyloc/io/sensor_survey.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <stdexcept>
#include <type_traits>
#include <unistd.h>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// The bytes of a scan: its numbers, its texts, its readings.
class Writer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    putBytes(&value, sizeof value);
  }
  void put(const std::string& text) {
    put<std::uint32_t>(static_cast<std::uint32_t>(text.size()));
    putBytes(text.data(), text.size());
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put<std::uint32_t>(static_cast<std::uint32_t>(values.size()));
    putBytes(values.data(), values.size() * sizeof(T));
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void putBytes(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  std::string bytes_;
};

class LogReader {
 public:
  explicit LogReader(const std::string& bytes) : bytes_(bytes) {}
  template <class T>
  void get(T& value) {
    getBytes(&value, sizeof value);
  }
  void get(std::string& text) {
    text.resize(size());
    getBytes(text.data(), text.size());
  }
  template <class T>
  void get(std::vector<T>& values) {
    values.resize(size());
    getBytes(values.data(), values.size() * sizeof(T));
  }

 private:
  std::size_t size() {
    std::uint32_t size = 0;
    get(size);
    return size;
  }
  void getBytes(void* data, std::size_t size) {
    if (size == 0) return;
    std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
};

template <class Archive, class Scan>
void transfer(Archive&& each, Scan& scan) {
  each(scan.max_range);
  each(scan.first);
  each(scan.step);
  each(scan.yaw);
  each(scan.pitch);
  each(scan.roll);
  each(scan.sensor.x);
  each(scan.sensor.y);
  each(scan.height);
  each(scan.stamp);
  each(scan.label);
  each(scan.place);
  each(scan.flags);
}

/// Rawlogs hold single precision, and half the bytes hold them exactly.
bool isSingle(const std::vector<double>& ranges) {
  return std::all_of(ranges.begin(), ranges.end(), [](double range) {
    return !(static_cast<double>(static_cast<float>(range)) != range) || range != range;
  });
}

std::string bytesOf(const LoggedScan& scan) {
  Writer writer;
  transfer([&](const auto& value) { writer.put(value); }, scan);
  const bool is_single = isSingle(scan.ranges);
  writer.put(is_single);
  if (is_single) {
    writer.put(std::vector<float>(scan.ranges.begin(), scan.ranges.end()));
  } else {
    writer.put(scan.ranges);
  }
  return writer.bytes();
}

LoggedScan scanOf(const std::string& bytes) {
  LogReader reader(bytes);
  LoggedScan scan;
  transfer([&](auto& value) { reader.get(value); }, scan);
  bool is_single = false;
  reader.get(is_single);
  if (is_single) {
    std::vector<float> ranges;
    reader.get(ranges);
    scan.ranges.assign(ranges.begin(), ranges.end());
  } else {
    reader.get(scan.ranges);
  }
  return scan;
}

ScanStreamEnd stream(const std::string& path, const ScanFileOptions& options, Notes* notes,
                     const TakeLoggedScan& take) {
  const std::string extension = contentExtension(path);
  if (extension == ".rawlog") return streamRawlog(path, options, notes, take);
  if (extension == ".log" || extension == ".clf") return streamCarmen(path, options, notes, take);
  loadScans(path, options, notes);  // says what is wrong
  throw FormatError(path, "", "not a log");
}

}  // namespace

struct ScanLog::Parts {
  std::FILE* file = nullptr;
  ScanStreamEnd end;
  std::unique_ptr<LogSurvey> survey;

  ~Parts() {
    if (file != nullptr) std::fclose(file);
  }
};

ScanLog::ScanLog(const std::string& path, const ScanFileOptions& options, Notes* notes)
    : path_(path), parts_(std::make_unique<Parts>()) {
  options.readings.check();
  parts_->file = std::tmpfile();
  if (parts_->file == nullptr) throw FormatError(path, "", "no temporary file for its scans");
  std::vector<Row> all;
  std::map<double, std::size_t> first_of;  // of each stated maximum range, which is surveyed apart
  long offset = 0;
  parts_->end = stream(path, options, notes, [&](const LoggedScan& scan) {
    const std::string bytes = bytesOf(scan);
    if (std::fwrite(bytes.data(), 1, bytes.size(), parts_->file) != bytes.size()) {
      throw FormatError(path, "", "no room for its scans in a temporary file");
    }
    first_of.emplace(std::isfinite(scan.max_range) ? scan.max_range : 0.0, all.size());
    all.push_back({offset, scan.stamp, bytes.size(), all.size()});
    offset += static_cast<long>(bytes.size());
  });
  if (std::fflush(parts_->file) != 0) {
    throw FormatError(path, "", "no room for its scans in a temporary file");
  }
  for (const std::size_t number : parts_->end.rows) rows_.push_back(all[number]);
  parts_->end.rows.clear();

  std::vector<LoggedScan> surveyed;
  const std::size_t count = std::min(rows_.size(), kSurveyed);
  for (std::size_t k = 0; k < count; ++k) surveyed.push_back(logged(rows_[k * size() / count]));
  if (count < size()) {
    for (const auto& [range, number] : first_of) surveyed.push_back(logged(all[number]));
  }
  parts_->survey = std::make_unique<LogSurvey>(surveyed, options.readings, notes);
}

ScanLog::~ScanLog() = default;

LoggedScan ScanLog::logged(const Row& row) const {
  std::string bytes(row.size, '\0');
  const auto got = ::pread(::fileno(parts_->file), bytes.data(), bytes.size(), row.offset);
  if (got != static_cast<ssize_t>(bytes.size())) {
    throw FormatError(path_, "scan " + std::to_string(row.number), "lost from the temporary file");
  }
  LoggedScan scan = scanOf(bytes);
  if (parts_->end.finish) parts_->end.finish(row.number, scan);
  return scan;
}

RangeScan ScanLog::scan(std::size_t row) const {
  const LoggedScan scan = logged(rows_.at(row));
  const SensorFacts& facts = parts_->survey->of(scan);
  try {
    return toRangeScan(scan, facts.limits, facts.robot_beams);
  } catch (const std::invalid_argument& error) {
    throw FormatError(path_, scan.place, error.what());
  }
}

}  // namespace mrpt_polyloc
