#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/flat_yaml.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace mrpt_polyloc {

namespace {

constexpr const char* kBlank = " \t";

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(kBlank);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

class Parser {
 public:
  explicit Parser(const std::string& path) : path_(path), stream_(path) {}

  std::map<std::string, FlatYamlValue> parse() {
    std::string line;
    while (nextLine(line)) {
      const std::string text = trimmed(line);
      if (text.empty() || text == "---") continue;
      if (text == "...") break;
      if (text == "-" || text.rfind("- ", 0) == 0) {
        addListItem(trimmed(text.substr(1)));
      } else {
        addKey(line);
      }
    }
    return std::move(values_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw FormatError(path_, "line " + std::to_string(line_), reason);
  }

  /// The next line, its comment taken off.
  bool nextLine(std::string& line) {
    if (!stream_.readLine(line)) return false;
    ++line_;
    if (line_ == 1 && line.compare(0, 3, "\xEF\xBB\xBF") == 0) line.erase(0, 3);  // byte order mark
    char quote = '\0';
    for (std::size_t i = 0; i < line.size(); ++i) {
      const char c = line[i];
      const auto byte = static_cast<unsigned char>(c);
      if (byte < 0x20 && c != '\t') fail("a control character: this is not a YAML text");
      if (quote != '\0') {
        if (c == '\\' && quote == '"')
          ++i;
        else if (c == quote)
          quote = '\0';
      } else if (startsToken(line, i) && (c == '"' || c == '\'')) {
        quote = c;
      } else if (c == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) {
        line.resize(i);
        break;
      }
    }
    if (quote != '\0') fail("a quotation without an end");
    return true;
  }

  /// Whether a quotation mark at `i` opens a quoted scalar; inside a plain one it is a character.
  static bool startsToken(const std::string& line, std::size_t i) {
    const auto before = i == 0 ? std::string::npos : line.find_last_not_of(kBlank, i - 1);
    return before == std::string::npos ||
           std::string(":[,-").find(line[before]) != std::string::npos;
  }

  void addKey(const std::string& line) {
    if (line.front() == ' ' || line.front() == '\t') {
      fail("an indented line: only keys with a value or a list are expected here");
    }
    std::size_t colon = line.front() == '"' || line.front() == '\''
                            ? line.find(':', line.find(line.front(), 1))
                            : line.find(':');
    while (colon != std::string::npos && colon + 1 < line.size() && line[colon + 1] != ' ' &&
           line[colon + 1] != '\t') {
      colon = line.find(':', colon + 1);
    }
    if (colon == std::string::npos) fail("'KEY: VALUE' is expected");
    const int key_line = line_;
    const std::string key = unquoted(trimmed(line.substr(0, colon)));
    const std::string text = trimmed(line.substr(colon + 1));
    FlatYamlValue value;
    value.line = key_line;
    list_complete_ = !text.empty() && text.front() == '[';
    if (list_complete_) {
      value.is_list = true;
      value.scalars = flowList(text);
    } else if (!text.empty()) {
      if (std::string("{&*!|>%@`").find(text.front()) != std::string::npos) {
        fail("the value of '" + key + "' is neither a scalar nor a list of scalars");
      }
      value.scalars.push_back(unquoted(text));
    }
    last_key_ = key;
    values_[key] = std::move(value);
  }

  void addListItem(const std::string& text) {
    const auto found = values_.find(last_key_);
    if (found == values_.end()) fail("a list item without a key before it");
    FlatYamlValue& value = found->second;
    if (!value.is_list && !value.scalars.empty()) fail("a list item behind a value");
    if (list_complete_) fail("a list item behind a complete list");
    value.is_list = true;
    value.scalars.push_back(unquoted(text));
  }

  /// The scalars of `[a, b]`, whose end may stand on a later line.
  std::vector<std::string> flowList(std::string text) {
    std::string line;
    while (text.find(']') == std::string::npos) {
      if (!nextLine(line)) fail("the file ends inside a list (']' is missing)");
      text += " " + line;
    }
    const auto end = text.find(']');
    if (!trimmed(text.substr(end + 1)).empty()) fail("something follows the list");
    std::vector<std::string> scalars;
    const std::string inside = trimmed(text.substr(1, end - 1));
    for (std::size_t start = 0; start < inside.size();) {
      const auto comma = std::min(inside.find(',', start), inside.size());
      scalars.push_back(unquoted(trimmed(inside.substr(start, comma - start))));
      if (scalars.back().find_first_of("[{") != std::string::npos) fail("a list inside a list");
      start = comma + 1;
    }
    return scalars;
  }

  std::string unquoted(const std::string& text) const {
    if (text.empty() || (text.front() != '"' && text.front() != '\'')) return text;
    const char quote = text.front();
    if (text.size() < 2 || text.back() != quote) fail("something follows a quotation");
    std::string result;
    for (std::size_t i = 1; i + 1 < text.size(); ++i) {
      const bool escaped = (quote == '"' && text[i] == '\\') ||
                           (quote == '\'' && text[i] == '\'' && text[i + 1] == '\'');
      if (escaped) ++i;
      result += text[i];
    }
    return result;
  }

  const std::string& path_;
  GzInputStream stream_;
  int line_ = 0;
  std::string last_key_;
  bool list_complete_ = false;  ///< whether the value of the last key was a list in brackets
  std::map<std::string, FlatYamlValue> values_;
};

}  // namespace

std::map<std::string, FlatYamlValue> loadFlatYaml(const std::string& path) {
  return Parser(path).parse();
}

}  // namespace mrpt_polyloc
