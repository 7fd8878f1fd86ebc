#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/mrpt_bridge/IniSection.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace mrpt_polyloc {

IniSection::IniSection(const mrpt::config::CConfigFileBase& ini, std::string name,
                       const std::vector<std::string>& known)
    : ini_(&ini), name_(std::move(name)) {
  std::vector<std::string> keys;
  ini.getAllKeys(name_, keys);
  for (const std::string& key : keys) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw InvalidParamsError("[" + name_ + "]: unknown option '" + key + "'");
    }
  }
}

void IniSection::refuse(const std::string& option, const std::string& text,
                        const std::string& expected) const {
  throw InvalidParamsError("[" + name_ + "]: " + option + " = '" + text + "' is not " + expected);
}

std::string IniSection::text(const std::string& option, const std::string& by_default) const {
  const std::string given = ini_->read_string(name_, option, "");
  return given.empty() ? by_default : given;
}

std::string IniSection::word(const std::string& option) const {
  std::string given = text(option, "");
  given.erase(std::min(given.find_first_of(";#"), given.size()));
  given.erase(given.find_last_not_of(" \t") + 1);
  return given;
}

double IniSection::number(const std::string& option, double by_default, double least,
                          double most) const {
  const std::string given = word(option);
  if (given.empty()) return by_default;
  const auto value = parseNumber(given);
  if (!value || !(*value >= least && *value <= most)) {  // refuses NaN
    const bool has_bounds = std::isfinite(least) || std::isfinite(most);
    refuse(option, given,
           has_bounds ? formatted("a number from %g to %g", least, most) : "a number");
  }
  return *value;
}

std::size_t IniSection::count(const std::string& option, std::size_t by_default, std::size_t least,
                              std::size_t most) const {
  const std::string given = word(option);
  if (given.empty()) return by_default;
  const auto value = parseCount(given);
  if (!value || *value < least || *value > most) {
    refuse(option, given,
           "one whole number from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return *value;
}

bool IniSection::flag(const std::string& option, bool by_default) const {
  const std::string given = word(option);
  if (given.empty()) return by_default;
  std::string lower;
  for (const char c : given)
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (lower == "1" || lower == "true" || lower == "yes") return true;
  if (lower == "0" || lower == "false" || lower == "no") return false;
  refuse(option, given, "true or false");
}

}  // namespace mrpt_polyloc
