#include <mrpt_polyloc/geometry/errors.h>
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

}  // namespace mrpt_polyloc
