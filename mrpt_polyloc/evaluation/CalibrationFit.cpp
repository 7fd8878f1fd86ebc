#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/evaluation/CalibrationFit.h>
#include <mrpt_polyloc/evaluation/LogisticRegression.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace mrpt_polyloc {
namespace {

using Samples = std::vector<CalibrationSample>;

bool isGood(const CalibrationSample& sample) {
  return sample.origin == ScanOrigin::own && sample.good;
}

bool hasRight(const CalibrationSample& sample) {
  return std::any_of(sample.candidates.begin(), sample.candidates.end(),
                     [](const CalibrationSample::Candidate& c) { return c.right; });
}

/// The softmax of the candidates that fall behind by so many errors: the first's share, and that of
/// all right ones.
struct Shares {
  double first = 0.0, right = 0.0;
};

Shares sharesOf(const CalibrationSample& sample, double decay) {
  double sum = 0.0, right = 0.0;
  const double least = sample.candidates.front().z_score;
  for (const CalibrationSample::Candidate& candidate : sample.candidates) {
    const double weight = std::exp(-decay * (candidate.z_score - least));
    sum += weight;
    right += candidate.right ? weight : 0.0;
  }
  return {1.0 / sum, right / sum};
}

void fitMatch(const Samples& samples, const CalibrationFitParams& params, Calibration& result) {
  double own = 0.0, foreign = 0.0;
  for (const CalibrationSample& sample : samples) {
    own += isGood(sample) ? 1.0 : 0.0;
    foreign += sample.origin == ScanOrigin::foreign ? 1.0 : 0.0;
  }
  std::vector<LogisticSample> examples;
  for (const CalibrationSample& sample : samples) {
    const auto values = sample.features.values();
    LogisticSample example{{values.begin(), values.end()}, sample.origin != ScanOrigin::foreign};
    if (sample.origin == ScanOrigin::own && !sample.good) continue;
    if (sample.origin == ScanOrigin::foreign) example.weight = own / foreign;
    if (sample.origin == ScanOrigin::cluttered) example.weight = params.clutter_weight;
    examples.push_back(std::move(example));
  }
  const LogisticModel model = fitLogistic(examples);
  result.match_intercept = model.intercept;
  std::copy(model.weights.begin(), model.weights.end(), result.match_weights.begin());

  std::vector<double> probabilities;
  for (const CalibrationSample& sample : samples) {
    if (isGood(sample)) probabilities.push_back(result.matchProbability(sample.features));
  }
  std::sort(probabilities.begin(), probabilities.end());
  const auto losing = [&](double share) {
    return probabilities[std::min(static_cast<std::size_t>(share * own), probabilities.size() - 1)];
  };
  result.least_match_probability = losing(params.lost);
  std::transform(Calibration::kLostShares.begin(), Calibration::kLostShares.end(),
                 result.lost_thresholds.begin(), losing);
}

double weightLoss(const Samples& samples, double decay) {
  double loss = 0.0;
  for (const CalibrationSample& sample : samples) {
    if (sample.origin != ScanOrigin::own || !hasRight(sample)) continue;
    loss -= std::log(std::max(sharesOf(sample, decay).right, 1e-300));
  }
  return loss;
}

/// By Brent's method over the logarithm of the decay.
double fitDecay(const Samples& samples) {
  constexpr int kBits = 20;  // of the place: more than the samples tell
  std::uintmax_t steps = 100;
  const auto loss = [&](double at) { return weightLoss(samples, std::exp(at)); };
  return std::exp(
      boost::math::tools::brent_find_minima(loss, std::log(0.05), std::log(50.0), kBits, steps)
          .first);
}

/// The probabilities that the first answers are right, of scans that are not refused.
std::vector<Forecast> firstsOf(const Samples& samples, ScanOrigin origin,
                               const Calibration& calibration) {
  std::vector<Forecast> firsts;
  for (const CalibrationSample& sample : samples) {
    if (sample.origin != origin) continue;
    const double match = calibration.matchProbability(sample.features);
    if (match < calibration.least_match_probability) continue;
    const double first = sharesOf(sample, calibration.weight_decay).first;
    firsts.push_back({match * first, sample.candidates.front().right});
  }
  return firsts;
}

/// What only the share of the foreign scans exceeds; 0 if fewer are not refused.
double exceededBy(double share, const Samples& samples, const Calibration& calibration) {
  const auto count = std::count_if(samples.begin(), samples.end(), [](const CalibrationSample& s) {
    return s.origin == ScanOrigin::foreign;
  });
  std::vector<Forecast> foreign = firstsOf(samples, ScanOrigin::foreign, calibration);
  const auto allowed = static_cast<std::size_t>(share * static_cast<double>(count));
  if (allowed >= foreign.size()) return 0.0;
  std::nth_element(
      foreign.begin(), foreign.begin() + static_cast<std::ptrdiff_t>(allowed), foreign.end(),
      [](const Forecast& a, const Forecast& b) { return a.probability > b.probability; });
  return foreign[allowed].probability;
}

/// The least threshold on the probability of the first from which on both shares are met; above 1
/// if there is none.
double fitUnique(const Samples& samples, const Calibration& calibration,
                 const CalibrationFitParams& params) {
  std::vector<Forecast> firsts = firstsOf(samples, ScanOrigin::own, calibration);
  const double foreign = exceededBy(params.foreign_unique, samples, calibration);
  std::sort(firsts.begin(), firsts.end(),
            [](const Forecast& a, const Forecast& b) { return a.probability > b.probability; });
  double threshold = 2.0, count = 0.0, right = 0.0;
  for (std::size_t i = 0; i < firsts.size(); ++i) {
    count += 1.0;
    right += firsts[i].came_true ? 1.0 : 0.0;
    const bool ties = i + 1 < firsts.size() && firsts[i + 1].probability == firsts[i].probability;
    if (firsts[i].probability <= foreign) break;
    if (!ties && right >= params.unique_right * count) threshold = firsts[i].probability;
  }
  return threshold;
}

void fitCovariance(const Samples& samples, Calibration& result) {
  double position = 0.0, heading = 0.0, count = 0.0;
  for (const CalibrationSample& sample : samples) {
    if (sample.origin != ScanOrigin::own || !sample.position_square) continue;
    position += *sample.position_square;
    heading += *sample.heading_square;
    count += 1.0;
  }
  if (count == 0.0) throw InvalidParamsError("there is no own scan with a right first answer");
  // Answers that are right to the last bit (simulated without noise) would claim to know all.
  constexpr double kLeastFactor = 0.05;
  result.position_factor = std::max(kLeastFactor, std::sqrt(position / (2.0 * count)));
  result.heading_factor = std::max(kLeastFactor, std::sqrt(heading / count));
}

}  // namespace

