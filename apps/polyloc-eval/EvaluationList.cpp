#include "EvaluationList.h"

#include "../common/parsing.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/io/GzInputStream.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <yaml-cpp/yaml.h>

namespace mrpt_polyloc::apps {
namespace {

namespace fs = std::filesystem;

/// A filter takes all moments of its drive, and rows that are some metres apart.
constexpr std::size_t kMomentsOfFilter = 1000;
constexpr double kStepOfFilter = 3.0;  // [m]

std::string lineOf(const YAML::Node& node) {
  return "line " + std::to_string(node.Mark().line + 1);
}

/// Reads the parts of a list; knows its file, for messages and relative paths.
class ListReader {
 public:
  explicit ListReader(const std::string& path)
      : path_(path), folder_(fs::path(path).parent_path()) {}

  EvaluationList read() {
    EvaluationList list;
    list.path = path_;
    const YAML::Node root = load();
    requireKeys(root, {"datasets", "methods"});
    for (const YAML::Node& node : sequence(root, "datasets")) addDataset(node, list.datasets);
    for (const YAML::Node& node : sequence(root, "methods")) list.methods.push_back(method(node));
    requireNames(list.datasets, "data set");
    requireNames(list.methods, "method");
    for (const DatasetEntry& dataset : list.datasets) {
      for (const MethodEntry& method : list.methods) checkPair(dataset, method);
    }
    return list;
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& reason) const {
    throw FormatError(path_, place, reason);
  }

  YAML::Node load() const {
    const std::string text = GzInputStream(path_).readAll();
    try {
      return YAML::Load(text);
    } catch (const YAML::Exception& error) {
      fail("line " + std::to_string(error.mark.line + 1), "not a YAML text: " + error.msg);
    }
  }

  /// A mapping whose keys are known and there once. \param known empty: any
  void requireKeys(const YAML::Node& node, const std::set<std::string>& known) const {
    if (!node.IsMap()) fail(lineOf(node), "keys are expected, each as 'KEY: VALUE'");
    std::set<std::string> seen;
    for (const auto& entry : node) {
      const std::string key = scalar(entry.first, "a key");
      if (!known.empty() && known.count(key) == 0) {
        fail(lineOf(entry.first), "unknown key '" + key + "'");
      }
      if (!seen.insert(key).second) fail(lineOf(entry.first), "'" + key + "' a second time");
    }
  }

  YAML::Node sequence(const YAML::Node& root, const char* key) const {
    const YAML::Node node = root[key];
    if (!node || !node.IsSequence() || node.size() == 0) {
      fail(node ? lineOf(node) : "", std::string("'") + key + "' must be a list of at least one");
    }
    return node;
  }

  std::string scalar(const YAML::Node& node, const std::string& what) const {
    if (!node || !node.IsScalar() || node.Scalar().empty()) {
      fail(node ? lineOf(node) : "", what + " must be one text or number");
    }
    return node.Scalar();
  }

  /// With ${VARIABLES} of the environment.
  std::string expanded(const YAML::Node& node, const std::string& what) const {
    std::string text = scalar(node, what);
    for (std::size_t at = text.find("${"); at != std::string::npos; at = text.find("${", at)) {
      const std::size_t end = text.find('}', at);
      if (end == std::string::npos) fail(lineOf(node), "'${' without '}'");
      const std::string name = text.substr(at + 2, end - at - 2);
      const char* value = std::getenv(name.c_str());
      if (value == nullptr) fail(lineOf(node), "the environment has no variable " + name);
      text.replace(at, end + 1 - at, value);
      at += std::string(value).size();
    }
    return text;
  }

  /// An existing file, its path from the list's folder on.
  std::string file(const YAML::Node& node, const std::string& key) const {
    const fs::path path = folder_ / expanded(node, "'" + key + "'");
    std::error_code error;
    if (!fs::exists(path, error)) fail(lineOf(node), key + ": no such file: " + path.string());
    return path.lexically_normal().string();
  }

