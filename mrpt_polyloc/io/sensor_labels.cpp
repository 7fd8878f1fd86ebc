#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/sensor_labels.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace mrpt_polyloc {

std::vector<std::string> splitLabels(const std::string& list) {
  std::vector<std::string> labels;
  std::istringstream stream(list);
  for (std::string label; std::getline(stream, label, ',');) labels.push_back(label);
  return labels;
}

bool isAskedFor(const std::string& label, const std::string& wanted) {
  if (wanted == label || wanted == "all") return true;
  const std::vector<std::string> labels = splitLabels(wanted);
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

std::vector<std::size_t> selectSensor(const std::string& file,
                                      const std::vector<std::string>& labels,
                                      const std::string& wanted) {
  if (labels.empty()) throw FormatError(file, "", "there is no 2D laser scan in it");
  std::map<std::string, std::size_t> counts;
  for (const std::string& label : labels) ++counts[label];

  std::string list;
  for (const auto& [label, count] : counts) {
    list += (list.empty() ? "'" : ", '") + label + "' (" + std::to_string(count) + " scans)";
  }
  if (wanted.empty() && counts.size() > 1) {
    throw FormatError(file, "", "it holds scans of several sensors, choose one of them: " + list);
  }
  const bool is_list = counts.count(wanted) == 0 && wanted != "all";
  for (const std::string& label : is_list ? splitLabels(wanted) : std::vector<std::string>()) {
    if (counts.count(label) > 0) continue;
    throw FormatError(file, "", "it holds no scan of sensor '" + label + "', but of " + list);
  }

  std::vector<std::size_t> selected;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    // A label with a comma in it is one label where there is such a sensor.
    const bool is_wanted =
        is_list || wanted == "all" ? isAskedFor(labels[i], wanted) : labels[i] == wanted;
    if (wanted.empty() || is_wanted) selected.push_back(i);
  }
  return selected;
}

}  // namespace mrpt_polyloc
