#pragma once

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <locale>
#include <string>
#include <unistd.h>

namespace mrpt_polyloc::test {

/// A host whose locale writes 1.234,5, in C and in C++, as long as this lives: that of Germany,
/// made for the purpose where it is not installed.
class CommaLocale {
 public:
  CommaLocale() : before_(std::setlocale(LC_ALL, nullptr)), before_cpp_(std::locale()) {
    folder_ =
        std::filesystem::temp_directory_path() / ("polyloc_locale_" + std::to_string(::getpid()));
    is_set_ = set() || (make() && set());
    // In C++ as well, and with grouping, whichever C has.
    std::locale::global(std::locale(std::locale::classic(), new Commas));
    if (is_set_) std::setlocale(LC_ALL, "de_DE.UTF-8");
  }
  ~CommaLocale() {
    std::locale::global(before_cpp_);
    std::setlocale(LC_ALL, before_.c_str());
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

  /// Whether C's functions write commas now, too. False where localedef or its sources are missing.
  bool isSet() const { return is_set_; }

 private:
  class Commas : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };

  static bool set() { return std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr; }
  bool make() const {
    std::filesystem::create_directories(folder_);
    const std::string command =
        "localedef -i de_DE -f UTF-8 '" + folder_.string() + "/de_DE.UTF-8' > /dev/null 2>&1";
    // It also warns, and then returns 1 though the locale is there.
    if (std::system(command.c_str()) < 0) return false;
    return ::setenv("LOCPATH", folder_.c_str(), 1) == 0;
  }

  std::string before_;
  std::locale before_cpp_;
  std::filesystem::path folder_;
  bool is_set_ = false;
};

}  // namespace mrpt_polyloc::test
