#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/file_extension.h>
#include <mrpt_polyloc/io/flat_yaml.h>
#include <mrpt_polyloc/io/gray_image.h>
#include <mrpt_polyloc/io/numbers.h>
#include <mrpt_polyloc/io/ros_map.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

namespace {

enum class Mode { trinary, scale, raw };

/// What the yaml says.
struct MapInfo {
  std::string image;
  double resolution = 0.0;
  mrpt::math::TPose2D origin{0, 0, 0};
  bool negate = false;
  Mode mode = Mode::trinary;
  double occupied_thresh = 0.65;
  double free_thresh = 0.25;
};

/// Reads the keys of one yaml file, each with its own complaint.
class InfoReader {
 public:
  explicit InfoReader(const std::string& path) : path_(path), keys_(loadFlatYaml(path)) {}

  MapInfo read() const {
    MapInfo info;
    info.image = scalar("image").value_or("");
    if (info.image.empty()) failMissing("image");
    info.resolution = number("resolution", std::nullopt);
    if (!(info.resolution > 0.0)) fail("resolution", "is not above 0");
    info.origin = origin();
    info.negate = negate();
    info.mode = mode();
    info.occupied_thresh = number("occupied_thresh", info.occupied_thresh);
    info.free_thresh = number("free_thresh", info.free_thresh);
    if (info.free_thresh > info.occupied_thresh) fail("free_thresh", "is above occupied_thresh");
    return info;
  }

  [[noreturn]] void fail(const std::string& key, const std::string& reason) const {
    throw FormatError(path_, "line " + std::to_string(keys_.at(key).line),
                      "'" + key + "' " + reason);
  }

 private:
  [[noreturn]] void failMissing(const std::string& key) const {
    throw FormatError(path_, "", "the key '" + key + "' is missing or empty");
  }

  std::optional<std::string> scalar(const std::string& key) const {
    const auto found = keys_.find(key);
    if (found == keys_.end() || (!found->second.is_list && found->second.scalars.empty())) {
      return std::nullopt;
    }
    if (found->second.is_list) fail(key, "is a list where one value is expected");
    return found->second.scalars.front();
  }

  double finite(const std::string& key, const std::string& text) const {
    const auto value = parseNumber(text);
    if (!value || !std::isfinite(*value)) fail(key, "is '" + text + "', not a finite number");
    return *value;
  }

  double number(const std::string& key, const std::optional<double>& otherwise) const {
    const auto text = scalar(key);
    if (text) return finite(key, *text);
    if (!otherwise) failMissing(key);
    return *otherwise;
  }

  mrpt::math::TPose2D origin() const {
    const auto found = keys_.find("origin");
    if (found == keys_.end()) failMissing("origin");
    const auto& scalars = found->second.scalars;
    if (!found->second.is_list || scalars.size() != 3) fail("origin", "is not a list [x, y, yaw]");
    return {finite("origin", scalars[0]), finite("origin", scalars[1]),
            finite("origin", scalars[2])};
  }

  bool negate() const {
    const auto text = scalar("negate");
    if (!text) return false;
    for (const char* no : {"0", "false", "False", "FALSE", "no", "off"}) {
      if (*text == no) return false;
    }
    for (const char* yes : {"1", "true", "True", "TRUE", "yes", "on"}) {
      if (*text == yes) return true;
    }
    fail("negate", "is '" + *text + "', not 0 or 1");
  }

  Mode mode() const {
    const std::string text = scalar("mode").value_or("trinary");
    if (text == "trinary") return Mode::trinary;
    if (text == "scale") return Mode::scale;
    if (text == "raw") return Mode::raw;
    fail("mode", "is '" + text + "', not trinary, scale or raw");
  }

  const std::string& path_;
  std::map<std::string, FlatYamlValue> keys_;
};

GrayImage loadImage(const std::string& yaml_path, const MapInfo& info) {
  const auto path = std::filesystem::path(yaml_path).parent_path() / info.image;
  if (!std::filesystem::exists(path)) {
    throw FormatError(yaml_path, "'image'", "there is no file " + path.string());
  }
  const std::string extension = contentExtension(path.string());
  try {
    if (extension == ".pgm") return loadPgm(path.string());
    if (extension == ".png") return loadPng(path.string());
  } catch (const FormatError& error) {
    throw FormatError(yaml_path, "'image'", error.what());
  }
  throw FormatError(yaml_path, "'image'",
                    path.string() + ": unknown kind of image, known are .pgm and .png");
}

/// State of one pixel; the rules are in the header.
CellState classify(const MapInfo& info, std::uint32_t value, std::uint32_t max_value,
                   Opacity opacity) {
  const double white = static_cast<double>(max_value);
  const double dark = static_cast<double>(info.negate ? value : max_value - value);
  double occupied = dark / white;
  if (info.mode == Mode::raw) {
    const double percent = std::round((white - dark) / white * 255.0);
    if (percent > 100.0) return CellState::unknown;
    occupied = percent / 100.0;
  } else if (opacity == Opacity::transparent ||
             (info.mode == Mode::scale && opacity == Opacity::partial)) {
    return CellState::unknown;
  }
  if (occupied > info.occupied_thresh) return CellState::occupied;
  return occupied < info.free_thresh ? CellState::free : CellState::unknown;
}

}  // namespace

OccupancyBitmap loadRosMap(const std::string& yaml_path) {
  const MapInfo info = InfoReader(yaml_path).read();
  const GrayImage image = loadImage(yaml_path, info);
  OccupancyBitmap bitmap;
  bitmap.width = image.width;
  bitmap.height = image.height;
  bitmap.resolution = info.resolution;
  bitmap.pose_map_bitmap = info.origin;
  bitmap.cells.reserve(image.values.size());
  const auto width = static_cast<std::size_t>(image.width);
  for (std::size_t row = 0; row < static_cast<std::size_t>(image.height); ++row) {
    const std::size_t image_row = static_cast<std::size_t>(image.height) - 1 - row;
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t i = image_row * width + column;
      const Opacity opacity = image.opacity.empty() ? Opacity::opaque : image.opacity[i];
      bitmap.cells.push_back(classify(info, image.values[i], image.max_value, opacity));
    }
  }
  return bitmap;
}

}  // namespace mrpt_polyloc
