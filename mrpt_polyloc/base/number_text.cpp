#include <mrpt_polyloc/base/number_text.h>

#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <locale.h>
#include <system_error>

namespace mrpt_polyloc {
namespace {

/// The "C" locale for the calling thread alone, as long as this lives.
class PlainLocale {
 public:
  PlainLocale() : before_(uselocale(plain())) {}
  ~PlainLocale() { uselocale(before_); }
  PlainLocale(const PlainLocale&) = delete;
  PlainLocale& operator=(const PlainLocale&) = delete;

 private:
  static locale_t plain() {
    static const locale_t kPlain = newlocale(LC_ALL_MASK, "C", nullptr);  // for good
    return kPlain;
  }
  locale_t before_;
};

}  // namespace

std::optional<double> parseNumber(std::string_view text) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
    if (!text.empty() && text.front() == '-') return std::nullopt;
  }
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::optional<std::uint64_t> parseCount(std::string_view text) {
  std::uint64_t count = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, count);
  if (error != std::errc() || stop != end) return std::nullopt;
  return count;
}

void appendNumber(std::string& text, double value) {
  char digits[40];  // the longest has 24 with an exponent, 33 without
  const double size = std::abs(value);
  const bool is_plain = size == 0.0 || (size >= 1e-6 && size < 1e15);
  const std::to_chars_result end =
      std::to_chars(digits, digits + sizeof digits, value,
                    is_plain ? std::chars_format::fixed : std::chars_format::scientific);
  text.append(digits, end.ptr);
}

std::string formatted(const char* format, ...) {
  const PlainLocale plain;
  std::va_list values, again;
  va_start(values, format);
  va_copy(again, values);
  const int length = std::vsnprintf(nullptr, 0, format, values);
  va_end(values);
  std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
  if (length > 0) std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  return text;
}

std::string pointText(const mrpt::math::TPoint2D& point) {
  return formatted("(%f, %f)", point.x, point.y);
}

}  // namespace mrpt_polyloc
