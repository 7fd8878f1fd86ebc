#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace mrpt_polyloc::test {

/// The folder of public evaluation data that the environment variable POLYLOC_DATA names, if any.
inline std::optional<std::string> dataDir() {
  const char* folder = std::getenv("POLYLOC_DATA");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  return std::string(folder);
}

}  // namespace mrpt_polyloc::test

/// Defines `data`, the data folder, or skips the test by name.
#define POLYLOC_DATA_OR_SKIP(data)                                \
  const auto data##_or_none = ::mrpt_polyloc::test::dataDir();    \
  if (!data##_or_none) GTEST_SKIP() << "POLYLOC_DATA is not set"; \
  const std::string data = *data##_or_none
