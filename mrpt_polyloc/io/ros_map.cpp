#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/io/flat_yaml.h>
#include <mrpt_polyloc/io/gray_image.h>
#include <mrpt_polyloc/io/ros_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <system_error>
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

std::string text(double number) {
  return formatted("%g", number);
}

std::string thresholds(const MapInfo& info) {
  return "'free_thresh' " + text(info.free_thresh) + " and 'occupied_thresh' " +
         text(info.occupied_thresh);
}

/// YAML's ways of writing it, and those of programs that print a float.
bool isNan(const std::string& scalar) {
  std::string letters;
  for (const char c : scalar) {
    if (c >= 'A' && c <= 'Z') letters += static_cast<char>(c - 'A' + 'a');
    if (c >= 'a' && c <= 'z') letters += c;
  }
  return letters == "nan" && scalar.size() <= 5;
}

/// Reads the keys of one yaml file, each with its own complaint.
class InfoReader {
 public:
  explicit InfoReader(const std::string& path) : path_(path), keys_(loadFlatYaml(path)) {}

  MapInfo read(Notes* notes) const {
    MapInfo info;
    info.image = scalar("image").value_or("");
    if (info.image.empty()) failMissing("image");
    info.resolution = number("resolution", std::nullopt);
    if (!(info.resolution > 0.0)) fail("resolution", "is not above 0");
    info.origin = origin(notes);
    info.negate = negate();
    info.mode = mode();
    info.occupied_thresh = number("occupied_thresh", info.occupied_thresh);
    info.free_thresh = number("free_thresh", info.free_thresh);
    if (info.free_thresh > info.occupied_thresh) {
      addNote(notes, thresholds(info) + ": they are crossed, so that what both would take is " +
                         "occupied, as map_server has it");
    }
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
    if (found != keys_.end() && found->second.is_nested) {
      fail(key, "is nested where one value is expected");
    }
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

  mrpt::math::TPose2D origin(Notes* notes) const {
    const auto found = keys_.find("origin");
    if (found == keys_.end()) failMissing("origin");
    const auto& scalars = found->second.scalars;
    if (found->second.is_nested || !found->second.is_list || scalars.size() != 3)
      fail("origin", "is not a list [x, y, yaw]");
    mrpt::math::TPose2D pose{finite("origin", scalars[0]), finite("origin", scalars[1]), 0.0};
    if (isNan(scalars[2])) {  // some map savers write a yaw that was never set
      addNote(notes, "'origin' has the yaw '" + scalars[2] + "': taken for 0");
    } else {
      pose.phi = finite("origin", scalars[2]);
    }
    return pose;
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

/// The image that the yaml names: `~` is the home folder; an absolute path that is not there, for
/// it is one of another machine, is looked for beside the yaml.
std::filesystem::path imagePath(const std::string& yaml_path, const MapInfo& info, Notes* notes) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(yaml_path).parent_path();
  fs::path path = info.image;
  if (info.image.compare(0, 2, "~/") == 0) {
    const char* home = std::getenv("HOME");
    if (home != nullptr) path = fs::path(home) / info.image.substr(2);
  }
  path = folder / path;
  std::error_code ignored;
  if (fs::exists(path, ignored)) return path;
  const fs::path beside = folder / fs::path(info.image).filename();
  const bool is_relative = fs::path(info.image).is_relative() && info.image[0] != '~';
  if (is_relative || !fs::is_regular_file(beside, ignored)) {
    throw FormatError(yaml_path, "'image'", "there is no file " + path.string());
  }
  addNote(notes, "'image': there is no " + path.string() + ", taken is " + beside.string());
  return beside;
}

GrayImage loadMapImage(const std::string& yaml_path, const MapInfo& info, Notes* notes) {
  const std::string path = imagePath(yaml_path, info, notes).string();
  try {
    return loadImage(path);
  } catch (const FormatError& error) {
    throw FormatError(yaml_path, "'image'", error.what());
  }
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

// What map_saver writes, whatever thresholds it writes beside it.
constexpr std::uint32_t kSavedUnknown = 205;
constexpr std::uint32_t kSavedFree = 254;

/// Whether an image has only the levels of a map_saver: 0, 205 and 254 (or 255).
bool isMapSavers(const MapInfo& info, const GrayImage& image) {
  if (info.mode != Mode::trinary || info.negate || image.max_value % 255 != 0) return false;
  const std::uint32_t colours = image.max_value / 255;
  if (colours != 1 && colours != 3) return false;
  bool has_unknown = false, has_free = false;
  for (const std::uint32_t value : image.values) {
    const std::uint32_t level = value / colours;
    const bool is_free = level >= kSavedFree;
    if (level * colours != value || (level != 0 && level != kSavedUnknown && !is_free)) {
      return false;
    }
    has_unknown |= level == kSavedUnknown;
    has_free |= is_free;
  }
  return has_unknown && has_free;
}

/// How many cells are what, and which levels the image has.
std::string sharesText(const MapInfo& info, const GrayImage& image, const OccupancyBitmap& bitmap) {
  std::array<std::size_t, 3> counts{};
  for (const CellState cell : bitmap.cells) ++counts[static_cast<std::size_t>(cell)];
  const auto percent = [&](CellState state) {
    return formatted("%.3g %%", 100.0 *
                                    static_cast<double>(counts[static_cast<std::size_t>(state)]) /
                                    static_cast<double>(bitmap.cells.size()));
  };
  const auto [low, high] = std::minmax_element(image.values.begin(), image.values.end());
  const double to_byte = 255.0 / static_cast<double>(image.max_value);
  const auto level = [&](std::uint32_t value) { return text(std::round(value * to_byte)); };
  return percent(CellState::free) + " is free, " + percent(CellState::occupied) + " occupied, " +
         percent(CellState::unknown) + " unknown by " + thresholds(info) +
         "; the levels of the image are " + level(*low) + " to " + level(*high);
}

/// Thresholds that part the most frequent level from what is darker and brighter: in grey maps, as
/// Cartographer draws them, that is the unknown.
std::string otherThresholds(const MapInfo& info, const GrayImage& image) {
  if (info.mode == Mode::raw) return "";
  std::map<std::uint32_t, std::size_t> counts;
  for (const std::uint32_t value : image.values) ++counts[value];
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  const double white = image.max_value;
  const double bright = most->first / white;
  const double occupied = info.negate ? bright : 1.0 - bright;
  constexpr double kMargin = 0.02;  // five levels of 255
  if (occupied < 2 * kMargin || occupied > 1.0 - 2 * kMargin) return "";
  const auto rounded = [](double x) { return text(std::round(100 * x) / 100); };
  return "; if its most frequent level " + text(std::round(255 * bright)) +
         " is the unknown, 'free_thresh: " + rounded(occupied - kMargin) +
         "' and 'occupied_thresh: " + rounded(occupied + kMargin) + "' would do";
}

/// Notes where what was never seen may have become free.
void noteUnknown(const MapInfo& info, const GrayImage& image, const OccupancyBitmap& bitmap,
                 bool saved_unknown, Notes* notes) {
  constexpr double kNearlyNothing = 0.005;
  if (saved_unknown) {
    addNote(notes, "'free_thresh' " + text(info.free_thresh) +
                       " would make cells of level 205 free, which map_saver writes where nothing "
                       "was seen: they are taken for unknown ('free_thresh: 0.196' says so)");
    return;
  }
  if (info.free_thresh > info.occupied_thresh) return;  // as is told already
  const auto unknown = std::count(bitmap.cells.begin(), bitmap.cells.end(), CellState::unknown);
  if (static_cast<double>(unknown) < kNearlyNothing * static_cast<double>(bitmap.cells.size())) {
    addNote(notes, "nearly nothing of it is unknown: " + sharesText(info, image, bitmap) +
                       "; what was never seen counts as free if 'free_thresh' is too high");
  }
}

/// The states of all values of an opacity: far fewer than pixels.
std::vector<CellState> statesOf(const MapInfo& info, const GrayImage& image, Opacity opacity,
                                bool saved_unknown) {
  std::vector<CellState> states;
  for (std::uint32_t value = 0; value <= image.max_value; ++value) {
    states.push_back(classify(info, value, image.max_value, opacity));
  }
  if (saved_unknown) states[kSavedUnknown * (image.max_value / 255)] = CellState::unknown;
  return states;
}

OccupancyBitmap toBitmap(const MapInfo& info, const GrayImage& image, bool saved_unknown) {
  OccupancyBitmap bitmap;
  bitmap.width = image.width;
  bitmap.height = image.height;
  bitmap.resolution = info.resolution;
  bitmap.pose_map_bitmap = info.origin;
  bitmap.cells.reserve(image.values.size());
  std::array<std::vector<CellState>, 3> states;
  for (const Opacity opacity : {Opacity::transparent, Opacity::partial, Opacity::opaque}) {
    if (image.opacity.empty() && opacity != Opacity::opaque) continue;
    states[static_cast<std::size_t>(opacity)] = statesOf(info, image, opacity, saved_unknown);
  }
  const auto width = static_cast<std::size_t>(image.width);
  for (std::size_t row = 0; row < static_cast<std::size_t>(image.height); ++row) {
    const std::size_t image_row = static_cast<std::size_t>(image.height) - 1 - row;
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t i = image_row * width + column;
      const Opacity opacity = image.opacity.empty() ? Opacity::opaque : image.opacity[i];
      bitmap.cells.push_back(states[static_cast<std::size_t>(opacity)][image.values[i]]);
    }
  }
  return bitmap;
}

/// Whether 205 is unknown against what `free_thresh` says.
bool savedUnknown(const MapInfo& info, const GrayImage& image) {
  const std::uint32_t level = kSavedUnknown * (image.max_value / 255);
  return isMapSavers(info, image) &&
         classify(info, level, image.max_value, Opacity::opaque) == CellState::free;
}

}  // namespace

OccupancyBitmap loadRosMap(const std::string& yaml_path, Notes* notes) {
  const MapInfo info = InfoReader(yaml_path).read(notes);
  const GrayImage image = loadMapImage(yaml_path, info, notes);
  const bool saved_unknown = savedUnknown(info, image);
  OccupancyBitmap bitmap = toBitmap(info, image, saved_unknown);
  noteUnknown(info, image, bitmap, saved_unknown, notes);
  return bitmap;
}

std::string rosMapShares(const std::string& yaml_path) {
  const MapInfo info = InfoReader(yaml_path).read(nullptr);
  const GrayImage image = loadMapImage(yaml_path, info, nullptr);
  const OccupancyBitmap bitmap = toBitmap(info, image, savedUnknown(info, image));
  return sharesText(info, image, bitmap) + otherThresholds(info, image);
}

}  // namespace mrpt_polyloc
