#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace mrpt_polyloc::test {

/// A file in the system's folder for temporary files, gone with this object.
class TempFile {
 public:
  /// \param ending of the name, e.g. ".wkt"
  TempFile(const std::string& ending, const std::string& text) {
    static int count = 0;
    path_ =
        (std::filesystem::temp_directory_path() /
         ("polyloc_test_" + std::to_string(::getpid()) + "_" + std::to_string(count++) + ending))
            .string();
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TempFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TempFile(const TempFile&) = delete;
  TempFile& operator=(const TempFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// What an exception of type Error says that a call throws; empty if it throws none.
template <class Error, class Call>
std::string messageOf(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace mrpt_polyloc::test
