#include "ini_section.h"

#include "../common/parsing.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/mrpt_bridge/ini_keys.h>

#include <cctype>
#include <sstream>
#include <utility>

namespace mrpt_polyloc::replay {

IniSection::IniSection(const mrpt::config::CConfigFileBase& ini, std::string name,
                       const std::vector<std::string>& known)
    : ini_(&ini), name_(std::move(name)) {
  requireKnownKeys(ini, name_, known);
}

void IniSection::refuse(const std::string& option, const std::string& text,
                        const std::string& expected) const {
  throw InvalidParamsError("[" + name_ + "]: " + option + " = '" + text + "' is not " + expected);
}

std::string IniSection::text(const std::string& option, const std::string& by_default) const {
  const std::string given = ini_->read_string(name_, option, "");
  return given.empty() ? by_default : given;
}

double IniSection::number(const std::string& option, double by_default, double least,
                          double most) const {
  const std::string given = text(option, "");
  if (given.empty()) return by_default;
  const auto value = apps::parseNumber(given);
  if (!value || *value < least || *value > most) {
    std::ostringstream expected;
    expected << "a number from " << least << " to " << most;
    refuse(option, given, expected.str());
  }
  return *value;
}

std::size_t IniSection::count(const std::string& option, std::size_t by_default, std::size_t least,
                              std::size_t most) const {
  const std::string given = text(option, "");
  if (given.empty()) return by_default;
  const auto value = apps::parseCount(given);
  if (!value || *value < least || *value > most) {
    refuse(option, given,
           "one whole number from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return *value;
}

bool IniSection::flag(const std::string& option, bool by_default) const {
  std::string given = text(option, "");
  if (given.empty()) return by_default;
  std::string lower;
  for (const char c : given)
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (lower == "1" || lower == "true" || lower == "yes") return true;
  if (lower == "0" || lower == "false" || lower == "no") return false;
  refuse(option, given, "true or false");
}

}  // namespace mrpt_polyloc::replay
