#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/geojson.h>
#include <mrpt_polyloc/io/houseexpo.h>
#include <mrpt_polyloc/io/json_input.h>
#include <mrpt_polyloc/io/polygon_files.h>
#include <mrpt_polyloc/io/wkt.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace mrpt_polyloc {
namespace {

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

std::string readText(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw FormatError(path, "", "no such file");
  if (std::filesystem::is_directory(path, ignored)) {
    throw FormatError(path, "", "a directory, not a file");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FormatError(path, "", "cannot be opened");
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) throw FormatError(path, "", "cannot be read");
  if (text.empty()) throw FormatError(path, "", "the file is empty");
  return text;
}

}  // namespace

RawMap readRawMap(const std::string& path) {
  const std::string extension = lowerCase(std::filesystem::path(path).extension().string());
  if (extension != ".geojson" && extension != ".wkt" && extension != ".json") {
    throw FormatError(path, "",
                      (extension.empty() ? "no extension" : "unknown extension " + extension) +
                          ": a polygon map is .geojson, .wkt or .json (HouseExpo)");
  }
  const std::string text = readText(path);
  if (extension == ".wkt") return parseWkt(text, path);
  if (extension == ".geojson") return parseGeoJson(text, path);
  const nlohmann::json document = parseJson(text, path);
  const JsonAt root(document, "", path);
  if (!root.has("verts") && root.has("type")) return parseGeoJson(text, path);
  return parseHouseExpo(text, path);
}

RepairedMap loadPolygonMap(const std::string& path) {
  const RawMap raw = readRawMap(path);
  try {
    return repairMap(raw);
  } catch (const InvalidMapError& error) {
    throw InvalidMapError(path + ": " + error.what());
  }
}

std::string toText(const PolygonMap& map, const std::string& extension) {
  const std::string lower = lowerCase(extension);
  if (lower == ".geojson") return toGeoJson(map);
  if (lower == ".wkt") return toWkt(map);
  throw FormatError(extension.empty() ? "map file without extension" : extension, "",
                    "a map is written as .geojson or .wkt");
}

}  // namespace mrpt_polyloc
