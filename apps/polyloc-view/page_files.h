#pragma once

#include <string_view>
#include <vector>

namespace mrpt_polyloc::apps {

/// A file that is compiled into the program: of page/, or a map.
struct PageFile {
  std::string_view name;
  std::string_view text;
};

/// All of them; the source is made from page/ when the program is built.
const std::vector<PageFile>& pageFiles();

}  // namespace mrpt_polyloc::apps
