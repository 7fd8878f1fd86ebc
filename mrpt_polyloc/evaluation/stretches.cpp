#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/evaluation/stretches.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace mrpt_polyloc {
namespace {

constexpr double kTail = 0.025;  // on either side of 95 %

/// Sum and number of the values of one stretch.
struct Tally {
  double sum = 0.0;
  double count = 0.0;
};

std::vector<Tally> tallies(const std::vector<double>& values,
                           const std::vector<std::size_t>& stretch) {
  if (values.size() != stretch.size()) {
    throw InvalidParamsError("stretch: " + std::to_string(stretch.size()) + " for " +
                             std::to_string(values.size()) + " values");
  }
  std::map<std::size_t, Tally> by_stretch;
  for (std::size_t i = 0; i < values.size(); ++i) {
    by_stretch[stretch[i]].sum += values[i];
    by_stretch[stretch[i]].count += 1.0;
  }
  std::vector<Tally> result;
  for (const auto& entry : by_stretch) result.push_back(entry.second);
  return result;
}

/// Percentiles of the mean over resampled stretches.
ShareInterval bootstrap(const std::vector<Tally>& stretches, std::uint64_t seed,
                        std::size_t resamples) {
  Random random(seed);
  std::vector<double> means;
  for (std::size_t k = 0; k < resamples; ++k) {
    Tally total;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      const auto drawn =
          static_cast<std::size_t>(random.unit() * static_cast<double>(stretches.size()));
      total.sum += stretches[drawn].sum;
      total.count += stretches[drawn].count;
    }
    means.push_back(total.sum / total.count);
  }
  return {percentile(means, kTail), percentile(means, 1.0 - kTail)};
}

/// The least share that so many successes in a row do not contradict.
double leastShare(std::size_t trials) {
  return std::pow(kTail, 1.0 / static_cast<double>(trials));
}

}  // namespace

std::vector<std::size_t> stretchesOf(const std::vector<mrpt::math::TPose2D>& drive,
                                     const StretchParams& params) {
  std::vector<std::size_t> stretch;
  double way = 0.0;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    if (i == 0) {
      stretch.push_back(0);
      continue;
    }
    const double step = std::hypot(drive[i].x - drive[i - 1].x, drive[i].y - drive[i - 1].y);
    way += step;
    const bool begins = step > params.jump || way >= params.length;
    if (begins) way = 0.0;
    stretch.push_back(stretch.back() + (begins ? 1 : 0));
  }
  return stretch;
}

ShareInterval shareInterval(const std::vector<bool>& values,
                            const std::vector<std::size_t>& stretch, std::uint64_t seed,
                            std::size_t resamples) {
  const std::vector<Tally> stretches =
      tallies(std::vector<double>(values.begin(), values.end()), stretch);
  if (values.empty()) return {};
  const auto right = std::count(values.begin(), values.end(), true);
  if (right == 0) return {0.0, 1.0 - leastShare(stretches.size())};
  if (static_cast<std::size_t>(right) == values.size()) return {leastShare(stretches.size()), 1.0};
  return bootstrap(stretches, seed, resamples);
}

ShareInterval differenceInterval(const std::vector<bool>& a, const std::vector<bool>& b,
                                 const std::vector<std::size_t>& stretch, std::uint64_t seed,
                                 std::size_t resamples) {
  if (a.size() != b.size()) throw InvalidParamsError("b: another number of values than a");
  std::vector<double> differences(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    differences[i] = static_cast<double>(a[i]) - static_cast<double>(b[i]);
  }
  const std::vector<Tally> stretches = tallies(differences, stretch);
  if (a.empty()) return {-1.0, 1.0};
  if (a == b) {
    const double most = 1.0 - leastShare(stretches.size());
    return {-most, most};
  }
  return bootstrap(stretches, seed, resamples);
}

}  // namespace mrpt_polyloc
