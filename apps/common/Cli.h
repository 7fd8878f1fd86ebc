#pragma once

#include <mrpt_polyloc/base/notes.h>

#include <CLI/CLI.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

namespace mrpt_polyloc::apps {

/// What the programs return, and nothing else.
enum ExitCode : int { kDone = 0, kFailed = 1, kUsage = 2 };

/// A command line that cannot be obeyed (exit code 2); `what()` says why.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One of the project's programs: a command line, a job, an exit code.
class Program {
 public:
  Program(std::string name, const std::string& description);

  /// Where the program adds its own options; -h/--help and --version are there already.
  CLI::App& options() { return options_; }

  /// Parses, which may throw UsageError as the job may, then runs the job, which returns kDone or
  /// kFailed. Whatever either throws becomes one line `NAME: MESSAGE` on stderr: kUsage for a parse
  /// error or UsageError, else kFailed.
  int run(int argc, const char* const* argv, const std::function<int()>& job);

  /// One line `NAME: warning: MESSAGE` on stderr.
  void warn(const std::string& message) const;

  /// One line `NAME: FILE: note: MESSAGE` on stderr for each of what a loader assumed of a file.
  void note(const std::string& file, const Notes& notes) const;

 private:
  std::string name_;
  CLI::App options_;
};

/// Which numbers an option takes.
struct NumberRange {
  double min = -std::numeric_limits<double>::max();
  double max = std::numeric_limits<double>::max();
  bool above_min = false;  ///< whether `min` itself is refused
};

/// An option that takes one finite number of a range; anything else is a usage error.
CLI::Option* addNumber(CLI::App& options, const std::string& flag,
                       const std::function<void(double)>& take, const NumberRange& range,
                       const std::string& description);
CLI::Option* addNumber(CLI::App& options, const std::string& flag, double& value,
                       const NumberRange& range, const std::string& description);

/// An option that takes one text that is not empty (a path, a name).
CLI::Option* addText(CLI::App& options, const std::string& flag, std::string& value,
                     const std::string& description);

/// An option that takes one decimal integer of [min, max]; anything else is a usage error.
CLI::Option* addCount(CLI::App& options, const std::string& flag, std::uint64_t& value,
                      std::uint64_t min, std::uint64_t max, const std::string& description);

}  // namespace mrpt_polyloc::apps
