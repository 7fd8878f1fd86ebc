#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/calibration_files.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/json_input.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace mrpt_polyloc {
namespace {

using nlohmann::ordered_json;

/// The scalar fields of a calibration, by name.
struct Field {
  const char* name;
  const char* constant;  ///< its name in default_calibration.h
  double Calibration::*value;
};

constexpr std::array<Field, 6> kFields = {{
    {"match_intercept", "kMatchIntercept", &Calibration::match_intercept},
    {"least_match_probability", "kLeastMatchProbability", &Calibration::least_match_probability},
    {"weight_decay", "kWeightDecay", &Calibration::weight_decay},
    {"unique_probability", "kUniqueProbability", &Calibration::unique_probability},
    {"position_factor", "kPositionFactor", &Calibration::position_factor},
    {"heading_factor", "kHeadingFactor", &Calibration::heading_factor},
}};

double numberAt(const nlohmann::json& object, const std::string& name, const std::string& path) {
  if (!object.contains(name)) throw FormatError(path, name, "is missing");
  if (!object[name].is_number()) throw FormatError(path, name, "is no number");
  return object[name].get<double>();
}

/// As C++ text: seven digits are more than the data hold, and 1 must stay a double.
std::string literal(double value) {
  std::string digits = formatted("%.7g", value);
  if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
  return digits;
}

template <std::size_t N>
std::string arrayLiteral(const char* name, const std::array<double, N>& values) {
  std::string text = "constexpr std::array<double, " + std::to_string(N) + "> " + name + " = {";
  for (std::size_t i = 0; i < N; ++i) text += (i == 0 ? "" : ", ") + literal(values[i]);
  return text + "};\n";
}

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

ordered_json calibrationJson(const Calibration& calibration) {
  ordered_json json;
  for (const Field& field : kFields) json[field.name] = calibration.*field.value;
  for (std::size_t i = 0; i < MatchFeatures::kCount; ++i) {
    json["match_weights"][MatchFeatures::kNames[i]] = calibration.match_weights[i];
  }
  json["lost_thresholds"] = calibration.lost_thresholds;
  return json;
}

Calibration loadCalibration(const std::string& path) {
  const nlohmann::json json = parseJson(GzInputStream(path).readAll(), path);
  if (!json.is_object()) throw FormatError(path, "", "is no object");
  Calibration calibration;
  for (const Field& field : kFields) calibration.*field.value = numberAt(json, field.name, path);
  if (!json.contains("match_weights") || !json["match_weights"].is_object()) {
    throw FormatError(path, "match_weights", "is missing or no object");
  }
  for (std::size_t i = 0; i < MatchFeatures::kCount; ++i) {
    calibration.match_weights[i] = numberAt(json["match_weights"], MatchFeatures::kNames[i], path);
  }
  const char* const thresholds = "lost_thresholds";
  if (!json.contains(thresholds)) {
    throw FormatError(path, thresholds, "is missing: fit it anew by polyloc-calibrate");
  }
  const bool is_list = json[thresholds].is_array() &&
                       json[thresholds].size() == calibration.lost_thresholds.size() &&
                       std::all_of(json[thresholds].begin(), json[thresholds].end(),
                                   [](const auto& value) { return value.is_number(); });
  if (!is_list) throw FormatError(path, thresholds, "is no list of 8 numbers");
  std::copy(json[thresholds].begin(), json[thresholds].end(), calibration.lost_thresholds.begin());
  try {
    calibration.check();
  } catch (const InvalidParamsError& error) {
    throw FormatError(path, "", error.what());
  }
  return calibration;
}

std::string calibrationHeader(const Calibration& calibration,
                              const std::vector<std::string>& origin) {
  std::string text =
      "#pragma once\n\n#include <array>\n\n"
      "// clang-format off\n/// Written by polyloc-calibrate; do not edit.\n";
  for (const std::string& line : origin) text += "/// " + line + "\n";
  text += "namespace mrpt_polyloc::default_calibration {\n\n";
  for (const Field& field : kFields) {
    text += std::string("constexpr double ") + field.constant + " = " +
            literal(calibration.*field.value) + ";\n";
  }
  text += "/// ";
  for (std::size_t i = 0; i < MatchFeatures::kCount; ++i) {
    text += std::string(i == 0 ? "" : ", ") + MatchFeatures::kNames[i];
  }
  text += "\n" + arrayLiteral("kMatchWeights", calibration.match_weights) + "/// of kLostShares\n" +
          arrayLiteral("kLostThresholds", calibration.lost_thresholds);
  return text + "\n}  // namespace mrpt_polyloc::default_calibration\n";
}

ordered_json outcomeJson(const CalibrationOutcome& outcome) {
  ordered_json json;
  json["good"] = outcome.good;
  json["foreign"] = outcome.foreign;
  json["cluttered"] = outcome.cluttered;
  json["roc_area"] = rocArea(outcome.roc);
  for (const double lost : {0.01, 0.03, 0.05}) {
    json[formatted("foreign_refused_at_%g", lost)] = pointAtLoss(outcome.roc, lost).refused;
  }
  json["good_lost"] = share(outcome.good_lost, outcome.good);
  json["foreign_refused"] = share(outcome.foreign_refused, outcome.foreign);
  json["foreign_unique"] = share(outcome.foreign_unique, outcome.foreign);
  json["cluttered_lost"] = share(outcome.cluttered_lost, outcome.cluttered);
  json["unique"] = outcome.unique;
  json["unique_right"] = share(outcome.unique_right, outcome.unique);
  for (const ReliabilityBin& bin : outcome.reliability) {
    json["reliability"].push_back({{"from", bin.from},
                                   {"to", bin.to},
                                   {"count", bin.count},
                                   {"stated", bin.stated},
                                   {"right", bin.true_share}});
  }
  json["reliability_error"] = calibrationError(outcome.reliability);
  json["position_square"] = outcome.position_square;
  json["heading_square"] = outcome.heading_square;
  return json;
}

}  // namespace mrpt_polyloc
