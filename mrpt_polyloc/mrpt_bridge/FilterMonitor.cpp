#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/mrpt_bridge/FilterMonitor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mrpt_polyloc {
namespace {

/// The upper median; at least one value.
double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void FilterMonitorParams::check() const {
  requireInRange("least_steps", static_cast<double>(least_steps), 1.0, 1e6);
  requireInRange("window", static_cast<double>(window), static_cast<double>(least_steps), 1e6);
  requirePositive("deviations", deviations);
  requirePositive("least_deviation", least_deviation);
  requireInRange("patience", static_cast<double>(patience), 1.0, 1e6);
}

FilterMonitor::FilterMonitor(const FilterMonitorParams& params) : params_(params) {
  params_.check();
}

double FilterMonitor::threshold() const {
  if (healthy_.size() < params_.least_steps) return -std::numeric_limits<double>::infinity();
  std::vector<double> values(healthy_.begin(), healthy_.end());
  const double median = medianOf(values);
  for (double& value : values) value = std::abs(value - median);
  constexpr double kNormalFromMad = 1.4826;
  const double deviation = std::max(kNormalFromMad * medianOf(values), params_.least_deviation);
  return median - params_.deviations * deviation;
}

FilterHealth FilterMonitor::update(double log_likelihood_per_beam) {
  const double least = threshold();
  const bool is_learning = healthy_.size() < params_.least_steps;
  if (!std::isfinite(log_likelihood_per_beam) || log_likelihood_per_beam < least) {
    ++bad_steps_;
    if (is_learning) return FilterHealth::learning;
    return bad_steps_ < params_.patience ? FilterHealth::doubtful : FilterHealth::lost;
  }
  bad_steps_ = 0;
  healthy_.push_back(log_likelihood_per_beam);
  if (healthy_.size() > params_.window) healthy_.pop_front();
  return is_learning ? FilterHealth::learning : FilterHealth::healthy;
}

}  // namespace mrpt_polyloc
