#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/CalibrationFit.h>
#include <mrpt_polyloc/evaluation/LogisticRegression.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc::test {
namespace {

using testing::HasSubstr;

constexpr double kTrueDecay = 2.0;

/// Features of a class, drawn about a mean.
MatchFeatures drawFeatures(Random& random, bool own) {
  const double shift = own ? 1.0 : -1.0;
  return {0.6 + 0.15 * (shift + random.normal()), 0.4 + 0.15 * (shift + random.normal()),
          -3.0 - 0.4 * (shift + random.normal()), 0.8 + 0.05 * (shift + random.normal())};
}

/// Own scans whose right hypothesis is drawn with the softmax of kTrueDecay, whose errors are 1.5
/// times (position) and 0.5 times (heading) what is stated.
CalibrationSample drawOwn(Random& random, std::size_t map) {
  CalibrationSample sample;
  sample.map = sample.set = map;
  sample.good = true;
  sample.features = drawFeatures(random, true);
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    sample.candidates.push_back({i == 0 ? 0.0 : random.uniform(0.0, 3.0), false});
    sum += std::exp(-kTrueDecay * sample.candidates.back().z_score);
  }
  std::sort(sample.candidates.begin(), sample.candidates.end(),
            [](const auto& a, const auto& b) { return a.z_score < b.z_score; });
  double lot = random.uniform(0.0, sum);
  for (auto& candidate : sample.candidates) {
    lot -= std::exp(-kTrueDecay * candidate.z_score);
    candidate.right = lot < 0.0;
    if (candidate.right) break;
  }
  if (sample.candidates.front().right) {
    const double x = 1.5 * random.normal(), y = 1.5 * random.normal(), t = 0.5 * random.normal();
    sample.position_square = x * x + y * y;
    sample.heading_square = t * t;
  }
  return sample;
}

std::vector<CalibrationSample> drawSamples(std::uint64_t seed, std::size_t maps = 4,
                                           std::size_t each = 600) {
  Random random(seed);
  std::vector<CalibrationSample> samples;
  for (std::size_t map = 0; map < maps; ++map) {
    for (std::size_t i = 0; i < each; ++i) samples.push_back(drawOwn(random, map));
    for (std::size_t i = 0; i < each; ++i) {
      CalibrationSample foreign = drawOwn(random, map);
      foreign.set = (map + 1 + i % (maps - 1)) % maps;
      foreign.origin = ScanOrigin::foreign;
      foreign.features = drawFeatures(random, false);
      for (auto& candidate : foreign.candidates) candidate.right = false;
      foreign.position_square = foreign.heading_square = std::nullopt;
      samples.push_back(foreign);
    }
  }
  return samples;
}

double firstShare(const CalibrationSample& sample, double decay) {
  double sum = 0.0;
  for (const auto& candidate : sample.candidates) sum += std::exp(-decay * candidate.z_score);
  return 1.0 / sum;
}

TEST(FitCalibration, FindsWhatTheSamplesWereDrawnWith) {
  const auto samples = drawSamples(1);
  const Calibration calibration = fitCalibration(samples);
  calibration.check();
  EXPECT_NEAR(calibration.weight_decay, kTrueDecay, 0.15);
  EXPECT_NEAR(calibration.position_factor, 1.5, 0.06);
  EXPECT_NEAR(calibration.heading_factor, 0.5, 0.03);
  EXPECT_GT(calibration.match_weights[0], 0.0);
  EXPECT_GT(calibration.match_weights[1], 0.0);
  EXPECT_LT(calibration.match_weights[2], 0.0);
  EXPECT_GT(calibration.match_weights[3], 0.0);
}

TEST(FitCalibration, TheDecayIsTheLikeliest) {
  const auto samples = drawSamples(2, 3, 200);
  const double decay = fitCalibration(samples).weight_decay;
  const auto loss = [&](double at) {
    double sum = 0.0;
    for (const CalibrationSample& sample : samples) {
      if (sample.origin != ScanOrigin::own) continue;
      for (const auto& candidate : sample.candidates) {
        if (candidate.right) {
          sum += at * candidate.z_score - std::log(firstShare(sample, at));
        }
      }
    }
    return sum;
  };
  EXPECT_LE(loss(decay), loss(1.01 * decay));
  EXPECT_LE(loss(decay), loss(0.99 * decay));
  EXPECT_NEAR((loss(decay + 1e-4) - loss(decay - 1e-4)) / 2e-4, 0.0, 0.05);
}

