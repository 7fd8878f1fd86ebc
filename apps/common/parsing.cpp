#include "parsing.h"

#include "Cli.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/number_text.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc::apps {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// As many finite numbers, separated by commas, as `count` says; empty if it is not that.
std::vector<double> parseNumbers(const std::string& text, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string& part : split(text, ',')) {
    const auto number = parseFinite(part);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers.size() == count ? numbers : std::vector<double>{};
}

}  // namespace

bool endsWith(const std::string& text, const std::string& tail) {
  return text.size() >= tail.size() &&
         text.compare(text.size() - tail.size(), tail.size(), tail) == 0;
}

std::optional<double> parseFinite(const std::string& text) {
  const auto number = parseNumber(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::vector<RowRange> parseRows(const std::string& text) {
  std::vector<RowRange> ranges;
  for (const std::string& part : split(text, ',')) {
    const std::vector<std::string> ends = split(part, '-');
    const auto first = parseCount(ends.front());
    const auto last = parseCount(ends.back());
    if (ends.size() > 2 || !first || !last || *last < *first) {
      throw UsageError("--rows: '" + part + "' is neither a row I nor a range J-K with J <= K");
    }
    ranges.push_back({*first, *last});
  }
  return ranges;
}

std::vector<std::size_t> selectRows(const std::vector<RowRange>& ranges, std::size_t count) {
  std::vector<bool> selected(count, false);
  for (const RowRange& range : ranges) {
    for (std::size_t row = range.first; row < count && row <= range.last; ++row) {
      selected[row] = true;
    }
  }
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < count; ++row) {
    if (selected[row]) rows.push_back(row);
  }
  return rows;
}

PosePrior::Disk parseDisk(const std::string& text) {
  const std::vector<double> numbers = parseNumbers(text, 3);
  if (numbers.empty() || numbers[2] <= 0.0) {
    throw UsageError("--near: '" + text + "' is not X,Y,R with a radius R above 0, in metres");
  }
  return {numbers[0], numbers[1], numbers[2]};
}

mrpt::math::TPoint2D parsePoint(const std::string& option, const std::string& text) {
  const std::vector<double> numbers = parseNumbers(text, 2);
  if (numbers.empty()) throw UsageError(option + ": '" + text + "' is not X,Y in metres");
  return {numbers[0], numbers[1]};
}

MotionNoise parseMotionNoise(const std::string& text) {
  const std::vector<double> numbers = parseNumbers(text, 3);
  if (numbers.empty() || numbers[0] < 0.0 || numbers[1] < 0.0 || numbers[2] < 0.0) {
    throw UsageError("--odometry-noise: '" + text +
                     "' is not A,B,C, none below 0: metres a metre, degrees a metre, degrees a "
                     "radian");
  }
  return {numbers[0], toRadians(numbers[1]), toRadians(numbers[2])};
}

Tolerance parseTolerance(const std::string& text) {
  const std::vector<double> numbers = parseNumbers(text, 2);
  if (numbers.empty() || numbers[0] <= 0.0 || numbers[1] <= 0.0 || numbers[1] > 180.0) {
    throw UsageError("--tolerance: '" + text +
                     "' is not M,DEG with metres above 0 and degrees in (0, 180]");
  }
  return {numbers[0], toRadians(numbers[1])};
}

}  // namespace mrpt_polyloc::apps
