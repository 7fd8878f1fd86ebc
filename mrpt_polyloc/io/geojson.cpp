#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/io/geojson.h>
#include <mrpt_polyloc/io/json_input.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// Ring vertices by place, to find the edges that open lines run along.
class BorderIndex {
 public:
  explicit BorderIndex(RawMap& map) {
    for (RawPolygon& polygon : map.polygons) {
      add(polygon.outer);
      for (Ring& hole : polygon.holes) add(hole);
    }
    std::sort(corners_.begin(), corners_.end(), isBefore);
  }

  bool isVertex(const TPoint2D& p) const { return !near(p).empty(); }

  /// Makes the edges between two ring vertices open; false if there are none.
  bool open(const TPoint2D& a, const TPoint2D& b) {
    const std::vector<Corner> at_b = near(b);
    bool is_found = false;
    for (const Corner& from : near(a)) {
      const std::size_t n = from.ring->size();
      for (const Corner& to : at_b) {
        if (to.ring != from.ring) continue;
        if (to.index == (from.index + 1) % n) {
          from.ring->kinds[from.index] = EdgeKind::open;
          is_found = true;
        }
        if (from.index == (to.index + 1) % n) {
          from.ring->kinds[to.index] = EdgeKind::open;
          is_found = true;
        }
      }
    }
    return is_found;
  }

 private:
  struct Corner {
    Ring* ring;
    std::size_t index;

    const TPoint2D& point() const { return ring->vertices[index]; }
  };

  void add(Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) corners_.push_back({&ring, i});
  }

  /// The ring vertices at a point if there are any, else those within the snapping distance.
  std::vector<Corner> near(const TPoint2D& p) const {
    std::vector<Corner> found;
    for (auto corner = firstNotBefore(p); corner != corners_.end() && corner->point() == p;
         ++corner) {
      found.push_back(*corner);
    }
    if (!found.empty()) return found;
    constexpr double lowest = std::numeric_limits<double>::lowest();
    for (auto corner = firstNotBefore({p.x - kOpenLineSnap, lowest});
         corner != corners_.end() && corner->point().x <= p.x + kOpenLineSnap; ++corner) {
      const TPoint2D& q = corner->point();
      if (std::hypot(q.x - p.x, q.y - p.y) <= kOpenLineSnap) found.push_back(*corner);
    }
    return found;
  }

  static bool isBefore(const Corner& a, const Corner& b) { return isLess(a.point(), b.point()); }
  static bool isLess(const TPoint2D& a, const TPoint2D& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  }

  std::vector<Corner>::const_iterator firstNotBefore(const TPoint2D& p) const {
    return std::lower_bound(
        corners_.begin(), corners_.end(), p,
        [](const Corner& c, const TPoint2D& q) { return isLess(c.point(), q); });
  }

  std::vector<Corner> corners_;  // in lexicographic order
};

Ring readRing(const JsonAt& coordinates) {
  std::vector<TPoint2D> vertices = coordinates.points();
  if (vertices.size() > 1 && vertices.front() == vertices.back()) vertices.pop_back();
  return wallRing(std::move(vertices));
}

RawPolygon readPolygon(const JsonAt& rings) {
  if (rings.array().size() == 0) rings.fail("a polygon without rings");
  RawPolygon polygon;
  polygon.outer = readRing(rings.element(0));
  for (std::size_t i = 1; i < rings.size(); ++i) {
    polygon.holes.push_back(readRing(rings.element(i)));
  }
  return polygon;
}

/// Calls read(item) for the coordinates of a geometry of the type `single`, or for each item of
/// those of the type "Multi" + single.
template <class Read>
void forEachOf(const JsonAt& geometry, const std::string& single, const Read& read) {
  const std::string type = geometry.member("type").string();
  if (type != single && type != "Multi" + single) {
    geometry.member("type").fail("\"" + type + "\", expected \"" + single + "\" or \"Multi" +
                                 single + "\"");
  }
  const JsonAt coordinates = geometry.member("coordinates");
  if (type == single) {
    if (coordinates.array().size() > 0) read(coordinates);  // else an empty geometry
    return;
  }
  for (std::size_t i = 0; i < coordinates.array().size(); ++i) read(coordinates.element(i));
}

std::vector<TPoint2D> readLine(const JsonAt& line) {
  std::vector<TPoint2D> points = line.points();
  if (points.size() < 2) line.fail("a line of fewer than two positions");
  return points;
}

std::string text(const TPoint2D& p) {
  return formatted("(%.6f, %.6f)", p.x, p.y);
}

