#include "replay_statistics.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/number_text.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>

namespace mrpt_polyloc::replay {
namespace {

using Json = nlohmann::ordered_json;

const char* healthName(FilterHealth health) {
  switch (health) {
    case FilterHealth::learning:
      return "learning";
    case FilterHealth::healthy:
      return "healthy";
    case FilterHealth::doubtful:
      return "doubtful";
    case FilterHealth::lost:
      break;
  }
  return "lost";
}

template <class Value>
double medianOf(const std::vector<RunScore>& scores, const Value& value) {
  std::vector<double> values;
  for (const RunScore& score : scores) values.push_back(value(score));
  return percentile(std::move(values), 0.5);
}

std::vector<RunScore> successful(const std::vector<RunScore>& scores) {
  std::vector<RunScore> right;
  for (const RunScore& score : scores) {
    if (score.step) right.push_back(score);
  }
  return right;
}

/// NaN, the median of nothing, as null.
Json figure(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

template <class Value>
Json orNull(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// Of the runs in which the robot was found after the gap: how often, and after how many scans.
Json gapSummary(std::size_t gap, std::size_t step, const std::vector<RunScore>& scores) {
  std::vector<double> after;
  for (const RunScore& score : scores) {
    if (gap < score.found_after.size() && score.found_after[gap]) {
      after.push_back(static_cast<double>(*score.found_after[gap]));
    }
  }
  return {{"step", step},
          {"recovered", after.size()},
          {"median_scans", figure(percentile(after, 0.5))},
          {"max_scans", figure(percentile(after, 1.0))}};
}

Json perRun(const RunRecord& run, const RunScore& score, bool has_truth) {
  Json json = {{"seed", run.seed}};
  if (has_truth) json["success"] = score.step.has_value();
  json["step"] = orNull(score.step);
  json["error_m"] = score.step ? Json(score.error_m) : Json(nullptr);
  json["error_deg"] = score.step ? Json(toDegrees(score.error_rad)) : Json(nullptr);
  json["search_ms"] = score.search_ms;
  json["first_step_ms"] = score.first_step_ms;
  json["total_ms"] = score.total_ms;
  json["total_cpu_ms"] = score.total_cpu_ms;
  json["searches"] = score.searches;
  json["mixes"] = score.mixes;
  Json after = Json::array();
  for (const auto& scans : score.found_after) after.push_back(orNull(scans));
  json["found_after"] = after;
  return json;
}

std::string format(const char* pattern, double value) {
  return std::isfinite(value) ? formatted(pattern, value) : "none";
}

}  // namespace

std::string replaySummaryJson(const ReplayFacts& facts, const std::vector<RunRecord>& runs,
                              const std::vector<RunScore>& scores) {
  const bool has_truth = !facts.truth_file.empty();
  const std::vector<RunScore> right = successful(scores);
  const auto median = [&](auto value) { return figure(medianOf(scores, value)); };
  Json json;
  json["runs"] = runs.size();
  json["success"] = has_truth ? Json(right.size()) : Json(nullptr);
  json["median_step"] =
      figure(medianOf(right, [](const auto& s) { return static_cast<double>(*s.step); }));
  json["particles"] = median([](const auto& s) { return static_cast<double>(s.first_particles); });
  json["search_ms"] = median([](const auto& s) { return s.search_ms; });
  json["first_step_ms"] = median([](const auto& s) { return s.first_step_ms; });
  json["total_ms"] = median([](const auto& s) { return s.total_ms; });
  json["first_step_cpu_ms"] = median([](const auto& s) { return s.first_step_cpu_ms; });
  json["total_cpu_ms"] = median([](const auto& s) { return s.total_cpu_ms; });
  json["max_step_ms"] = median([](const auto& s) { return s.max_step_ms; });
  json["recovery_ms"] = median([](const auto& s) { return s.recovery_ms; });
  json["mean_particles"] = median([](const auto& s) { return s.mean_particles; });
  json["searches"] = median([](const auto& s) { return static_cast<double>(s.searches); });
  json["mixes"] = median([](const auto& s) { return static_cast<double>(s.mixes); });
  json["median_error_m"] = figure(medianOf(right, [](const auto& s) { return s.error_m; }));
  json["median_error_deg"] =
      figure(medianOf(right, [](const auto& s) { return toDegrees(s.error_rad); }));
  if (facts.init == "tracker") {
    const RunScore& first = scores.front();  // nothing is left to chance: all runs are alike
    json["unique_step"] = orNull(first.unique_step);
    json["unique_steps"] = first.unique_steps;
    json["unique_right"] = first.unique_judged == 0
                               ? Json(nullptr)
                               : Json(static_cast<double>(first.unique_right) /
                                      static_cast<double>(first.unique_judged));
  }
  json["steps"] = facts.steps;
  json["init"] = facts.init;
  json["maps"] = facts.maps;
  json["rawlog"] = facts.rawlog;
  json["truth"] = has_truth ? Json(facts.truth_file) : Json(nullptr);
  json["index_build_s"] = facts.index_build_s;
  Json gaps = Json::array();
  for (std::size_t g = 0; g < facts.gaps.size(); ++g) {
    gaps.push_back(gapSummary(g, facts.gaps[g], scores));
  }
  json["teleports"] = gaps;
  Json all = Json::array();
  for (std::size_t i = 0; i < runs.size(); ++i)
    all.push_back(perRun(runs[i], scores[i], has_truth));
  json["per_run"] = all;
  return json.dump(2) + "\n";
}

std::string replaySummaryText(const ReplayFacts& facts, const std::vector<RunScore>& scores) {
  const std::vector<RunScore> right = successful(scores);
  const auto figure_of = [&](const char* pattern, auto value) {
    return format(pattern, medianOf(scores, value));
  };
  std::string text = "init " + facts.init + ", " + std::to_string(facts.steps) + " steps, map " +
                     facts.maps + "\n";
  if (!facts.truth_file.empty()) {
    const auto of_right = [&](const char* pattern, auto value) {
      return format(pattern, medianOf(right, value));
    };
    text += "success       " + std::to_string(right.size()) + " of " +
            std::to_string(scores.size()) + "\nfrom step     " +
            of_right("%.1f", [](const auto& s) { return static_cast<double>(*s.step); }) +
            " (median)\nerror         " +
            of_right("%.3f", [](const auto& s) { return s.error_m; }) + " m, " +
            of_right("%.2f", [](const auto& s) { return toDegrees(s.error_rad); }) + " deg\n";
  }
  text += "particles     " +
          figure_of("%.0f", [](const auto& s) { return static_cast<double>(s.first_particles); }) +
          " at first, " + figure_of("%.0f", [](const auto& s) { return s.mean_particles; }) +
          " on average\nms            search " +
          figure_of("%.1f", [](const auto& s) { return s.search_ms; }) + ", first step " +
          figure_of("%.2f", [](const auto& s) { return s.first_step_ms; }) + ", whole filter " +
          figure_of("%.1f", [](const auto& s) { return s.total_ms; }) + ", recovery " +
          figure_of("%.1f", [](const auto& s) { return s.recovery_ms; }) +
          "\nCPU ms        first step " +
          figure_of("%.2f", [](const auto& s) { return s.first_step_cpu_ms; }) + ", whole filter " +
          figure_of("%.1f", [](const auto& s) { return s.total_cpu_ms; }) + "\n";
  if (facts.init == "tracker" && scores.front().unique_step) {
    const RunScore& first = scores.front();
    text += "unique        from step " + std::to_string(*first.unique_step) + " on first, " +
            std::to_string(first.unique_steps) + " steps";
    if (first.unique_judged > 0) {
      text += ", right " + std::to_string(first.unique_right) + " of " +
              std::to_string(first.unique_judged);
    }
    text += "\n";
  }
  for (std::size_t g = 0; g < facts.gaps.size(); ++g) {
    const Json gap = gapSummary(g, facts.gaps[g], scores);
    text += "carried to step " + std::to_string(facts.gaps[g]);
    if (!facts.truth_file.empty()) {
      text += ": found in " + gap["recovered"].dump() + " of " + std::to_string(scores.size()) +
              " runs, after " + gap["median_scans"].dump() + " scans (median), " +
              gap["max_scans"].dump() + " at most";
    }
    text += "\n";
  }
  return text;
}

std::string stepsCsv(const std::vector<RunRecord>& runs, const Truth& truth) {
  std::string text =
      "run,seed,step,stamp,x,y,phi_deg,std_x,std_y,std_phi_deg,particles,fit,health,search,"
      "hypotheses,best_fit,mixed_in,error_m,error_deg,filter_ms,filter_cpu_ms,search_ms,monitor_"
      "ms\n";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (const StepRecord& step : runs[i].steps) {
      const auto spread = [&step](int axis) {
        return std::sqrt(std::max(0.0, step.covariance(axis, axis)));
      };
      text += formatted("%zu,%u,%zu,%.6f,%.4f,%.4f,%.3f,%.4f,%.4f,%.3f,%zu,", i, runs[i].seed,
                        step.step, step.stamp, step.estimate.x, step.estimate.y,
                        toDegrees(step.estimate.phi), spread(0), spread(1), toDegrees(spread(2)),
                        step.particles);
      text += step.fit ? format("%.4f", *step.fit) : "";
      text += std::string(",") + (step.health ? healthName(*step.health) : "");
      text += std::string(",") + (step.search ? mrpt_polyloc::toString(*step.search) : "");
      text += "," + (step.search ? std::to_string(step.hypotheses) : "");
      text += "," + (step.best_fit ? format("%.4f", *step.best_fit) : "");
      text += std::string(",") + (step.search ? step.mixed_in ? "1" : "0" : "");
      const auto error = errorOf(step, truth);
      text += "," + (error ? format("%.4f", error->m) : "");
      text += "," + (error ? format("%.3f", toDegrees(error->rad)) : "");
      text += formatted(",%.3f,%.3f,%.3f,%.3f\n", step.filter_ms, step.filter_cpu_ms,
                        step.search_ms, step.monitor_ms);
    }
  }
  return text;
}

}  // namespace mrpt_polyloc::replay
