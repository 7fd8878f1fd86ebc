#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/sensor_labels.h>

#include <map>

namespace mrpt_polyloc {

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
  if (!wanted.empty() && counts.count(wanted) == 0) {
    throw FormatError(file, "", "it holds no scan of sensor '" + wanted + "', but of " + list);
  }

  std::vector<std::size_t> selected;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (wanted.empty() || labels[i] == wanted) selected.push_back(i);
  }
  return selected;
}

}  // namespace mrpt_polyloc
