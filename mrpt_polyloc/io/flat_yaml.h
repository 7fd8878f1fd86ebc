#pragma once

#include <map>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// What stands behind a key of a YAML mapping.
struct FlatYamlValue {
  int line = 0;  ///< of the key, from 1
  bool is_list = false;
  bool is_nested = false;            ///< neither a scalar nor a list of scalars: not kept
  std::vector<std::string> scalars;  ///< one if it is not a list; none if nothing was written
};

/// The keys at the top of a YAML file and their scalars and lists of scalars, read by yaml-cpp:
/// what map_server's files are made of. What is nested deeper is passed over. Of a key that is
/// written twice the last one counts; of several documents the first. \throws FormatError naming
/// file and line for what is not YAML, or not a mapping.
std::map<std::string, FlatYamlValue> loadFlatYaml(const std::string& path);

}  // namespace mrpt_polyloc
