#pragma once

#include <map>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// What stands behind a key of a flat YAML file.
struct FlatYamlValue {
  int line = 0;  ///< of the key, from 1
  bool is_list = false;
  std::vector<std::string> scalars;  ///< one if it is not a list; none if nothing was written
};

/// Reads the part of YAML that map_server files are written in: a mapping of plain or quoted keys
/// to scalars and to lists of scalars (`[a, b]`, also over several lines, or `- a` lines), with
/// comments and document markers. Of a key that is written twice the last one counts.
///
/// Not MRPT's reader: that one prints on bad input, accepts a list whose end is missing, and knows
/// no key without a value.
/// \throws FormatError naming file and line for anything else.
std::map<std::string, FlatYamlValue> loadFlatYaml(const std::string& path);

}  // namespace mrpt_polyloc
