#include "RequestField.h"

#include "ApiError.h"

#include <cmath>
#include <sstream>

namespace mrpt_polyloc::apps {
namespace {

std::string number(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

}  // namespace

void RequestField::fail(const std::string& reason) const {
  throw ApiError(400, "bad_request", place_, (place_.empty() ? "request" : place_) + ": " + reason);
}

std::string RequestField::placeOf(const char* name) const {
  return place_.empty() ? name : place_ + "." + name;
}

void RequestField::allowOnly(std::initializer_list<const char*> names) const {
  if (!value_.is_object()) fail("not an object");
  for (const auto& [key, value] : value_.items()) {
    bool is_known = false;
    std::string known;
    for (const char* name : names) {
      is_known |= key == name;
      known += (known.empty() ? "" : ", ") + std::string(name);
    }
    if (is_known) continue;
    const std::string shown = key.substr(0, 40);
    throw ApiError(400, "bad_request", placeOf(shown.c_str()),
                   placeOf(shown.c_str()) + ": unknown; there is: " + known);
  }
}

RequestField RequestField::member(const char* name) const {
  if (!value_.is_object()) fail("not an object");
  const auto found = value_.find(name);
  if (found == value_.end()) {
    throw ApiError(400, "bad_request", placeOf(name), placeOf(name) + ": missing");
  }
  return RequestField(*found, placeOf(name));
}

std::optional<RequestField> RequestField::find(const char* name) const {
  if (!has(name)) return std::nullopt;
  const RequestField field = member(name);
  if (field.isNull()) return std::nullopt;
  return field;
}

double RequestField::number(const FieldRange& range) const {
  if (!value_.is_number()) fail("not a number");
  const double x = value_.get<double>();
  if (!std::isfinite(x)) fail("not finite");
  if (x < range.min || x > range.max) {
    fail(apps::number(x) + " is not within " + apps::number(range.min) + " to " +
         apps::number(range.max));
  }
  return x;
}

std::uint64_t RequestField::count(std::uint64_t min, std::uint64_t max) const {
  const bool is_count = value_.is_number_unsigned();
  const std::uint64_t x = is_count ? value_.get<std::uint64_t>() : 0;
  if (!is_count || x < min || x > max) {
    fail("not a whole number from " + std::to_string(min) + " to " + std::to_string(max));
  }
  return x;
}

bool RequestField::boolean() const {
  if (!value_.is_boolean()) fail("neither true nor false");
  return value_.get<bool>();
}

std::string RequestField::text(std::size_t most) const {
  if (!value_.is_string()) fail("not a text");
  std::string text = value_.get<std::string>();
  if (text.size() > most) fail("longer than " + std::to_string(most) + " bytes");
  return text;
}

std::size_t RequestField::arraySize(std::size_t most) const {
  if (!value_.is_array()) fail("not an array");
  if (value_.size() > most) {
    fail("holds " + std::to_string(value_.size()) + " elements, more than " + std::to_string(most));
  }
  return value_.size();
}

RequestField RequestField::element(std::size_t i) const {
  if (!value_.is_array() || i >= value_.size()) fail("has no element " + std::to_string(i));
  return RequestField(value_[i], place_ + "[" + std::to_string(i) + "]");
}

std::vector<double> RequestField::numbers(std::size_t most, const FieldRange& range,
                                          std::optional<double> null_is) const {
  std::vector<double> numbers(arraySize(most));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const nlohmann::json& x = value_[i];
    if (x.is_null() && null_is) {
      numbers[i] = *null_is;
    } else {
      numbers[i] = element(i).number(range);
    }
  }
  return numbers;
}

}  // namespace mrpt_polyloc::apps