/// Marks the ring edges along an open line.
void openAlong(const JsonAt& line, BorderIndex& border) {
  const std::vector<TPoint2D> points = readLine(line);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!border.isVertex(points[i])) {
      line.element(i).fail("open line off the border: " + text(points[i]) +
                           " is no vertex of the free space");
    }
    if (i > 0 && points[i - 1] != points[i] && !border.open(points[i - 1], points[i])) {
      line.element(i).fail("open line off the border: " + text(points[i - 1]) + " to " +
                           text(points[i]) + " is no edge of the free space");
    }
  }
}

enum class FeatureKind { free, open, wall };

constexpr const char* kExample =
    "; a map looks like {\"type\": \"Feature\", \"properties\": {\"kind\": \"free\"}, "
    "\"geometry\": "
    "{\"type\": \"Polygon\", \"coordinates\": [[[0, 0], [10, 0], [10, 8], [0, 8], [0, 0]]]}}, in "
    "metres";

/// None if the feature does not say it.
std::optional<FeatureKind> kindOf(const JsonAt& feature) {
  if (feature.member("type").string() != "Feature") {
    feature.member("type").fail("expected \"Feature\"");
  }
  if (!feature.has("properties")) return std::nullopt;
  const JsonAt properties = feature.member("properties");
  if (properties.isNull() || !properties.has("kind")) return std::nullopt;
  const JsonAt kind = properties.member("kind");
  const std::string name = kind.string();
  if (name == "free") return FeatureKind::free;
  if (name == "open") return FeatureKind::open;
  if (name == "wall") return FeatureKind::wall;
  kind.fail("unknown kind \"" + name + "\", expected \"free\", \"open\" or \"wall\"");
}

