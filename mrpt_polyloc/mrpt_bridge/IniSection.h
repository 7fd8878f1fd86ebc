#pragma once

#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/export.h>

#include <mrpt/config/CConfigFileBase.h>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// A section of an ini whose options are all known and of the right kind: MRPT's own reading takes
/// `particles = 3oo` for 3, a word for 0, and what is misspelt for its default.
///
/// Behind a number or a flag a comment may stand, after //, # or ; (in texts only after //, as MRPT
/// has it: the others may be part of a file's name). Messages begin with the section in brackets:
/// MRPT takes what stands before a bracket for a place in its source.
class POLYLOC_EXPORT IniSection {
 public:
  /// Keeps a reference to the ini. \throws InvalidParamsError naming an option that is not known
  IniSection(const mrpt::config::CConfigFileBase& ini, std::string name,
             const std::vector<std::string>& known);

  // Each returns the default where the option is not given or empty.
  // \throws InvalidParamsError naming section, option, text and what is expected
  std::string text(const std::string& option, const std::string& by_default) const;
  double number(const std::string& option, double by_default,
                double least = -std::numeric_limits<double>::infinity(),
                double most = std::numeric_limits<double>::infinity()) const;
  std::size_t count(const std::string& option, std::size_t by_default, std::size_t least,
                    std::size_t most) const;
  bool flag(const std::string& option, bool by_default) const;

 private:
  /// The text without a comment behind it.
  std::string word(const std::string& option) const;
  [[noreturn]] void refuse(const std::string& option, const std::string& text,
                           const std::string& expected) const;

  const mrpt::config::CConfigFileBase* ini_;
  std::string name_;
};

/// Calls act(), and has its InvalidParamsError name the section, too.
template <class Act>
void namingSection(const std::string& section, const Act& act) {
  try {
    act();
  } catch (const InvalidParamsError& error) {
    throw InvalidParamsError(std::string(error.what()) + " in section '" + section + "'");
  }
}

}  // namespace mrpt_polyloc
