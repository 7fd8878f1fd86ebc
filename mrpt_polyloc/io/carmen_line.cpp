#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/io/carmen_line.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {

namespace {

constexpr std::string_view kBlank = " \t\r\v\f";

std::string_view skipBlank(std::string_view text) {
  const auto start = text.find_first_not_of(kBlank);
  return start == std::string_view::npos ? std::string_view() : text.substr(start);
}

}  // namespace

CarmenLine::CarmenLine(const std::string& path, std::size_t number, std::string_view text)
    : path_(path), number_(number), rest_(skipBlank(text)), keyword_(nextField()) {}

std::string_view CarmenLine::nextField() {
  const auto end = std::min(rest_.find_first_of(kBlank), rest_.size());
  const std::string_view field = rest_.substr(0, end);
  rest_ = skipBlank(rest_.substr(end));
  return field;
}

std::size_t CarmenLine::fieldCount() const {
  std::size_t count = 0;
  for (std::string_view rest = rest_; !rest.empty(); ++count) {
    rest = skipBlank(rest.substr(std::min(rest.find_first_of(kBlank), rest.size())));
  }
  return count;
}

std::string CarmenLine::word(const std::string& what) {
  if (rest_.empty()) fail("truncated: the " + what + " is missing");
  return std::string(nextField());
}

double CarmenLine::number(const std::string& what) {
  const std::string field = word(what);
  const auto value = parseNumber(field);
  if (!value) fail("the " + what + " is '" + field + "', not a number");
  return *value;
}

double CarmenLine::number(const char* what, std::size_t index) {
  if (const auto value = parseNumber(nextField())) return *value;
  fail("the " + std::string(what) + " " + std::to_string(index) + " is missing or not a number");
}

double CarmenLine::finite(const std::string& what) {
  const double value = number(what);
  if (!std::isfinite(value)) fail("the " + what + " is not finite");
  return value;
}

std::size_t CarmenLine::count(const std::string& what) {
  const double value = number(what);
  if (!(value >= 0.0) || value != std::floor(value)) {
    fail("the " + what + " is not a whole number of 0 or more");
  }
  if (value > static_cast<double>(fieldCount())) {
    fail("truncated: the " + what + " is greater than that of the fields behind it");
  }
  return static_cast<std::size_t>(value);
}

void CarmenLine::requireFields(std::size_t expected) const {
  const std::size_t left = fieldCount();
  if (left == expected) return;
  fail((left < expected ? "truncated: " : "the number of readings is wrong: ") +
       std::to_string(expected) + " more fields are expected, there are " + std::to_string(left));
}

void CarmenLine::fail(const std::string& reason) const {
  throw FormatError(path_, "line " + std::to_string(number_), reason);
}

}  // namespace mrpt_polyloc
