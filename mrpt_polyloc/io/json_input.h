#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace mrpt_polyloc {

/// Reading JSON with errors that name the place; used by the JSON map files only.

/// \throws FormatError naming the file, line and column of a syntax error.
nlohmann::json parseJson(const std::string& text, const std::string& file);

/// A JSON value and how one gets to it, e.g. `features[2].geometry`.
class JsonAt {
 public:
  JsonAt(const nlohmann::json& value, std::string path, const std::string& file)
      : value_(value), path_(std::move(path)), file_(file) {}

  const std::string& path() const { return path_; }
  bool isObject() const { return value_.is_object(); }
  bool isNull() const { return value_.is_null(); }
  bool isArray() const { return value_.is_array(); }
  std::size_t size() const { return value_.size(); }

  /// \throws FormatError naming the file and this path.
  [[noreturn]] void fail(const std::string& reason) const;

  /// A member of an object. \throws FormatError if this is none or has no such member.
  JsonAt member(const char* name) const;
  /// Whether this is an object with such a member.
  bool has(const char* name) const { return value_.is_object() && value_.contains(name); }
  /// Whether test(key, value) holds for any member of this, with values as texts (JSON's, but for
  /// strings, which have no quotes). False for what is no object.
  bool anyMember(const std::function<bool(std::string key, std::string value)>& test) const;
  /// An element of an array, which must be one and long enough.
  JsonAt element(std::size_t i) const;
  /// This as an array, for iteration by element(). \throws FormatError if it is none.
  const JsonAt& array() const;

  std::string string() const;  ///< \throws FormatError if it is none
  double length() const;       ///< \throws FormatError if it is no finite number above 0
  /// An array that begins with two finite numbers [m]; an altitude behind them is dropped. \throws
  /// FormatError otherwise.
  TPoint2D point() const;
  /// An array of points. \throws FormatError naming the one that is none.
  std::vector<TPoint2D> points() const;

 private:
  const nlohmann::json& value_;
  std::string path_;
  const std::string& file_;
};

}  // namespace mrpt_polyloc
