#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc::test {

/// The folder of public evaluation data that the environment variable POLYLOC_DATA names, if any.
inline std::optional<std::string> dataDir() {
  const char* folder = std::getenv("POLYLOC_DATA");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  return std::string(folder);
}

/// All files of the folders of maps; the folder `cases` holds inputs that are wrong on purpose.
inline std::vector<std::string> mapFolderFiles(const std::string& data) {
  std::vector<std::string> files;
  for (const char* folder : {"/grids", "/scans", "/replay"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(data + folder)) {
      if (entry.is_regular_file()) files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace mrpt_polyloc::test

/// Defines `data`, the data folder, or skips the test by name.
#define POLYLOC_DATA_OR_SKIP(data)                                \
  const auto data##_or_none = ::mrpt_polyloc::test::dataDir();    \
  if (!data##_or_none) GTEST_SKIP() << "POLYLOC_DATA is not set"; \
  const std::string data = *data##_or_none
