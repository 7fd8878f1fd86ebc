#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mrpt_polyloc::apps {

/// Which numbers a field takes.
struct FieldRange {
  double min = -1e9;  ///< coordinates beyond are no places of a building
  double max = 1e9;
};

/// A value of a request's JSON and how one gets to it, for messages. Whatever is asked of it and it
/// is not is an ApiError that names the place.
class RequestField {
 public:
  explicit RequestField(const nlohmann::json& value, std::string place = {})
      : value_(value), place_(std::move(place)) {}

  const std::string& place() const { return place_; }
  bool isNull() const { return value_.is_null(); }
  [[noreturn]] void fail(const std::string& reason) const;

  /// Refuses an object with other members: what is misspelt would be taken for not given.
  void allowOnly(std::initializer_list<const char*> names) const;
  bool has(const char* name) const { return value_.is_object() && value_.contains(name); }
  RequestField member(const char* name) const;
  /// A member that may be missing, or null.
  std::optional<RequestField> find(const char* name) const;

  double number(const FieldRange& range = {}) const;
  std::uint64_t count(std::uint64_t min, std::uint64_t max) const;
  bool boolean() const;
  std::string text(std::size_t most) const;
  /// The value as JSON: equal values, equal texts.
  std::string asJson() const { return value_.dump(-1, ' ', false, kReplace); }

  /// The elements of an array of at most so many.
  std::size_t arraySize(std::size_t most) const;
  RequestField element(std::size_t i) const;
  /// An array of finite numbers; with `null_is`, null stands for that.
  std::vector<double> numbers(std::size_t most, const FieldRange& range,
                              std::optional<double> null_is = std::nullopt) const;

 private:
  std::string placeOf(const char* name) const;

  /// Text from outside may be no UTF-8.
  static constexpr auto kReplace = nlohmann::json::error_handler_t::replace;

  const nlohmann::json& value_;
  std::string place_;
};

}  // namespace mrpt_polyloc::apps
