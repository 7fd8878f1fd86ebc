#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/io/GzInputStream.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>

namespace mrpt_polyloc {

namespace {

// A millisecond, and as much more as stamps around 1.7e9 s lose by being doubles.
constexpr double kStampTolerance = 1e-3 + 1e-6;
constexpr double kQuaternionTolerance = 1e-2;
constexpr std::string_view kBlanks = " \t\r\v\f";

std::vector<std::string_view> splitFields(std::string_view line) {
  std::vector<std::string_view> fields;
  std::size_t begin = line.find_first_not_of(kBlanks);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return fields;
}

/// Calls `use(fields, place)` for every line of a file, perhaps compressed, that holds more than a
/// comment.
template <class Use>
void forEachLine(const std::string& path, Use use) {
  GzInputStream stream(path);
  std::string line;
  for (std::size_t number = 1; stream.readLine(line); ++number) {
    const std::string_view content = std::string_view(line).substr(0, line.find('#'));
    const std::vector<std::string_view> fields = splitFields(content);
    if (!fields.empty()) use(fields, "line " + std::to_string(number));
  }
}

double finiteNumber(std::string_view text, const std::string& path, const std::string& place) {
  const auto value = parseNumber(text);
  if (!value || !std::isfinite(*value)) {
    throw FormatError(path, place, "'" + std::string(text) + "' is not a finite number");
  }
  return *value;
}

StampedPose parsePose(const std::vector<std::string_view>& fields, const std::string& path,
                      const std::string& place) {
  constexpr std::size_t kFields = 8;
  if (fields.size() != kFields)
    throw FormatError(
        path, place,
        "expected 8 fields (stamp x y z qx qy qz qw), got " + std::to_string(fields.size()));
  std::array<double, kFields> v{};
  for (std::size_t i = 0; i < kFields; ++i) v[i] = finiteNumber(fields[i], path, place);
  const double qx = v[4], qy = v[5], qz = v[6], qw = v[7];
  const double length = std::sqrt(qx * qx + qy * qy + qz * qz + qw * qw);
  if (std::abs(length - 1.0) > kQuaternionTolerance)
    throw FormatError(path, place, "quaternion of length " + formatted("%.6f", length) + ", not 1");
  // The yaw for a quaternion of any length, so that rounding in the file does no harm.
  const double yaw = std::atan2(2.0 * (qw * qz + qx * qy), qw * qw + qx * qx - qy * qy - qz * qz);
  return {v[0], {v[1], v[2], yaw}};
}

}  // namespace

std::vector<StampedPose> loadTum(const std::string& path) {
  std::vector<StampedPose> poses;
  forEachLine(path, [&](const auto& fields, const std::string& place) {
    poses.push_back(parsePose(fields, path, place));
  });
  if (poses.empty()) throw FormatError(path, "", "holds no pose");
  return poses;
}

std::string toTum(const std::vector<StampedPose>& poses) {
  std::string text;
  for (const StampedPose& stamped : poses) {
    const auto& pose = stamped.pose_map_robot;
    text += formatted("%.9f %.6f %.6f 0 0 0 %.9f %.9f\n", stamped.stamp, pose.x, pose.y,
                      std::sin(pose.phi / 2.0), std::cos(pose.phi / 2.0));
  }
  return text;
}

std::vector<mrpt::math::TPose2D> matchTruth(const std::vector<RangeScan>& scans,
                                            const std::vector<StampedPose>& truth,
                                            const std::string& path) {
  std::vector<std::size_t> by_stamp(truth.size());
  std::iota(by_stamp.begin(), by_stamp.end(), std::size_t{0});
  std::stable_sort(by_stamp.begin(), by_stamp.end(),
                   [&](std::size_t a, std::size_t b) { return truth[a].stamp < truth[b].stamp; });

  std::vector<mrpt::math::TPose2D> poses;
  poses.reserve(scans.size());
  std::vector<bool> used(truth.size(), false);
  for (std::size_t row = 0; row < scans.size(); ++row) {
    const double stamp = scans[row].stamp();
    const auto first = std::lower_bound(
        by_stamp.begin(), by_stamp.end(), stamp - kStampTolerance,
        [&](std::size_t index, double value) { return truth[index].stamp < value; });
    const auto isNear = [&](auto it) {
      return it != by_stamp.end() && truth[*it].stamp <= stamp + kStampTolerance;
    };
    const std::string place =
        "scan " + std::to_string(row) + " (stamp " + formatted("%.6f", stamp) + ")";
    if (!isNear(first)) throw FormatError(path, place, "no pose within 1 ms");
    if (isNear(first + 1)) throw FormatError(path, place, "several poses within 1 ms");
    used[*first] = true;
    poses.push_back(truth[*first].pose_map_robot);
  }
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused != used.end()) {
    const auto index = static_cast<std::size_t>(unused - used.begin());
    throw FormatError(
        path,
        "pose " + std::to_string(index) + " (stamp " + formatted("%.6f", truth[index].stamp) + ")",
        "no scan within 1 ms");
  }
  return poses;
}

std::vector<std::optional<mrpt::math::TPose2D>> loadIndexedTruth(const std::string& path,
                                                                 std::size_t count) {
  std::vector<std::optional<mrpt::math::TPose2D>> poses(count);
  bool is_empty = true;
  forEachLine(path, [&](const auto& fields, const std::string& place) {
    constexpr std::size_t kFields = 4;
    if (fields.size() != kFields)
      throw FormatError(path, place,
                        "expected 4 fields (index x y phi), got " + std::to_string(fields.size()));
    std::array<double, kFields> v{};
    for (std::size_t i = 0; i < kFields; ++i) v[i] = finiteNumber(fields[i], path, place);
    const std::string name = "index " + std::string(fields[0]);
    if (v[0] < 0.0 || v[0] != std::floor(v[0]))
      throw FormatError(path, place, name + " is no whole number from 0");
    if (v[0] >= static_cast<double>(count))
      throw FormatError(path, place, name + ", but there are only " + std::to_string(count));
    auto& pose = poses[static_cast<std::size_t>(v[0])];
    if (pose) throw FormatError(path, place, name + " a second time");
    pose = mrpt::math::TPose2D(v[1], v[2], v[3]);
    is_empty = false;
  });
  if (is_empty) throw FormatError(path, "", "holds no pose");
  return poses;
}

bool isIndexedTruth(const std::string& path) {
  std::size_t count = 0;
  forEachLine(path, [&](const auto& fields, const std::string&) {
    if (count == 0) count = fields.size();
  });
  return count == 4;
}

std::vector<std::size_t> loadRows(const std::string& path, std::size_t rows) {
  std::vector<std::size_t> result;
  std::vector<bool> seen(rows, false);
  forEachLine(path, [&](const auto& fields, const std::string& place) {
    if (fields.size() != 1) throw FormatError(path, place, "expected one row number");
    const auto number = parseCount(fields[0]);
    if (!number)
      throw FormatError(path, place, "'" + std::string(fields[0]) + "' is not a row number");
    const std::size_t row = *number;
    if (row >= rows)
      throw FormatError(path, place,
                        "row " + std::to_string(row) + " of " + std::to_string(rows) + " scans");
    if (seen[row]) throw FormatError(path, place, "row " + std::to_string(row) + " a second time");
    seen[row] = true;
    result.push_back(row);
  });
  return result;
}

}  // namespace mrpt_polyloc
