#pragma once

#include <mrpt_polyloc/base/export.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace mrpt_polyloc {

/// One line of a CARMEN log, read field by field; every complaint names file and line.
class POLYLOC_EXPORT CarmenLine {
 public:
  /// \param text must outlive the line
  /// \param number of the line, from 1
  CarmenLine(const std::string& path, std::size_t number, std::string_view text);

  /// The first field, empty on an empty line.
  const std::string& keyword() const { return keyword_; }
  /// How many fields are left.
  std::size_t fieldCount() const;

  /// The next field. \throws FormatError if there is none.
  std::string word(const std::string& what);
  /// The next field as a number, nan and inf included. \throws FormatError if it is none.
  double number(const std::string& what);
  /// The same for the field `index` of a list.
  double number(const char* what, std::size_t index);
  /// The next field as a finite number. \throws FormatError if it is none.
  double finite(const std::string& what);
  /// The next field as a count of fields to come. \throws FormatError if it is none, or the line
  /// has not so many left.
  std::size_t count(const std::string& what);
  /// \throws FormatError unless exactly so many fields are left.
  void requireFields(std::size_t expected) const;

  /// Throws a FormatError.
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  std::string_view nextField();

  const std::string& path_;
  std::size_t number_;
  std::string_view rest_;
  std::string keyword_;
};

}  // namespace mrpt_polyloc
