#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/io/text_place.h>
#include <mrpt_polyloc/io/wkt.h>

#include <charconv>
#include <cmath>
#include <utility>

namespace mrpt_polyloc {
namespace {

bool isSpace(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

constexpr const char* kExample = "POLYGON ((0 0, 10 0, 10 8, 0 8, 0 0)) in metres";

class WktParser {
 public:
  WktParser(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  RawMap run() {
    if (text_.compare(0, 3, "\xEF\xBB\xBF") == 0) at_ = 3;  // a byte order mark
    skipSpace();
    if (atEnd()) fail("the file is empty");
    RawMap map;
    while (!atEnd()) {
      readSrid();
      readGeometry(map);
      const std::size_t geometry_end = at_;
      if (!take(';')) at_ = geometry_end;
      const std::size_t end = at_;
      skipSpace();
      if (!atEnd() && text_.find('\n', end) >= at_) fail("text after the end of the geometry");
    }
    return map;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const { failAt(at_, reason); }
  [[noreturn]] void failAt(std::size_t offset, const std::string& reason) const {
    throw FormatError(file_, textPlace(text_, offset), reason);
  }

  bool atEnd() const { return at_ >= text_.size(); }

  void skipSpace() {
    while (!atEnd() && isSpace(text_[at_])) ++at_;
  }

  /// The next letters in upper case; empty if there are none.
  std::string word() {
    skipSpace();
    std::string letters;
    for (; !atEnd() && isLetter(text_[at_]); ++at_) {
      letters += static_cast<char>(text_[at_] & ~0x20);  // ASCII upper case, whatever the locale
    }
    return letters;
  }

  /// Takes the character if it comes next.
  bool take(char wanted) {
    skipSpace();
    if (atEnd() || text_[at_] != wanted) return false;
    ++at_;
    return true;
  }

  void expect(char wanted) {
    if (take(wanted)) return;
    fail(std::string("expected '") + wanted + "'" + (atEnd() ? ", but the text ends" : ""));
  }

  /// "SRID=n;" before a geometry, as PostGIS writes it.
  void readSrid() {
    skipSpace();
    const std::size_t start = at_;
    if (word() != "SRID") {
      at_ = start;
      return;
    }
    expect('=');
    const double srid = readNumber();
    for (const int degrees : {4326, 4258, 4269, 4979}) {
      if (srid == degrees) {
        failAt(start,
               "SRID " + std::to_string(degrees) +
                   " is degrees of longitude and latitude: a map is in metres, so project it");
      }
    }
    expect(';');
  }

  /// Takes Z, M or ZM off the end of a type: "POLYGONZ" is written, too.
  static std::string withoutDimensions(std::string type) {
    for (const char letter : {'M', 'Z'}) {
      if (!type.empty() && type.back() == letter) type.pop_back();
    }
    return type;
  }

  void readGeometry(RawMap& map) {
    skipSpace();
    const std::size_t start = at_;
    const std::string type = withoutDimensions(word());
    if (type == "GEOMETRYCOLLECTION") return readCollection(map);
    if (type != "POLYGON" && type != "MULTIPOLYGON") {
      failAt(start, type.empty()
                        ? "expected POLYGON or MULTIPOLYGON"
                        : "geometry type " + type +
                              ": only POLYGON and MULTIPOLYGON can be a map, as " + kExample);
    }
    skipSpace();
    const std::size_t flag_start = at_;
    std::string flag = word();
    if (flag == "Z" || flag == "M" || flag == "ZM") flag = word();
    if (flag == "EMPTY") return;
    if (!flag.empty()) failAt(flag_start, "expected '(' or EMPTY");
    if (type == "POLYGON") {
      map.polygons.push_back(readPolygon());
      return;
    }
    readList([&] {
      skipSpace();
      const std::size_t member_start = at_;
      const std::string member = word();
      if (member == "EMPTY") return;
      if (!member.empty()) failAt(member_start, "expected '(' or EMPTY");
      map.polygons.push_back(readPolygon());
    });
  }

  void readCollection(RawMap& map) {
    constexpr int kMostNested = 100;
    if (++nesting_ > kMostNested) fail("more than 100 collections inside one another");
    std::size_t flag_start = at_;
    std::string flag = word();
    if (flag == "Z" || flag == "M" || flag == "ZM") {
      flag_start = at_;
      flag = word();
    }
    if (!flag.empty() && flag != "EMPTY") failAt(flag_start, "expected '(' or EMPTY");
    if (flag.empty()) readList([&] { readGeometry(map); });
    --nesting_;
  }

  /// Reads "(item, item, ...)".
  template <class ReadItem>
  void readList(const ReadItem& read_item) {
    expect('(');
    do {
      read_item();
    } while (take(','));
    if (take(')')) return;
    fail(atEnd() ? "expected ',' or ')', but the text ends" : "expected ',' or ')'");
  }

  RawPolygon readPolygon() {
    std::vector<Ring> rings;
    readList([&] { rings.push_back(readRing()); });
    RawPolygon polygon;
    polygon.outer = std::move(rings.front());
    polygon.holes.assign(std::make_move_iterator(rings.begin() + 1),
                         std::make_move_iterator(rings.end()));
    return polygon;
  }

  Ring readRing() {
    std::vector<TPoint2D> vertices;
    readList([&] {
      const double x = readNumber();
      const double y = readNumber();
      vertices.emplace_back(x, y);
      for (int dropped = 0; dropped < 2; ++dropped) {  // Z and M
        skipSpace();
        if (!atEnd() && startsNumber()) readNumber();
      }
    });
    return wallRing(std::move(vertices));
  }

  bool startsNumber() const {
    const char c = text_[at_];
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
  }

  double readNumber() {
    skipSpace();
    if (atEnd()) fail("expected a number, but the text ends");
    const char* const begin = text_.data() + at_;
    const char* const end = text_.data() + text_.size();
    const bool has_plus = *begin == '+' && begin + 1 != end && *(begin + 1) != '-';
    double value = 0.0;
    const std::from_chars_result result = std::from_chars(begin + (has_plus ? 1 : 0), end, value);
    if (result.ec == std::errc::result_out_of_range) fail("a number out of range");
    if (result.ec != std::errc()) fail("expected a number");
    if (!std::isfinite(value)) fail("a number that is not finite");
    at_ = static_cast<std::size_t>(result.ptr - text_.data());
    return value;
  }

  const std::string& text_;
  const std::string& file_;
  std::size_t at_ = 0;
  int nesting_ = 0;
};

void appendRing(std::string& text, const Ring& ring) {
  const auto append = [&](const TPoint2D& p) {
    appendNumber(text, p.x);
    text += ' ';
    appendNumber(text, p.y);
  };
  text += '(';
  for (const TPoint2D& p : ring.vertices) {
    append(p);
    text += ", ";
  }
  append(ring.vertices.front());
  text += ')';
}

void appendPolygon(std::string& text, const FreePolygon& polygon) {
  text += '(';
  appendRing(text, polygon.outer);
  for (const Ring& hole : polygon.holes) {
    text += ", ";
    appendRing(text, hole);
  }
  text += ')';
}

}  // namespace

RawMap parseWkt(const std::string& text, const std::string& file) {
  return WktParser(text, file).run();
}

std::string toWkt(const PolygonMap& map) {
  const char* const use_geojson = ", which WKT cannot say: use .geojson";
  if (map.openPerimeter() > 0.0) {
    throw InvalidMapError(std::string("the map has open edges") + use_geojson);
  }
  if (!map.wallsBeyond().empty()) {
    throw InvalidMapError(std::string("the map has walls beyond") + use_geojson);
  }
  if (map.components().size() == 1) {
    std::string text = "POLYGON ";
    appendPolygon(text, map.components().front());
    return text + "\n";
  }
  std::string text = "MULTIPOLYGON ";
  const char* separator = "(";
  for (const FreePolygon& component : map.components()) {
    text += separator;
    appendPolygon(text, component);
    separator = ", ";
  }
  return text + ")\n";
}

}  // namespace mrpt_polyloc