/// Whether any of a feature's properties says that it is a door: `"door": true`, `"type": "Door"`.
bool isDoor(const JsonAt& feature) {
  if (!feature.has("properties")) return false;
  return feature.member("properties").anyMember([](std::string key, std::string value) {
    for (std::string* text : {&key, &value}) {
      for (char& c : *text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    if (value == "door" || value == "doorway") return true;
    return key == "door" && value != "no" && value != "false" && value != "null";
  });
}

/// Reads features and geometries into a map.
class GeoJsonReader {
 public:
  explicit GeoJsonReader(std::vector<Polyline>* doors) : doors_(doors) {}

  void readRoot(const JsonAt& root) {
    const std::string type = root.member("type").string();
    if (type == "FeatureCollection") {
      if (root.has("cell_size")) map_.cell_size = root.member("cell_size").length();
      const JsonAt features = root.member("features");
      for (std::size_t i = 0; i < features.array().size(); ++i) readFeature(features.element(i));
    } else if (type == "Feature") {
      readFeature(root);
    } else if (isGeometryOfMap(type)) {
      readUnsaid(root);
    } else {
      root.member("type").fail("\"" + type + "\" is not \"FeatureCollection\"" + kExample);
    }
  }

  /// How many geometries were of no use.
  std::size_t passedOver() const { return passed_over_; }

  RawMap finish(Notes* notes) {
    BorderIndex border(map_);
    for (const JsonAt& geometry : open_geometries_) {
      forEachOf(geometry, "LineString", [&](const JsonAt& line) { openAlong(line, border); });
    }
    if (unsaid_polygons_ + passed_over_ > 0) {
      addNote(notes, "features without the property \"kind\": " + std::to_string(unsaid_polygons_) +
                         " polygons are taken for free space, " + std::to_string(passed_over_) +
                         " other geometries are passed over");
    }
    return std::move(map_);
  }

 private:
  static bool isGeometryOfMap(const std::string& type) {
    return type == "Polygon" || type == "MultiPolygon" || type == "GeometryCollection";
  }

  static bool isLine(const JsonAt& geometry) {
    const std::string type = geometry.member("type").string();
    return type == "LineString" || type == "MultiLineString";
  }

  void readFree(const JsonAt& geometry) {
    forEachOf(geometry, "Polygon",
              [&](const JsonAt& rings) { map_.polygons.push_back(readPolygon(rings)); });
  }

  void readFeature(const JsonAt& feature) {
    const std::optional<FeatureKind> kind = kindOf(feature);
    const JsonAt geometry = feature.member("geometry");
    if (geometry.isNull()) return;  // RFC 7946: it has no place
    if (!kind && doors_ != nullptr && isDoor(feature) && isLine(geometry)) {
      forEachOf(geometry, "LineString",
                [&](const JsonAt& line) { doors_->push_back(readLine(line)); });
    } else if (!kind) {
      readUnsaid(geometry);
    } else if (*kind == FeatureKind::free) {
      readFree(geometry);
    } else if (*kind == FeatureKind::wall) {
      forEachOf(geometry, "LineString",
                [&](const JsonAt& line) { map_.walls_beyond.push_back(readLine(line)); });
    } else {
      open_geometries_.push_back(geometry);
    }
  }

  /// A geometry of which nothing is said.
  void readUnsaid(const JsonAt& geometry, int nesting = 0) {
    const std::string type = geometry.member("type").string();
    if (type == "GeometryCollection") {
      constexpr int kMostNested = 100;
      if (nesting > kMostNested) geometry.fail("more than 100 collections inside one another");
      const JsonAt members = geometry.member("geometries");
      for (std::size_t i = 0; i < members.array().size(); ++i) {
        readUnsaid(members.element(i), nesting + 1);
      }
    } else if (isGeometryOfMap(type)) {
      const std::size_t before = map_.polygons.size();
      readFree(geometry);
      unsaid_polygons_ += map_.polygons.size() - before;
    } else {
      ++passed_over_;
    }
  }

  std::vector<Polyline>* doors_;  ///< null: doors are passed over
  RawMap map_;
  std::vector<JsonAt> open_geometries_;
  std::size_t unsaid_polygons_ = 0;
  std::size_t passed_over_ = 0;
};

void appendPoint(std::string& out, const TPoint2D& p) {
  out += '[';
  appendNumber(out, p.x);
  out += ", ";
  appendNumber(out, p.y);
  out += ']';
}

void appendPoints(std::string& out, const std::vector<TPoint2D>& points, bool closed) {
  out += '[';
  for (std::size_t i = 0; i < points.size() + (closed ? 1 : 0); ++i) {
    if (i > 0) out += ", ";
    appendPoint(out, points[i % points.size()]);
  }
  out += ']';
}

/// The open edges of a ring as chains as long as can be.
void addOpenRuns(const Ring& ring, std::vector<Polyline>& runs) {
  const std::size_t n = ring.size();
  std::size_t start = 0;  // after a wall edge, so that no run is cut in two
  while (start < n && ring.kinds[(start + n - 1) % n] == EdgeKind::open) ++start;
  if (start == n) start = 0;
  bool is_running = false;
  for (std::size_t step = 0; step < n; ++step) {
    const std::size_t i = (start + step) % n;
    const bool is_open = ring.kinds[i] == EdgeKind::open;
    if (is_open && !is_running) runs.push_back({ring.vertices[i]});
    if (is_open) runs.back().push_back(ring.vertices[(i + 1) % n]);
    is_running = is_open;
  }
}

void appendFeatureStart(std::string& out, const char* kind, const char* type) {
  out += std::string("{\"type\": \"Feature\", \"properties\": {\"kind\": \"") + kind +
         "\"}, \"geometry\": {\"type\": \"" + type + "\", \"coordinates\": [\n";
}

void appendLines(std::string& out, const char* kind, const std::vector<Polyline>& lines) {
  if (lines.empty()) return;
  out += ",\n";
  appendFeatureStart(out, kind, "MultiLineString");
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i > 0) out += ",\n";
    appendPoints(out, lines[i], false);
  }
  out += "\n]}}";
}

}  // namespace

RawMap parseGeoJson(const std::string& text, const std::string& file, Notes* notes,
                    std::vector<Polyline>* doors) {
  const nlohmann::json document = parseJson(text, file);
  const JsonAt root(document, "", file);
  GeoJsonReader reader(doors);
  reader.readRoot(root);
  RawMap map = reader.finish(notes);
  if (map.polygons.empty() && reader.passedOver() > 0) {
    root.fail(std::string("it holds no polygon") + kExample);
  }
  return map;
}

std::string toGeoJson(const PolygonMap& map) {
  std::string out = "{\"type\": \"FeatureCollection\", ";
  if (map.cellSize() > 0.0) {
    out += "\"cell_size\": ";
    appendNumber(out, map.cellSize());
    out += ", ";
  }
  out += "\"features\": [\n";
  appendFeatureStart(out, "free", "MultiPolygon");
  for (std::size_t i = 0; i < map.components().size(); ++i) {
    const FreePolygon& component = map.components()[i];
    out += i > 0 ? ",\n[" : "[";
    appendPoints(out, component.outer.vertices, true);
    for (const Ring& hole : component.holes) {
      out += ",\n";
      appendPoints(out, hole.vertices, true);
    }
    out += ']';
  }
  out += "\n]}}";
  std::vector<Polyline> runs;
  for (const Ring* ring : map.rings()) addOpenRuns(*ring, runs);
  appendLines(out, "open", runs);
  appendLines(out, "wall", map.wallsBeyond());
  return out + "\n]}\n";
}

}  // namespace mrpt_polyloc