  std::string name(const YAML::Node& node) const {
    const std::string name = scalar(node, "'name'");
    const auto is_plain = [](unsigned char c) {
      return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.' || c == '+';
    };
    if (name.front() == '.' || !std::all_of(name.begin(), name.end(), is_plain)) {
      fail(lineOf(node), "the name '" + name +
                             "' becomes part of file names: letters, digits and - _ . + are "
                             "allowed, not '.' in front");
    }
    return name;
  }

  /// The options of an application that an entry gives as keys, as its command line would.
  void addArguments(const YAML::Node& node, const std::set<std::string>& own, const CLI::App& cli,
                    std::vector<std::string>& arguments) const {
    for (const auto& entry : node) {
      const std::string key = entry.first.Scalar();
      if (own.count(key) > 0) continue;
      std::string flag = (key.size() == 1 ? "-" : "--") + key;
      std::replace(flag.begin(), flag.end(), '_', '-');
      const CLI::Option* option = cli.get_option_no_throw(flag);
      if (option == nullptr || flag == "--help") {
        fail(lineOf(entry.first), "unknown key '" + key + "'");
      }
      std::string value =
          key == "calibration" ? file(entry.second, key) : expanded(entry.second, "'" + key + "'");
      if (option->get_expected_max() != 0) {
        arguments.insert(arguments.end(), {flag, value});
      } else if (value == "true") {
        arguments.push_back(flag);
      } else if (value != "false") {
        fail(lineOf(entry.second), key + ": '" + value + "' is neither true nor false");
      }
    }
  }

  SimulationInput simulation(const YAML::Node& node) const {
    requireKeys(node, {});
    CLI::App cli;
    SimulationInput input;
    addSimulationOptions(cli, input);
    std::vector<std::string> arguments;
    addArguments(node, {}, cli, arguments);
    parse(cli, arguments, lineOf(node));
    return input;
  }

  void parse(CLI::App& cli, std::vector<std::string> arguments, const std::string& place) const {
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
    try {
      cli.parse(std::move(arguments));
    } catch (const CLI::ParseError& error) {
      fail(place, error.what());
    } catch (const UsageError& error) {
      fail(place, error.what());
    }
  }

  void addDataset(const YAML::Node& node, std::vector<DatasetEntry>& datasets) const {
    requireKeys(node, {});
    DatasetEntry entry;
    entry.place = lineOf(node);
    entry.name = name(node["name"]);
    const bool simulated = node["simulate"].IsDefined(), plans = node["plans"].IsDefined();
    if (plans == node["map"].IsDefined()) fail(entry.place, "either 'map' or 'plans' is needed");
    if (plans && !simulated) fail(entry.place, "'plans' needs 'simulate'");
    entry.map = plans ? file(node["plans"], "plans") : file(node["map"], "map");
    entry.arguments = {"--map", entry.map};
    if (simulated) {
      entry.simulation = simulation(node["simulate"]);
      entry.arguments.insert(entry.arguments.end(),
                             {"--scans", "simulated", "--truth", "simulated"});
      for (const char* key : {"scans", "truth", "good"}) {
        if (node[key].IsDefined()) fail(lineOf(node[key]), std::string(key) + " with 'simulate'");
      }
    } else {
      for (const char* key : {"scans", "truth"}) {
        if (!node[key].IsDefined()) fail(entry.place, std::string("'") + key + "' is missing");
        entry.arguments.insert(entry.arguments.end(),
                               {std::string("--") + key, file(node[key], key)});
      }
      if (node["good"].IsDefined()) {
        entry.arguments.insert(entry.arguments.end(), {"--good", file(node["good"], "good")});
      }
    }
    if (node["every"].IsDefined()) entry.every = count(node["every"], "every");
    EvaluationOptions options;
    CLI::App cli;
    addEvaluationOptions(cli, options);
    addArguments(node,
                 {"name", "map", "plans", "most", "scans", "truth", "good", "simulate", "every"},
                 cli, entry.arguments);
    if (!plans) {
      if (node["most"].IsDefined()) fail(lineOf(node["most"]), "'most' needs 'plans'");
      datasets.push_back(std::move(entry));
      return;
    }
    addPlans(entry, node["most"].IsDefined() ? count(node["most"], "most") : SIZE_MAX, datasets);
  }

