#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mrpt_polyloc::test {

/// What a program did.
struct Outcome {
  int code = -1;  ///< exit code; -1 if it was killed
  std::string out;
  std::string err;
};

/// The text of a file; empty if there is none.
std::string readFile(const std::filesystem::path& path);

/// The lines of a text, without their ends.
std::vector<std::string> linesOf(const std::string& text);

/// The fields of a CSV line.
std::vector<std::string> fieldsOf(const std::string& line);

/// Runs the project's programs as processes, in a folder of its own that is removed afterwards.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest();
  ~ProgramTest() override;

  /// A path in the test's folder.
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Writes a file into the test's folder and returns its path.
  std::string write(const std::string& name, const std::string& text) const;

  /// Names in the test's folder, sorted; hidden ones too.
  std::vector<std::string> files(const std::string& subfolder = ".") const;

  /// Runs a program in the test's folder, stdin closed, stdout and stderr no terminals.
  Outcome run(const std::string& program, const std::vector<std::string>& arguments) const;

  /// An asymmetric room of 8 m x 5 m with an alcove and a pillar, all walls: every place in it
  /// looks different. As a WKT file.
  std::string roomFile() const;

  /// Scans of that room: SUBFOLDER/scans.rawlog and SUBFOLDER/truth.tum.
  void simulate(const std::string& subfolder, const std::vector<std::string>& more = {}) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace mrpt_polyloc::test
