#include "hypothesis_csv.h"

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/number_text.h>

#include <cmath>

namespace mrpt_polyloc::apps {
namespace {

/// A number rounded to so many decimals, 0 without a sign: for texts that are compared.
double rounded(double value, double decimals) {
  const double unit = std::pow(10.0, -decimals);
  return std::round(value / unit) * unit + 0.0;
}

/// A text as a field of CSV (RFC 4180).
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

std::string poseColumns(const Hypothesis& hypothesis) {
  const auto& pose = hypothesis.pose_map_robot;
  const auto deviation = [&](int i) { return std::sqrt(hypothesis.covariance(i, i)); };
  return formatted("%.4f,%.4f,%.3f,%.6g,%.5f,%.4f,%.4f,%.3f", rounded(pose.x, 4),
                   rounded(pose.y, 4), rounded(toDegrees(pose.phi), 3), hypothesis.weight,
                   hypothesis.cost, deviation(0), deviation(1), toDegrees(deviation(2)));
}

}  // namespace

std::string hypothesisCsv(const std::vector<LocalizedScan>& scans, bool with_maps) {
  std::string csv =
      "row,stamp,status,rank,x,y,phi_deg,weight,cost,std_x,std_y,std_phi_deg,ms,match,"
      "listed,cov_xy";
  csv += with_maps ? ",map\n" : "\n";
  for (const LocalizedScan& scan : scans) {
    const std::string head =
        formatted("%zu,%.6f,%s,", scan.row, scan.stamp, toString(scan.result.status));
    const std::vector<Hypothesis>& hypotheses = scan.result.hypotheses;
    const std::string tail =
        formatted(",%.3f,%.4f,%.6g,", scan.ms, scan.result.match_probability, scan.result.listed);
    if (hypotheses.empty()) csv += head + "0,,,,,,,," + tail + (with_maps ? ",\n" : "\n");
    for (std::size_t i = 0; i < hypotheses.size(); ++i) {
      csv += head + std::to_string(i + 1) + "," + poseColumns(hypotheses[i]) + tail +
             formatted("%.4g", hypotheses[i].covariance(0, 1));
      if (with_maps) csv += "," + quoted(scan.maps[i]);
      csv += "\n";
    }
  }
  return csv;
}

}  // namespace mrpt_polyloc::apps
