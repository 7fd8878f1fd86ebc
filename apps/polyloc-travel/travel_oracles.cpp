#include "travel_oracles.h"

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/MapIndexParts.h>
#include <mrpt_polyloc/travel/ExpectedReadings.h>
#include <mrpt_polyloc/travel/PairEvidence.h>
#include <mrpt_polyloc/travel/verification_tour.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPose2D;

constexpr double kSpacing = 0.5;  // [m]
constexpr std::size_t kMostPlaces = 1500;
constexpr std::size_t kMostRivals = 6;

/// A pose that is sure.
Hypothesis sure(const TPose2D& pose) {
  Hypothesis hypothesis;
  hypothesis.pose_map_robot = pose;
  hypothesis.covariance = mrpt::math::CMatrixDouble33::Zero();
  hypothesis.weight = 1.0;
  return hypothesis;
}

/// Where the robot can drive in the true map, seen from a true pose.
SafeSet reachable(const TravelPlanner& planner, const TPose2D& truth, double most_distance) {
  SafeSetParams safe = planner.params().safe;
  safe.reach = std::max(safe.square, std::min(safe.reach, most_distance));
  const std::vector<Hypothesis> alone{sure(truth)};
  return SafeSet(planner.clearances(), alone, Sight({}, safe.robot_radius), safe);
}

/// What a laser that sees all around reads at a place, by brute force.
std::vector<double> readAt(const WallSegments& walls, const TPose2D& pose, const TPoint2D& place,
                           double max_range) {
  constexpr int kBeams = 120;
  const TPoint2D at = pose.composePoint(place);
  std::vector<double> ranges;
  for (int k = 0; k < kBeams; ++k) {
    ranges.push_back(std::min(max_range, walls.range(at, pose.phi + kTwoPi * k / kBeams)));
  }
  return ranges;
}

/// Share of the beams that differ from all beams beside them in the other scan.
double differingShare(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kFarApart = 0.3;  // [m]: more than poses are off by
  const std::size_t count = a.size();
  std::size_t differing = 0;
  for (std::size_t i = 0; i < count; ++i) {
    double least = 1e9;
    for (const std::size_t j : {(i + count - 1) % count, i, (i + 1) % count}) {
      least = std::min(least, std::abs(a[i] - b[j]));
    }
    differing += least > kFarApart ? 1 : 0;
  }
  return static_cast<double>(differing) / static_cast<double>(count);
}

}  // namespace

bool isTrulyIndistinguishable(const TravelPlanner& planner, const World& world,
                              const TravelRunResult& run, double most_distance) {
  constexpr double kFewBeams = 0.04;
  const TravelStep& last = run.steps.back();
  const auto right =
      std::find_if(last.hypotheses.begin(), last.hypotheses.end(), [&](const auto& hypothesis) {
        return isRight(hypothesis.pose_map_robot, last.truth, kSamePlace);
      });
  if (right == last.hypotheses.end() || last.hypotheses.size() < 2) return false;
  const SafeSet safe = reachable(planner, last.truth, most_distance);
  double spacing = kSpacing;
  std::vector<SafeSet::Place> places = safe.places(spacing);
  while (places.size() > kMostPlaces) places = safe.places(spacing *= 1.3);
  const WallSegments walls(world.map());
  const double max_range = world.laser().max_range;
  std::vector<std::vector<double>> truly;
  for (const SafeSet::Place& place : places) {
    truly.push_back(readAt(walls, right->pose_map_robot, place.point, max_range));
  }
  return std::any_of(last.hypotheses.begin(), last.hypotheses.end(), [&](const auto& rival) {
    if (rival.id == right->id) return false;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const std::vector<double> other =
          readAt(walls, rival.pose_map_robot, places[i].point, max_range);
      if (differingShare(truly[i], other) > kFewBeams &&
          differingShare(other, truly[i]) > kFewBeams) {
        return false;
      }
    }
    return true;
  });
}

std::optional<double> shortestTour(const TravelPlanner& planner, const World& world,
                                   const TravelRunResult& run) {
  const TPose2D truth = run.start;
  std::vector<Hypothesis> poses{sure(truth)};  // the truth, then its rivals
  for (const TrackedHypothesis& tracked : run.steps.front().hypotheses) {
    if (!isRight(tracked.pose_map_robot, truth, kSamePlace))
      poses.push_back(sure(tracked.pose_map_robot));
  }
  const std::size_t rivals = poses.size() - 1;
  if (rivals == 0 || rivals > kMostRivals) return std::nullopt;

  const SafeSet safe = reachable(planner, truth, planner.params().safe.reach);
  std::vector<TPoint2D> places;
  std::map<std::pair<int, int>, std::uint32_t> numbers;
  for (const SafeSet::Place& reached : safe.reached()) {
    const double column = reached.point.x / kSpacing, row = reached.point.y / kSpacing;
    const std::pair<int, int> key(static_cast<int>(std::round(column)),
                                  static_cast<int>(std::round(row)));
    const double half = 0.6 * planner.params().safe.square / kSpacing;
    if (std::abs(column - key.first) > half || std::abs(row - key.second) > half) continue;
    if (!numbers.emplace(key, static_cast<std::uint32_t>(places.size())).second) continue;
    places.push_back(reached.point);
    if (places.size() > kMostPlaces) return std::nullopt;
  }

  // Sixteen directions: walks are 1 % longer than straight ones on average, 3 % at most.
  TravelGraph graph(places.size());
  const std::vector<std::pair<int, int>> steps{{1, 0}, {0, 1}, {1, 1},  {1, -1},
                                               {2, 1}, {1, 2}, {2, -1}, {1, -2}};
  for (const auto& [key, number] : numbers) {
    for (const auto& [dx, dy] : steps) {
      const auto next = numbers.find({key.first + dx, key.second + dy});
      if (next == numbers.end()) continue;
      const TPoint2D a = places[number], b = places[next->second];
      bool is_safe = true;
      for (int k = 1; k < 12; ++k) is_safe = is_safe && safe.isReached(a + (b - a) * (k / 12.0));
      if (!is_safe) continue;
      graph[number].emplace_back(next->second, (b - a).norm());
      graph[next->second].emplace_back(number, (b - a).norm());
    }
  }

  const SimulatorParams& simulated = world.laser();
  LaserModel laser;  // turned to all sides: turning costs no way
  const std::size_t beams = planner.params().most_beams;
  for (std::size_t i = 0; i < beams; ++i) {
    laser.bearings.push_back(kTwoPi * (static_cast<double>(i) / static_cast<double>(beams) - 0.5));
  }
  laser.max_range = simulated.max_range;
  const ReadingExpectation expectation(planner.index().parts().predictor(), laser,
                                       planner.params().readings);
  const PairEvidence evidence(laser, planner.params().evidence);
  std::vector<std::uint32_t> told(places.size(), 0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const TPose2D moved(places[i].x, places[i].y, 0.0);
    const ExpectedReadings truly = expectation.at(poses[0], moved);
    for (std::size_t rival = 0; rival < rivals; ++rival) {
      const bool is_free =
          clearanceAt(planner.clearances(), poses[rival + 1].pose_map_robot, places[i]) > 0.0;
      const bool tells =
          !is_free || evidence.tells(truly, expectation.at(poses[rival + 1], moved)) >=
                          planner.params().least_telling;
      if (tells) told[i] |= std::uint32_t{1} << rival;
    }
  }
  return shortestVerificationTour(graph, 0, told, rivals);
}

}  // namespace mrpt_polyloc::apps
