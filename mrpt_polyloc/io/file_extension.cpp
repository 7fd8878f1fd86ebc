#include <mrpt_polyloc/io/file_extension.h>

#include <filesystem>

namespace mrpt_polyloc {

namespace {

std::string lowerExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace

std::string contentExtension(const std::string& path) {
  const std::filesystem::path name = std::filesystem::path(path).filename();
  const std::string extension = lowerExtension(name);
  return extension == ".gz" || extension == ".zst" ? lowerExtension(name.stem()) : extension;
}

}  // namespace mrpt_polyloc