TEST(FitCalibration, LosesTheShareAskedFor) {
  const auto samples = drawSamples(3);
  for (const double lost : {0.0, 0.01, 0.1}) {
    CalibrationFitParams params;
    params.lost = lost;
    const Calibration calibration = fitCalibration(samples, params);
    double refused = 0.0, all = 0.0;
    for (const CalibrationSample& sample : samples) {
      if (sample.origin != ScanOrigin::own) continue;
      all += 1.0;
      refused +=
          calibration.matchProbability(sample.features) < calibration.least_match_probability;
    }
    EXPECT_LE(refused, lost * all);
    EXPECT_GE(refused, lost * all - 1.0);
  }
}

TEST(FitCalibration, TheThresholdOfUniqueIsTheLeastThatHolds) {
  const auto samples = drawSamples(4);
  CalibrationFitParams params;
  params.lost = 0.0;
  params.unique_right = 0.9;
  const Calibration calibration = fitCalibration(samples, params);
  std::vector<std::pair<double, bool>> firsts;
  for (const CalibrationSample& sample : samples) {
    if (sample.origin != ScanOrigin::own) continue;
    firsts.emplace_back(calibration.matchProbability(sample.features) *
                            firstShare(sample, calibration.weight_decay),
                        sample.candidates.front().right);
  }
  // Brute force over all thresholds.
  double least = 2.0;
  for (const auto& [threshold, ignored] : firsts) {
    double count = 0.0, right = 0.0;
    for (const auto& [p, is_right] : firsts) {
      if (p < threshold) continue;
      count += 1.0;
      right += is_right;
    }
    if (right >= 0.9 * count) least = std::min(least, threshold);
  }
  EXPECT_LT(least, 1.0);
  EXPECT_DOUBLE_EQ(calibration.unique_probability, least);
}

TEST(FitCalibration, NoMoreForeignScansAreUniqueThanAllowed) {
  auto samples = drawSamples(7);
  for (std::size_t i = 0; i < samples.size(); i += 5) {  // some pass for a match, as own ones do
    if (samples[i].origin == ScanOrigin::foreign) samples[i].features = samples.front().features;
  }
  CalibrationFitParams params;
  params.lost = 0.0;
  params.unique_right = 0.0;
  std::size_t before = samples.size();
  for (const double share : {1.0, 0.1, 0.01, 0.0}) {
    params.foreign_unique = share;
    const Calibration calibration = fitCalibration(samples, params);
    const auto outcome = judge(samples, std::vector<Calibration>(samples.size(), calibration));
    EXPECT_LE(static_cast<double>(outcome.foreign_unique),
              share * static_cast<double>(outcome.foreign));
    EXPECT_LE(outcome.unique, before);
    before = outcome.unique;
  }
  EXPECT_GT(before, 0U);
}

TEST(FitCalibration, ThresholdsOfTheStatedShares) {
  const auto samples = drawSamples(8);
  const Calibration calibration = fitCalibration(samples);
  double all = 0.0;
  for (const CalibrationSample& sample : samples) all += sample.origin == ScanOrigin::own;
  for (const double share : Calibration::kLostShares) {
    const double threshold = calibration.thresholdFor(share);
    double lost = 0.0;
    for (const CalibrationSample& sample : samples) {
      if (sample.origin != ScanOrigin::own) continue;
      lost += calibration.matchProbability(sample.features) < threshold;
    }
    EXPECT_LE(lost, share * all);
    EXPECT_GE(lost, share * all - 1.0);
  }
}

