#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// Files that appear whole and together, or not at all.
///
/// Each is first written beside its place under a temporary name of the same extension; commit()
/// renames them. What is not committed is removed. A target that exists and is no regular file
/// (/dev/stdout, a named pipe) is written at commit() instead, for it must not be replaced.
class OutputFiles {
 public:
  OutputFiles() = default;
  ~OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  /// Adds a file with this text.
  /// \throws FormatError naming the file if it cannot be written there.
  void add(const std::string& path, const std::string& text);

  /// Adds a file that the caller writes: returns the temporary path to write it to. The folder and
  /// the right to write there are checked.
  /// \throws FormatError naming the file if it cannot be written there.
  std::string stage(const std::string& path);

  /// Puts all files in their places.
  /// \throws FormatError naming the file that could not be put there; none is then left behind of
  /// those that were not there before.
  void commit();

 private:
  struct Staged {
    std::filesystem::path target;
    std::filesystem::path temporary;
    bool replace;  ///< by renaming; else the content is copied
  };
  std::vector<Staged> staged_;
};

/// Makes a folder and those above it.
/// \throws FormatError naming it if that cannot be.
void makeFolder(const std::string& path);

/// Tells before the work, not after it, that a file cannot be written; an empty name is no file.
/// \throws FormatError naming it
void requireWritable(const std::string& path);

/// Writes one file whole or not at all.
/// \throws FormatError naming it if it cannot be written.
void writeFile(const std::string& path, const std::string& text);

}  // namespace mrpt_polyloc::apps