  std::size_t count(const YAML::Node& node, const std::string& key) const {
    const auto number = parseCount(scalar(node, "'" + key + "'"));
    if (!number || *number == 0) fail(lineOf(node), key + ": a whole number from 1 on is needed");
    return *number;
  }

  /// One data set a line `NAME<TAB>WKT`.
  void addPlans(const DatasetEntry& entry, std::size_t most,
                std::vector<DatasetEntry>& datasets) const {
    GzInputStream stream(entry.map);
    std::string line;
    for (std::size_t number = 1; most > 0 && stream.readLine(line); ++number, --most) {
      const std::size_t tab = line.find('\t');
      if (tab == std::string::npos || tab == 0) {
        throw FormatError(entry.map, "line " + std::to_string(number), "NAME<TAB>WKT is expected");
      }
      DatasetEntry plan = entry;
      plan.name += "-" + line.substr(0, tab);
      for (char& c : plan.name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '_') c = '-';
      }
      plan.plan = line.substr(tab + 1);
      datasets.push_back(std::move(plan));
    }
  }

  MethodEntry method(const YAML::Node& node) const {
    MethodEntry entry;
    entry.place = lineOf(node);
    if (node.IsScalar()) {
      entry.name = entry.method = name(node);
    } else {
      requireKeys(node, {});
      entry.name = name(node["name"]);
      entry.method = scalar(node["method"], "'method'");
    }
    CLI::App cli;
    EvaluationOptions options;
    if (isBaseline(entry.method)) {
      entry.baseline.emplace();
      entry.baseline->method = entry.method;
      addBaselineOptions(cli, *entry.baseline);
      std::vector<std::string> arguments;
      if (node.IsMap()) addArguments(node, {"name", "method"}, cli, arguments);
      parse(cli, arguments, entry.place);
      entry.arguments = arguments;
      return entry;
    }
    addEvaluationOptions(cli, options);
    addCertifiedOptions(cli, options.search);
    entry.arguments = {"--method", entry.method};
    if (node.IsMap()) addArguments(node, {"name", "method"}, cli, entry.arguments);
    return entry;
  }

  template <class Entry>
  void requireNames(const std::vector<Entry>& entries, const std::string& what) const {
    std::set<std::string> names;
    for (const Entry& entry : entries) {
      if (!names.insert(entry.name).second) {
        fail(entry.place, "the " + what + " '" + entry.name + "' a second time");
      }
    }
  }

  void checkPair(const DatasetEntry& dataset, const MethodEntry& method) const {
    const std::string place = dataset.place + ", " + method.place;
    EvaluationOptions options;
    try {
      options = optionsOf(dataset, method);
    } catch (const std::runtime_error& error) {
      fail(place, error.what());
    }
    if (dataset.simulation && options.sets.areAsked(options.search.file)) {
      fail(place, "the method '" + method.name +
                      "' takes more than one scan at once, and simulated ones are no drive");
    }
  }

  std::string path_;
  fs::path folder_;
};

}  // namespace

EvaluationList loadEvaluationList(const std::string& path) {
  return ListReader(path).read();
}

EvaluationOptions optionsOf(const DatasetEntry& dataset, const MethodEntry& method) {
  EvaluationOptions options;
  CLI::App cli;
  addEvaluationOptions(cli, options);
  addCertifiedOptions(cli, options.search);
  std::vector<std::string> arguments = dataset.arguments;
  // A baseline is no method of the command line, and its options are its own.
  if (!method.baseline) {
    arguments.insert(arguments.end(), method.arguments.begin(), method.arguments.end());
  }
  std::reverse(arguments.begin(), arguments.end());
  cli.parse(arguments);
  if (method.baseline && needsDrive(*method.baseline)) {
    options.sets.accumulate = method.baseline->drive;
    options.sets.most_moments = kMomentsOfFilter;
    options.sets.longest_step = kStepOfFilter;
  }
  return options;
}

}  // namespace mrpt_polyloc::apps
