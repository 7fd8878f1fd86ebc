#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/json_input.h>
#include <mrpt_polyloc/io/text_place.h>

#include <cmath>

namespace mrpt_polyloc {

nlohmann::json parseJson(const std::string& text, const std::string& file) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw FormatError(file, "", "the file is empty");
  }
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 5: REASON"
    const std::string message = error.what();
    const std::size_t place = message.find("parse error");
    const std::size_t colon = place == std::string::npos ? place : message.find(": ", place);
    throw FormatError(file, textPlace(text, error.byte > 0 ? error.byte - 1 : 0),
                      colon == std::string::npos ? message : message.substr(colon + 2));
  } catch (const nlohmann::json::exception& error) {
    // "[json.exception.out_of_range.406] number overflow parsing '1e999'"
    const std::string message = error.what();
    const std::size_t bracket = message.find("] ");
    throw FormatError(file, "",
                      bracket == std::string::npos ? message : message.substr(bracket + 2));
  }
}

void JsonAt::fail(const std::string& reason) const {
  throw FormatError(file_, path_, reason);
}

JsonAt JsonAt::member(const char* name) const {
  if (!value_.is_object()) fail("expected an object");
  const auto found = value_.find(name);
  if (found == value_.end()) fail(std::string("has no \"") + name + "\"");
  return {*found, path_.empty() ? name : path_ + "." + name, file_};
}

bool JsonAt::anyMember(const std::function<bool(std::string key, std::string value)>& test) const {
  if (!value_.is_object()) return false;
  for (const auto& [key, value] : value_.items()) {
    if (test(key, value.is_string() ? value.get<std::string>() : value.dump())) return true;
  }
  return false;
}

JsonAt JsonAt::element(std::size_t i) const {
  return {value_.at(i), path_ + "[" + std::to_string(i) + "]", file_};
}

const JsonAt& JsonAt::array() const {
  if (!value_.is_array()) fail("expected an array");
  return *this;
}

std::string JsonAt::string() const {
  if (!value_.is_string()) fail("expected a string");
  return value_.get<std::string>();
}

double JsonAt::length() const {
  const double value = value_.is_number() ? value_.get<double>() : 0.0;
  if (!(value > 0.0 && std::isfinite(value))) fail("expected a length [m]");
  return value;
}

TPoint2D JsonAt::point() const {
  if (!value_.is_array()) fail("expected a position [x, y]");
  if (value_.size() < 2) {
    fail("a position of " + std::to_string(value_.size()) + " coordinates, expected [x, y]");
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (!value_[i].is_number() || !std::isfinite(value_[i].get<double>())) {
      element(i).fail("expected a finite number");
    }
  }
  return {value_[0].get<double>(), value_[1].get<double>()};
}

std::vector<TPoint2D> JsonAt::points() const {
  std::vector<TPoint2D> all;
  array();
  all.reserve(size());
  for (std::size_t i = 0; i < size(); ++i) {
    const nlohmann::json& item = value_[i];
    if (item.is_array() && item.size() == 2 && item[0].is_number_float() &&
        item[1].is_number_float()) {  // nlohmann's parser refuses numbers that are not finite
      all.emplace_back(item[0].get<double>(), item[1].get<double>());
    } else {
      all.push_back(element(i).point());
    }
  }
  return all;
}

}  // namespace mrpt_polyloc