void CalibrationFitParams::check() const {
  requireInRange("lost", lost, 0.0, 0.5);
  requireInRange("unique_right", unique_right, 0.0, 1.0);
  requireInRange("foreign_unique", foreign_unique, 0.0, 1.0);
  requirePositive("clutter_weight", clutter_weight);
}

Calibration fitCalibration(const Samples& samples, const CalibrationFitParams& params) {
  params.check();
  if (std::none_of(samples.begin(), samples.end(), isGood)) {
    throw InvalidParamsError("there is no good own scan to calibrate with");
  }
  if (std::none_of(samples.begin(), samples.end(), [](const CalibrationSample& sample) {
        return sample.origin == ScanOrigin::foreign;
      })) {
    throw InvalidParamsError("there is no scan of another building to calibrate with");
  }
  Calibration result;
  fitMatch(samples, params, result);
  fitCovariance(samples, result);
  result.weight_decay = fitDecay(samples);
  result.unique_probability = fitUnique(samples, result, params);
  return result;
}

CalibrationOutcome judge(const Samples& samples, const std::vector<Calibration>& calibrations) {
  CalibrationOutcome outcome;
  std::vector<double> true_scores, foreign_scores;
  std::vector<Forecast> weights;
  double squares = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const CalibrationSample& sample = samples[i];
    const Calibration& calibration = calibrations.at(i);
    const double match = calibration.matchProbability(sample.features);
    const double first = sharesOf(sample, calibration.weight_decay).first;
    const bool refused = match < calibration.least_match_probability;
    const bool unique = !refused && match * first >= calibration.unique_probability;
    const bool right = sample.candidates.front().right;
    switch (sample.origin) {
      case ScanOrigin::foreign:
        foreign_scores.push_back(match);
        ++outcome.foreign;
        outcome.foreign_refused += refused;
        outcome.foreign_unique += unique;
        break;
      case ScanOrigin::cluttered:
        ++outcome.cluttered;
        outcome.cluttered_lost += refused;
        break;
      case ScanOrigin::own:
        if (sample.good) true_scores.push_back(match);
        outcome.good += sample.good;
        outcome.good_lost += sample.good && refused;
        outcome.unique += unique;
        outcome.unique_right += unique && right;
        if (!refused) weights.push_back({first, right});
        if (!sample.position_square) break;
        squares += 1.0;
        outcome.position_square +=
            *sample.position_square / std::pow(calibration.position_factor, 2);
        outcome.heading_square += *sample.heading_square / std::pow(calibration.heading_factor, 2);
        break;
    }
  }
  outcome.roc = rocCurve(std::move(true_scores), std::move(foreign_scores));
  outcome.reliability = reliability(weights, {0.0, 0.5, 0.7, 0.85, 0.95, 0.99, 1.0});
  if (squares > 0.0) {
    outcome.position_square /= squares;
    outcome.heading_square /= squares;
  }
  return outcome;
}

std::optional<std::vector<Calibration>> leaveOneMapOut(const Samples& samples,
                                                       const CalibrationFitParams& params) {
  std::map<std::size_t, Calibration> folds;
  std::vector<Calibration> calibrations;
  for (const CalibrationSample& sample : samples) {
    auto fold = folds.find(sample.map);
    if (fold == folds.end()) {
      Samples rest;
      std::copy_if(samples.begin(), samples.end(), std::back_inserter(rest),
                   [&](const CalibrationSample& other) {
                     return other.map != sample.map && other.set != sample.map;
                   });
      try {
        fold = folds.emplace(sample.map, fitCalibration(rest, params)).first;
      } catch (const InvalidParamsError&) {
        return std::nullopt;
      }
    }
    calibrations.push_back(fold->second);
  }
  return calibrations;
}

}  // namespace mrpt_polyloc
