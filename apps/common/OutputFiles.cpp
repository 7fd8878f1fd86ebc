#include "OutputFiles.h"

#include <mrpt_polyloc/base/errors.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <unistd.h>

namespace mrpt_polyloc::apps {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw FormatError(path.string(), "", "cannot be written: " + reason);
}

/// Writes a file at once; the reason if that fails, else an empty text.
std::string put(const fs::path& path, const std::string& text) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (out) return {};
  return errno != 0 ? std::strerror(errno) : "write error";
}

/// Where a file really goes: a symbolic link is followed, so that it is not replaced by the file.
fs::path resolve(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target;
}

}  // namespace

OutputFiles::~OutputFiles() {
  std::error_code ignored;
  for (const Staged& file : staged_) fs::remove(file.temporary, ignored);
}

std::string OutputFiles::stage(const std::string& path) {
  if (path.empty()) fail("''", "the name is empty");
  const fs::path target = resolve(path);
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) fail(path, "it is a folder");
  const bool replace = !fs::exists(status) || fs::is_regular_file(status);

  const std::string name = ".tmp-" + std::to_string(::getpid()) + "-" +
                           std::to_string(staged_.size()) + "-" + target.filename().string();
  const fs::path folder = replace ? target.parent_path() : fs::temp_directory_path();
  const fs::path temporary = folder / name;
  // Trying now tells an unwritable place before the work is done, not after.
  if (const std::string reason = put(temporary, ""); !reason.empty()) fail(path, reason);
  staged_.push_back({target, temporary, replace});
  return temporary.string();
}

void OutputFiles::add(const std::string& path, const std::string& text) {
  const std::string temporary = stage(path);
  if (const std::string reason = put(temporary, text); !reason.empty()) fail(path, reason);
}

void OutputFiles::commit() {
  std::vector<fs::path> made;
  for (const Staged& file : staged_) {
    std::error_code error;
    const bool was_there = fs::exists(file.target, error);
    if (file.replace) {
      fs::rename(file.temporary, file.target, error);
    } else {
      std::ifstream in(file.temporary, std::ios::binary);
      std::ofstream out(file.target, std::ios::binary);
      if (in.peek() != std::ifstream::traits_type::eof()) out << in.rdbuf();
      out.close();
      if (!out) error = std::make_error_code(std::errc::io_error);
    }
    if (error) {
      std::error_code ignored;
      for (const fs::path& path : made) fs::remove(path, ignored);
      fail(file.target, error.message());
    }
    if (!was_there) made.push_back(file.target);
  }
}

void makeFolder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw FormatError(path, "", "the folder cannot be made: " + error.message());
  if (!fs::is_directory(path, error)) throw FormatError(path, "", "is not a folder");
}

void requireWritable(const std::string& path) {
  if (path.empty()) return;
  OutputFiles probe;
  probe.stage(path);
}

void writeFile(const std::string& path, const std::string& text) {
  OutputFiles files;
  files.add(path, text);
  files.commit();
}

}  // namespace mrpt_polyloc::apps
