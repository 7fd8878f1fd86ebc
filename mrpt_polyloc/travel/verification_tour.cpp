#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/travel/verification_tour.h>

#include <functional>
#include <limits>
#include <queue>

namespace mrpt_polyloc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Entry = std::pair<double, std::size_t>;
using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

}  // namespace

std::vector<double> distancesFrom(const TravelGraph& graph, std::size_t start) {
  std::vector<double> distances(graph.size(), kInfinity);
  Queue queue;
  distances[start] = 0.0;
  queue.emplace(0.0, start);
  while (!queue.empty()) {
    const auto [distance, place] = queue.top();
    queue.pop();
    if (distance > distances[place]) continue;
    for (const auto& [next, length] : graph[place]) {
      if (distance + length >= distances[next]) continue;
      distances[next] = distance + length;
      queue.emplace(distances[next], next);
    }
  }
  return distances;
}

std::optional<double> shortestVerificationTour(const TravelGraph& graph, std::size_t start,
                                               const std::vector<std::uint32_t>& told,
                                               std::size_t rivals, bool back) {
  requireInRange("rivals", static_cast<double>(rivals), 0.0, static_cast<double>(kMostTourRivals));
  const std::vector<double> home = distancesFrom(graph, start);
  const std::size_t sets = std::size_t{1} << rivals, all = sets - 1;
  std::vector<double> distances(graph.size() * sets, kInfinity);
  Queue queue;
  const auto reach = [&](std::size_t place, std::size_t set, double distance) {
    const std::size_t state = place * sets + (set | (told[place] & all));
    if (distance >= distances[state]) return;
    distances[state] = distance;
    queue.emplace(distance, state);
  };
  reach(start, 0, 0.0);
  double best = kInfinity;
  while (!queue.empty()) {
    const auto [distance, state] = queue.top();
    queue.pop();
    if (distance >= best) break;
    if (distance > distances[state]) continue;
    const std::size_t place = state / sets, set = state % sets;
    if (set == all) {
      best = std::min(best, distance + (back ? home[place] : 0.0));
      continue;
    }
    for (const auto& [next, length] : graph[place]) reach(next, set, distance + length);
  }
  if (best == kInfinity) return std::nullopt;
  return best;
}

}  // namespace mrpt_polyloc
