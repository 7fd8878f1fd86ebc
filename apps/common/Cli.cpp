#include "Cli.h"

#include "memory_budget.h"
#include "parsing.h"
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/version.h>

#include <iostream>
#include <new>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

std::string describe(const NumberRange& range) {
  const NumberRange any;
  std::string text = "a finite number";
  const auto number = [](double x) { return formatted("%g", x); };
  if (range.min != any.min)
    text += (range.above_min ? " above " : " of at least ") + number(range.min);
  if (range.max != any.max) {
    text += (range.min != any.min ? " and" : "") + std::string(" of at most ") + number(range.max);
  }
  return text;
}

bool inRange(double x, const NumberRange& range) {
  return (range.above_min ? x > range.min : x >= range.min) && x <= range.max;
}

}  // namespace

Program::Program(std::string name, const std::string& description)
    : name_(std::move(name)), options_(description, name_) {
  options_.set_version_flag("--version", name_ + " " + kVersion, "Print the version and exit");
  options_.get_formatter()->column_width(36);
}

int Program::run(int argc, const char* const* argv, const std::function<int()>& job) {
  const auto usage = [this](const std::string& message) {
    std::cerr << name_ << ": " << message << "\nRun with --help for more information.\n";
    return kUsage;
  };
  try {
    options_.parse(argc, argv);
    limitMemory();
    const int code = job();
    if (!std::cout.flush()) throw std::runtime_error("standard output: cannot be written");
    return code;
  } catch (const CLI::ParseError& error) {
    // CLI11 has an exit code per kind of error; ours has one for them all.
    if (error.get_exit_code() == 0) return options_.exit(error);  // help or version
    // A misspelt flag is told even where another is missing, which CLI11 finds first.
    std::string message = error.what();
    for (const std::string& extra : options_.remaining()) {
      if (message.find(extra) == std::string::npos) message += "; not expected: " + extra;
    }
    return usage(message);
  } catch (const UsageError& error) {
    return usage(error.what());
  } catch (const std::bad_alloc&) {
    std::cerr << name_ << ": there is not enough memory\n";
    return kFailed;
  } catch (const std::exception& error) {
    std::cerr << name_ << ": " << error.what() << '\n';
    return kFailed;
  }
}

void Program::warn(const std::string& message) const {
  std::cerr << name_ << ": warning: " << message << '\n';
}

void Program::note(const std::string& file, const Notes& notes) const {
  for (const std::string& text : notes) {
    std::cerr << name_ << ": " << file << ": note: " << text << '\n';
  }
}

CLI::Option* addNumber(CLI::App& options, const std::string& flag,
                       const std::function<void(double)>& take, const NumberRange& range,
                       const std::string& description) {
  return options.add_option_function<std::string>(
      flag,
      [take, range, flag](const std::string& text) {
        const auto number = parseFinite(text);
        if (!number || !inRange(*number, range)) {
          throw UsageError(flag + ": '" + text + "' is not " + describe(range));
        }
        take(*number);
      },
      description);
}

CLI::Option* addNumber(CLI::App& options, const std::string& flag, double& value,
                       const NumberRange& range, const std::string& description) {
  return addNumber(
      options, flag, [&value](double number) { value = number; }, range, description);
}

CLI::Option* addText(CLI::App& options, const std::string& flag, std::string& value,
                     const std::string& description) {
  return options.add_option_function<std::string>(
      flag,
      [&value, flag](const std::string& text) {
        if (text.empty()) throw UsageError(flag + ": the text is empty");
        value = text;
      },
      description);
}

CLI::Option* addCount(CLI::App& options, const std::string& flag, std::uint64_t& value,
                      std::uint64_t min, std::uint64_t max, const std::string& description) {
  return options.add_option_function<std::string>(
      flag,
      [&value, min, max, flag](const std::string& text) {
        const auto count = parseCount(text);
        if (!count || *count < min || *count > max) {
          throw UsageError(flag + ": '" + text + "' is not a whole number from " +
                           std::to_string(min) + " to " + std::to_string(max));
        }
        value = *count;
      },
      description);
}

}  // namespace mrpt_polyloc::apps
