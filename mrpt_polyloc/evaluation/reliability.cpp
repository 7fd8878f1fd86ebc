#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/reliability.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {

std::vector<ReliabilityBin> reliability(const std::vector<Forecast>& forecasts,
                                        const std::vector<double>& edges) {
  if (edges.size() < 2) throw InvalidParamsError("edges: fewer than two");
  std::vector<ReliabilityBin> bins;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (!(edges[i] < edges[i + 1])) throw InvalidParamsError("edges: not rising");
    ReliabilityBin bin;
    bin.from = edges[i];
    bin.to = edges[i + 1];
    bins.push_back(bin);
  }
  for (const Forecast& forecast : forecasts) {
    if (!(forecast.probability >= edges.front() && forecast.probability <= edges.back())) continue;
    const auto above = std::upper_bound(edges.begin(), edges.end(), forecast.probability);
    const auto place = static_cast<std::size_t>(above - edges.begin()) - 1;
    ReliabilityBin& bin = bins[std::min(place, bins.size() - 1)];
    ++bin.count;
    bin.stated += forecast.probability;
    bin.true_share += forecast.came_true ? 1.0 : 0.0;
  }
  for (ReliabilityBin& bin : bins) {
    if (bin.count == 0) continue;
    bin.stated /= static_cast<double>(bin.count);
    bin.true_share /= static_cast<double>(bin.count);
  }
  return bins;
}

double calibrationError(const std::vector<ReliabilityBin>& bins) {
  double sum = 0.0, count = 0.0;
  for (const ReliabilityBin& bin : bins) {
    sum += static_cast<double>(bin.count) * std::abs(bin.stated - bin.true_share);
    count += static_cast<double>(bin.count);
  }
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace mrpt_polyloc