TEST(FitCalibration, WhereNothingHoldsNothingIsUnique) {
  auto samples = drawSamples(5, 3, 50);
  double best = 0.0;
  CalibrationSample* surest = nullptr;
  const Calibration before = fitCalibration(samples);
  for (CalibrationSample& sample : samples) {
    if (sample.origin != ScanOrigin::own) continue;
    const double p =
        before.matchProbability(sample.features) * firstShare(sample, before.weight_decay);
    if (p > best) {
      best = p;
      surest = &sample;
    }
  }
  // Of all the surest one is wrong, and no share below one will do.
  for (auto& candidate : surest->candidates) candidate.right = false;
  CalibrationFitParams params;
  params.unique_right = 1.0;
  EXPECT_GT(fitCalibration(samples, params).unique_probability, 1.0);
}

TEST(Judge, CountsAreWhatCountingGives) {
  auto samples = drawSamples(6, 3, 100);
  samples[0].good = false;
  samples[1].origin = ScanOrigin::cluttered;
  samples[1].position_square = samples[1].heading_square = std::nullopt;
  const Calibration calibration = fitCalibration(samples);
  const auto outcome = judge(samples, std::vector<Calibration>(samples.size(), calibration));
  EXPECT_EQ(outcome.good, 298U);
  EXPECT_EQ(outcome.cluttered, 1U);
  EXPECT_EQ(outcome.foreign, 300U);
  std::size_t refused = 0, unique = 0, unique_right = 0, kept = 0;
  for (const CalibrationSample& sample : samples) {
    const double p = calibration.matchProbability(sample.features);
    const bool no_match = p < calibration.least_match_probability;
    if (sample.origin == ScanOrigin::foreign) refused += no_match;
    if (sample.origin != ScanOrigin::own || no_match) continue;
    ++kept;
    if (p * firstShare(sample, calibration.weight_decay) < calibration.unique_probability) continue;
    ++unique;
    unique_right += sample.candidates.front().right;
  }
  EXPECT_EQ(outcome.foreign_refused, refused);
  EXPECT_EQ(outcome.unique, unique);
  EXPECT_EQ(outcome.unique_right, unique_right);
  std::size_t in_bins = 0;
  for (const ReliabilityBin& bin : outcome.reliability) in_bins += bin.count;
  EXPECT_EQ(in_bins, kept);
  // Corrected by the factors the squares are what they should be.
  EXPECT_NEAR(outcome.position_square, 2.0, 1e-9);
  EXPECT_NEAR(outcome.heading_square, 1.0, 1e-9);
}

TEST(LeaveOneMapOut, AFoldKnowsNothingOfItsMap) {
  auto samples = drawSamples(7, 3, 60);
  const auto folds = leaveOneMapOut(samples);
  ASSERT_TRUE(folds.has_value());
  ASSERT_EQ(folds->size(), samples.size());
  // Whatever becomes of the samples of map 0 and of scans of set 0, its fold stays the same.
  for (CalibrationSample& sample : samples) {
    if (sample.map == 0 || sample.set == 0) sample.features = {0.1, 0.2, -1.0, 0.3};
  }
  const auto changed = leaveOneMapOut(samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].map != 0) continue;
    EXPECT_EQ((*folds)[i].match_weights, (*changed)[i].match_weights);
    EXPECT_EQ((*folds)[i].weight_decay, (*changed)[i].weight_decay);
  }
  EXPECT_FALSE(leaveOneMapOut(drawSamples(8, 2, 60)).has_value());  // nothing foreign is left
}

TEST(FitCalibration, SaysWhatIsMissing) {
  const auto complaint = [](const std::vector<CalibrationSample>& samples,
                            const CalibrationFitParams& params = {}) {
    try {
      fitCalibration(samples, params);
    } catch (const InvalidParamsError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  auto samples = drawSamples(9, 3, 20);
  EXPECT_THAT(complaint({}), HasSubstr("no good own scan"));
  std::vector<CalibrationSample> own;
  for (const auto& sample : samples) {
    if (sample.origin == ScanOrigin::own) own.push_back(sample);
  }
  EXPECT_THAT(complaint(own), HasSubstr("no scan of another building"));
  CalibrationFitParams params;
  params.lost = 0.9;
  EXPECT_THAT(complaint(samples, params), HasSubstr("lost"));
  for (auto& sample : samples) sample.position_square = sample.heading_square = std::nullopt;
  EXPECT_THAT(complaint(samples), HasSubstr("right first answer"));
}

}  // namespace
}  // namespace mrpt_polyloc::test
