#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <cstddef>
#include <string>
#include <vector>

namespace mrpt_polyloc::replay {

/// A section of an ini whose options are all known and of the right kind: MRPT's own reading takes
/// `particles = 3oo` for 3, and what is misspelt for its default.
class IniSection {
 public:
  /// Keeps a reference to the ini. \throws InvalidParamsError naming an option that is not known
  IniSection(const mrpt::config::CConfigFileBase& ini, std::string name,
             const std::vector<std::string>& known);

  // Each returns the default where the option is not given or empty.
  // \throws InvalidParamsError naming section, option, text and what is expected
  std::string text(const std::string& option, const std::string& by_default) const;
  double number(const std::string& option, double by_default, double least, double most) const;
  std::size_t count(const std::string& option, std::size_t by_default, std::size_t least,
                    std::size_t most) const;
  bool flag(const std::string& option, bool by_default) const;

 private:
  [[noreturn]] void refuse(const std::string& option, const std::string& text,
                           const std::string& expected) const;

  const mrpt::config::CConfigFileBase* ini_;
  std::string name_;
};

}  // namespace mrpt_polyloc::replay
