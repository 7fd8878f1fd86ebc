#include <mrpt_polyloc/io/numbers.h>
#include <mrpt_polyloc/mrpt_bridge/ini_keys.h>

#include <algorithm>

namespace mrpt_polyloc {

void requireKnownKeys(const mrpt::config::CConfigFileBase& source, const std::string& section,
                      const std::vector<std::string>& known) {
  std::vector<std::string> keys;
  source.getAllKeys(section, keys);
  for (const std::string& key : keys) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw InvalidParamsError("[" + section + "]: unknown option '" + key + "'");
    }
  }
}

double readNumber(const mrpt::config::CConfigFileBase& source, const std::string& section,
                  const std::string& name, double otherwise) {
  std::string text = source.read_string(section, name, "");
  // MRPT takes comments off that begin with // alone.
  text = text.substr(0, text.find_first_of(";#"));
  text = text.substr(0, text.find_last_not_of(" \t") + 1);
  if (text.empty()) return otherwise;
  const auto number = parseNumber(text);
  if (number) return *number;
  throw InvalidParamsError(name + " is '" + text + "', not a number");
}

}  // namespace mrpt_polyloc
