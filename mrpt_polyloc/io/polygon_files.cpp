#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/geometry/door_passages.h>
#include <mrpt_polyloc/geometry/room_union.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/file_extension.h>
#include <mrpt_polyloc/io/geojson.h>
#include <mrpt_polyloc/io/houseexpo.h>
#include <mrpt_polyloc/io/json_input.h>
#include <mrpt_polyloc/io/map_units.h>
#include <mrpt_polyloc/io/polygon_files.h>
#include <mrpt_polyloc/io/wkt.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

constexpr const char* kDxf =
    "drawings are not read. Convert its rooms to polygons in metres: in QGIS open it, Processing "
    "Toolbox, Polygonize, save as GeoJSON; or, if they are closed polylines: ogr2ogr -f GeoJSON "
    "map.geojson drawing.dxf -dialect sqlite -sql \"SELECT ST_BuildArea(ST_Collect(geometry)) FROM "
    "entities\"";

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

/// \param doors as parseGeoJson()
RawMap readRawMap(const std::string& path, Notes* notes, std::vector<Polyline>* doors) {
  const std::string extension = contentExtension(path);
  if (extension != ".geojson" && extension != ".wkt" && extension != ".json") {
    throw FormatError(
        path, "",
        extension == ".dxf"
            ? kDxf
            : (extension.empty() ? "no extension" : "unknown extension " + extension) +
                  ": a polygon map is .geojson, .wkt or .json (HouseExpo)");
  }
  const std::string text = GzInputStream(path).readAll();
  if (extension == ".wkt") return parseWkt(text, path);
  if (extension == ".geojson") return parseGeoJson(text, path, notes, doors);
  const nlohmann::json document = parseJson(text, path);
  const JsonAt root(document, "", path);
  if (!root.has("verts") && root.has("type")) return parseGeoJson(text, path, notes, doors);
  return parseHouseExpo(text, path);
}

/// Adds the passages of doors that are drawn as lines.
void openDoors(std::vector<Polyline>& doors, double scale, RawMap& map, Notes* notes) {
  if (doors.empty()) return;
  for (Polyline& door : doors) {
    for (TPoint2D& p : door) p = p * scale;
  }
  const std::vector<RawPolygon> passages = doorPassages(map.polygons, doors);
  map.polygons.insert(map.polygons.end(), passages.begin(), passages.end());
  addNote(notes, formatted("%zu doors are drawn as lines: %zu passages are opened through walls of "
                           "up to %g m between rooms",
                           doors.size(), passages.size(), kThickestDoorWall));
}

/// Whether all that is wrong with a map is that its polygons are rooms side by side.
bool isOfRooms(const RawMap& raw, const std::vector<Defect>& defects) {
  if (raw.polygons.size() < 2 || defects.empty()) return false;
  for (const RawPolygon& polygon : raw.polygons) {
    const auto& kinds = polygon.outer.kinds;
    if (std::count(kinds.begin(), kinds.end(), EdgeKind::open) > 0) return false;
  }
  return std::all_of(defects.begin(), defects.end(), [](const Defect& defect) {
    return defect.what == "overlapping components" || defect.what == "components sharing an edge";
  });
}

RepairedMap uniteAndRepair(const RawMap& raw, const MapInspection& found, Notes* notes) {
  const RawMap united = uniteRooms(raw);
  RepairedMap result = repairMap(united);
  addNote(notes, std::to_string(raw.polygons.size()) +
                     " polygons overlap or share edges: taken for rooms and doors, and united to " +
                     std::to_string(result.map.components().size()) +
                     "; there is no wall where two of them touch");
  result.defects.insert(result.defects.begin(), found.defects.begin(), found.defects.end());
  return result;
}

}  // namespace

RawMap readRawMap(const std::string& path, Notes* notes) {
  return readRawMap(path, notes, nullptr);
}

RepairedMap loadPolygonMap(const std::string& path, Notes* notes, double scale) {
  std::vector<Polyline> doors;
  RawMap raw = readRawMap(path, notes, &doors);
  scaleMap(scale, raw);
  requireMetres(path, raw);
  openDoors(doors, scale, raw, notes);
  try {
    MapInspection found = inspectMap(raw);
    if (isOfRooms(raw, found.unrepaired)) return uniteAndRepair(raw, found, notes);
    if (!found.map) return repairMap(raw);  // it throws
    return {std::move(*found.map), std::move(found.defects), std::move(found.repairs)};
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
