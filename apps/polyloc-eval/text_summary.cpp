#include "text_summary.h"

#include <mrpt_polyloc/base/number_text.h>

#include <functional>

namespace mrpt_polyloc::apps {
namespace {

std::string fixed(double value, int decimals, const char* unit) {
  return formatted("%.*f%s", decimals, value, unit);
}

std::string percent(double share) {
  return fixed(100.0 * share, 1, " %");
}

std::string orNone(const std::optional<double>& value, double factor, int decimals,
                   const char* unit) {
  return value ? fixed(factor * *value, decimals, unit) : "none";
}

std::string count(const Summary& summary, LocalizationStatus status) {
  return std::to_string(summary.status[static_cast<std::size_t>(status)]);
}

}  // namespace

std::string textSummary(const Summary& all, const std::optional<Summary>& good,
                        const IndexFigures& index) {
  std::string table;
  const auto row = [&](const char* name, const std::function<std::string(const Summary&)>& cell) {
    table += formatted("%-16s%14s%14s", name, cell(all).c_str(), good ? cell(*good).c_str() : "");
    table.erase(table.find_last_not_of(' ') + 1);
    table += '\n';
  };
  row("rows", [&](const Summary& s) { return std::string(&s == &all ? "all" : "good"); });
  row("scans", [](const Summary& s) { return std::to_string(s.scans); });
  row("top 1", [](const Summary& s) { return percent(s.top1); });
  row("top 5", [](const Summary& s) { return percent(s.top5); });
  row("top 20", [](const Summary& s) { return percent(s.top20); });
  row("in the list", [](const Summary& s) { return percent(s.in_list); });
  row("unique", [](const Summary& s) { return count(s, LocalizationStatus::unique); });
  row("  of these right", [](const Summary& s) { return orNone(s.unique_right, 100.0, 1, " %"); });
  row("ambiguous", [](const Summary& s) { return count(s, LocalizationStatus::ambiguous); });
  row("no match", [](const Summary& s) { return count(s, LocalizationStatus::no_match); });
  row("too few beams",
      [](const Summary& s) { return count(s, LocalizationStatus::too_few_beams); });
  row("median error", [](const Summary& s) { return orNone(s.median_error_m, 1.0, 3, " m"); });
  row("", [](const Summary& s) { return orNone(s.median_error_deg, 1.0, 2, " deg"); });
  row("median time", [](const Summary& s) { return fixed(s.ms_median, 1, " ms"); });
  row("90th percentile", [](const Summary& s) { return fixed(s.ms_p90, 1, " ms"); });
  row("longest", [](const Summary& s) { return fixed(s.ms_max, 1, " ms"); });
  return table + "index           " + fixed(index.build_s, 2, " s, ") + fixed(index.mb, 1, " MB\n");
}

}  // namespace mrpt_polyloc::apps
