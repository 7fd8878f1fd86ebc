#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/flat_yaml.h>

#include <algorithm>
#include <sstream>
#include <yaml-cpp/yaml.h>

namespace mrpt_polyloc {

namespace {

[[noreturn]] void fail(const std::string& path, int line, const std::string& reason) {
  throw FormatError(path, "line " + std::to_string(line), reason);
}

int lineOf(const YAML::Mark& mark) {
  return mark.line + 1;
}

/// yaml-cpp takes some binary files for text.
void requireText(const std::string& path, const std::string& text) {
  int line = 1;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 && c != '\t' && c != '\n' && c != '\r') {
      fail(path, line, "a control character: this is not a YAML text");
    }
    line += c == '\n' ? 1 : 0;
  }
}

std::string lineText(const std::string& text, int line) {
  std::istringstream lines(text);
  std::string found;
  for (int i = 0; i < line; ++i) std::getline(lines, found);
  return found;
}

/// What yaml-cpp lets pass, and map files do not mean: a key without a colon, and a quotation that
/// runs to the end of the file.
void requireWhole(const std::string& path, const std::string& text, const YAML::Node& key,
                  const YAML::Node& value) {
  const int line = lineOf(key.Mark());
  if (value.IsNull() && lineText(text, line).find(':') == std::string::npos) {
    fail(path, line, "'KEY: VALUE' is expected");
  }
  if (!value.IsScalar() || value.Mark().pos < 0) return;
  const auto start = static_cast<std::size_t>(value.Mark().pos);
  if (start >= text.size() || (text[start] != '"' && text[start] != '\'')) return;
  if (text.find(text[start], start + 1) == std::string::npos) {
    fail(path, line, "a quotation without an end");
  }
}

FlatYamlValue valueOf(const YAML::Node& node) {
  FlatYamlValue value;
  if (node.IsScalar()) {
    value.scalars.push_back(node.Scalar());
  } else if (node.IsSequence()) {
    value.is_list = true;
    for (const YAML::Node& item : node) {
      value.is_nested |= item.IsMap() || item.IsSequence();
      value.scalars.push_back(item.IsScalar() ? item.Scalar() : "");
    }
  } else {
    value.is_nested = node.IsMap();
  }
  return value;
}

}  // namespace

std::map<std::string, FlatYamlValue> loadFlatYaml(const std::string& path) {
  const std::string text = GzInputStream(path).readAll();
  requireText(path, text);
  YAML::Node root;
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    const auto lines = 1 + static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    fail(path, std::min(lineOf(error.mark), lines), "not a YAML text: " + error.msg);
  }
  if (!root.IsMap()) {
    fail(path, std::max(1, lineOf(root.Mark())), "keys are expected, each as 'KEY: VALUE'");
  }
  std::map<std::string, FlatYamlValue> values;
  for (const auto& entry : root) {
    if (!entry.first.IsScalar()) continue;
    requireWhole(path, text, entry.first, entry.second);
    FlatYamlValue value = valueOf(entry.second);
    value.line = lineOf(entry.first.Mark());
    values[entry.first.Scalar()] = std::move(value);
  }
  return values;
}

}  // namespace mrpt_polyloc
