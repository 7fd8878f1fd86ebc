#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/search/deeper_bottoms.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

constexpr double kFirstStep = 0.1, kLastStep = 0.0125;  // [m]
constexpr double kTurn = 0.4;                           // [rad] for each metre of a step
constexpr int kMostTries = 80;                          // 25 to 50 are usual

/// Down by the cost alone: the first cheaper pose of the six beside is taken, and where there is
/// none the step is halved.
PoseCandidate compassSearch(PoseCandidate at, const PoseScorer& scorer) {
  constexpr std::array<std::array<double, 3>, 6> kSides = {
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, kTurn}, {0, 0, -kTurn}}};
  int tries = 0;
  std::size_t side = 0, failed = 0;
  for (double step = kFirstStep; step >= kLastStep && tries < kMostTries; ++tries) {
    const TPose2D& from = at.pose_map_beams;
    const std::array<double, 3>& way = kSides[side];
    const TPose2D next(from.x + step * way[0], from.y + step * way[1], from.phi + step * way[2]);
    const double cost = scorer.costIfAllowed(next);
    if (cost < at.cost) {
      at = {next, cost};
      failed = 0;  // on along the same way
      continue;
    }
    side = (side + 1) % kSides.size();
    if (++failed == kSides.size()) {
      step *= 0.5;
      failed = 0;
    }
  }
  return at;
}

/// The cheapest of some poses around.
PoseCandidate cheapestAround(const TPose2D& pose, const PoseScorer& scorer) {
  constexpr std::array<double, 2> kRadii = {0.2, 0.35};  // [m]
  constexpr int kDirections = 8;
  PoseCandidate best{pose, std::numeric_limits<double>::infinity()};
  for (const double radius : kRadii) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = kTwoPi * i / kDirections;
      const TPose2D next(pose.x + radius * std::cos(angle), pose.y + radius * std::sin(angle),
                         pose.phi);
      const double cost = scorer.costIfAllowed(next);
      if (cost < best.cost) best = {next, cost};
    }
  }
  return best;
}

}  // namespace

DeeperBottoms deeperBottoms(const std::vector<PoseCandidate>& optima, const PoseScorer& scorer,
                            const Budget& budget) {
  // From each optimum two ways: from itself, and from the cheapest pose around.
  std::vector<PoseCandidate> ends(2 * optima.size());
  budget.forEach(ends.size(), 1, [&](std::size_t i) {
    const PoseCandidate& optimum = optima[i / 2];
    ends[i] = compassSearch(i % 2 == 0 ? optimum : cheapestAround(optimum.pose_map_beams, scorer),
                            scorer);
  });
  DeeperBottoms result{optima.front().cost, {}};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    result.least = std::min(result.least, ends[i].cost);
    if (ends[i].cost < optima[i / 2].cost) result.ends.push_back(ends[i]);
  }
  return result;
}

}  // namespace mrpt_polyloc
