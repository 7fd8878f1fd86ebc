#include "baseline_methods.h"

#include <mrpt_polyloc/evaluation/baselines/CorrelativeMatcher.h>
#include <mrpt_polyloc/evaluation/baselines/LikelihoodLattice.h>
#include <mrpt_polyloc/evaluation/baselines/ParticleFilterBaseline.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace mrpt_polyloc::apps {
namespace {

constexpr const char* kLattice = "likelihood_lattice";
constexpr const char* kCorrelative = "correlative";
constexpr const char* kFilter = "particle_filter";

LocalizationResult resultOfBaseline(const std::vector<BaselineAnswer>& answers) {
  LocalizationResult result;
  if (answers.empty()) return result;  // too few beams
  result.status = LocalizationStatus::ambiguous;
  for (const BaselineAnswer& answer : answers) {
    Hypothesis hypothesis;
    hypothesis.pose_map_robot = answer.pose_map_robot;
    hypothesis.weight = answer.score;
    hypothesis.cost = 1.0 - answer.score;
    hypothesis.z_score = std::numeric_limits<double>::quiet_NaN();  // it does not tell
    result.hypotheses.push_back(hypothesis);
  }
  result.match_probability = answers.front().score;
  return result;
}

ScanLocalizer makeLattice(const PolygonMap& map, const OccupancyBitmap& bitmap,
                          const BaselineOptions& options) {
  LikelihoodLatticeParams params;
  if (options.step) params.step = *options.step;
  if (options.sigma) params.sigma = *options.sigma;
  if (options.headings > 0) params.headings = options.headings;
  if (options.refined > 0) params.refined = options.refined;
  if (options.hits > 0) params.fine_hits = options.hits;
  const auto lattice = std::make_shared<const LikelihoodLattice>(bitmap, params);
  return {map,
          [lattice](const RangeScan& scan, const PosePrior&) {
            return resultOfBaseline(lattice->localize(scan));
          },
          lattice->bytes()};
}

ScanLocalizer makeCorrelative(const PolygonMap& map, const OccupancyBitmap& bitmap,
                              const BaselineOptions& options) {
  CorrelativeMatcherParams params;
  if (options.sigma) params.sigma = *options.sigma;
  if (options.hits > 0) params.most_hits = options.hits;
  const auto matcher = std::make_shared<const CorrelativeMatcher>(bitmap, params);
  return {map,
          [matcher](const RangeScan& scan, const PosePrior&) {
            const auto answer = matcher->localize(scan);
            return resultOfBaseline(answer ? std::vector<BaselineAnswer>{*answer}
                                           : std::vector<BaselineAnswer>{});
          },
          matcher->bytes()};
}

ScanLocalizer makeFilter(const PolygonMap& map, const OccupancyBitmap& bitmap,
                         const BaselineOptions& options) {
  ParticleFilterBaselineParams params;
  if (options.sigma) params.sigma = *options.sigma;
  if (options.particles > 0) params.particles = options.particles;
  const auto filter = std::make_shared<const ParticleFilterBaseline>(bitmap, params);
  const auto localize = [filter](const ScanSet& drive, const PosePrior&) {
    // Each row has random numbers of its own, the same in each run.
    const double stamp = drive.now().scans.front().stamp();
    const auto seed = static_cast<std::uint32_t>(std::llround(1e3 * std::abs(stamp)));
    return resultOfBaseline(filter->localize(drive, seed));
  };
  return {map,
          [localize](const RangeScan& scan, const PosePrior& prior) {
            return localize(ScanSet(scan), prior);
          },
          filter->bytes(), localize};
}

}  // namespace

bool isBaseline(const std::string& method) {
  return method == kLattice || method == kCorrelative || method == kFilter;
}

bool needsDrive(const BaselineOptions& options) {
  return options.method == kFilter;
}

void addBaselineOptions(CLI::App& cli, BaselineOptions& options) {
  addNumber(cli, "--cell", options.cell, {0.0, 10.0, true}, "Cells of drawn maps");
  addNumber(
      cli, "--step", [&options](double step) { options.step = step; }, {0.0, 100.0, true},
      "Between positions of the lattice");
  addNumber(
      cli, "--sigma", [&options](double sigma) { options.sigma = sigma; }, {0.0, 100.0, true},
      "Standard deviation of a hit beside a wall");
  addCount(cli, "--headings", options.headings, 1, 10'000, "Headings of the lattice");
  addCount(cli, "--refined", options.refined, 1, 1'000'000, "Lattice poses that are aligned");
  addCount(cli, "--hits", options.hits, 1, 1'000'000, "Hits that take part");
  addCount(cli, "--particles", options.particles, 1, 10'000'000, "Particles at first, and at most");
  addNumber(cli, "--drive", options.drive, {0.0, 1e3}, "Metres of the drive before each row");
}

ScanLocalizer makeBaseline(const PolygonMap& map, const OccupancyBitmap& bitmap,
                           const BaselineOptions& options) {
  if (options.method == kLattice) return makeLattice(map, bitmap, options);
  if (options.method == kFilter) return makeFilter(map, bitmap, options);
  return makeCorrelative(map, bitmap, options);
}

}  // namespace mrpt_polyloc::apps
