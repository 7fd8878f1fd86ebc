#include "view_polygons.h"

#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/file_extension.h>
#include <mrpt_polyloc/io/wkt.h>
#include <mrpt_polyloc/localization/exact/ExactLocalizer.h>
#include <mrpt_polyloc/localization/exact/ObservedPolygon.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPoint2D;

/// The outer ring of the one polygon that a line of WKT holds, its closing vertex left out.
std::vector<TPoint2D> parseLine(const std::string& line, std::size_t number,
                                const std::string& path) {
  // Blank lines before it make the parser's messages name the right line.
  const RawMap parsed = parseWkt(std::string(number - 1, '\n') + line, path);
  const std::string place = "line " + std::to_string(number);
  if (parsed.polygons.size() != 1) {
    throw FormatError(path, place,
                      "expected one POLYGON, got " + std::to_string(parsed.polygons.size()));
  }
  if (!parsed.polygons.front().holes.empty()) {
    throw FormatError(path, place, "a polygon with holes: what is seen from a point has none");
  }
  std::vector<TPoint2D> vertices = parsed.polygons.front().outer.vertices;
  if (vertices.size() > 1 && vertices.front() == vertices.back()) vertices.pop_back();
  if (signedArea(vertices) < 0.0) std::reverse(vertices.begin(), vertices.end());
  for (const TPoint2D& vertex : vertices) {
    // A beam without length would get lost.
    if (vertex.norm() == 0.0) throw FormatError(path, place, "a vertex at the robot itself");
  }
  try {
    const ObservedPolygon check(vertices, ExactLocalizerParams{}.tolerance);
  } catch (const InvalidParamsError& error) {
    throw FormatError(path, place, error.what());
  }
  return vertices;
}

}  // namespace

std::vector<RangeScan> loadViewPolygons(const std::string& path) {
  if (contentExtension(path) != ".wkt") {
    throw FormatError(path, "",
                      "--method exact reads polygons: a .wkt file, also with .gz or .zst");
  }
  GzInputStream file(path);
  std::vector<RangeScan> scans;
  std::string line;
  for (std::size_t number = 1; file.readLine(line); ++number) {
    if (line.find_first_not_of(" \t\r\v\f") == std::string::npos) continue;
    std::vector<Beam> beams;
    for (const TPoint2D& vertex : parseLine(line, number, path)) {
      beams.push_back({std::atan2(vertex.y, vertex.x), vertex.norm(), BeamKind::hit});
    }
    scans.emplace_back(std::move(beams), TPoint2D(0, 0), static_cast<double>(scans.size()));
  }
  if (scans.empty()) throw FormatError(path, "", "holds no polygon");
  return scans;
}

std::vector<TPoint2D> viewPolygon(const RangeScan& scan) {
  std::vector<TPoint2D> vertices;
  vertices.reserve(scan.beams().size());
  for (const Beam& beam : scan.beams()) {
    vertices.emplace_back(beam.range * std::cos(beam.bearing), beam.range * std::sin(beam.bearing));
  }
  return vertices;
}

}  // namespace mrpt_polyloc::apps
