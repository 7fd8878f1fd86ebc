#pragma once

#include <mrpt_polyloc/base/params_check.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <queue>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace mrpt_polyloc {

/// Monotonous bisector tree: nearest neighbours in any metric space, with few evaluations of
/// a metric that takes long (Noltemeier, Verbarg, Zirkelbach).
///
/// Every node splits its objects by which of two pivots is closer; the half of a pivot keeps it as
/// one of its own pivots. So the radius around a pivot never grows on the way down, and a query
/// evaluates one new distance per node. An object may have a radius: it is then the ball of all
/// that is within the radius of its centre, and its distance is that of the ball (a visibility cell
/// around its representative view).
///
/// `Metric` is called as `double metric(const Object&, const Object&)` while building, and as
/// `double metric(const Query&, const Object&)` by queries; it must satisfy the triangle inequality
/// up to its error. Immutable; queries are const and as thread-safe as the metric.
template <class Object, class Metric>
class MetricTree {
 public:
  /// A pair of pivots. `home` is inherited (the root's apart), `away` is the node's own.
  struct Node {
    std::size_t home, away;
    double home_radius, away_radius;    ///< of the objects on either side, their radii included
    double home_largest, away_largest;  ///< greatest radius of an object on either side
    std::int32_t home_child, away_child;
    std::size_t depth;
  };

  struct Neighbor {
    std::size_t index;  ///< of the object, in the order given
    double distance;    ///< less the object's radius, at least 0
  };

  struct Result {
    std::vector<Neighbor> neighbors;  ///< by distance, then by index
    std::size_t evaluations = 0;      ///< of the metric
  };

  /// \param radii of the objects; empty: all zero
  /// \param seed chooses the first pivot; all else follows from the metric
  /// \param metric_error by how much an evaluated distance may be off, for bounds that still hold
  /// \throws InvalidParamsError if there are not as many radii as objects, if one is negative or
  /// not finite, or if metric_error is.
  /// Expected O(n log n) evaluations, O(n^2) at worst; O(n) memory.
  explicit MetricTree(std::vector<Object> objects, Metric metric = {},
                      std::vector<double> radii = {}, std::uint32_t seed = 0,
                      double metric_error = 0.0)
      : objects_(std::move(objects)),
        metric_(std::move(metric)),
        radii_(std::move(radii)),
        metric_error_(metric_error) {
    if (radii_.empty()) radii_.assign(objects_.size(), 0.0);
    if (radii_.size() != objects_.size())
      throw InvalidParamsError(std::to_string(radii_.size()) + " radii for " +
                               std::to_string(objects_.size()) + " objects");
    for (std::size_t i = 0; i < radii_.size(); ++i)
      requireNotNegative(("radius " + std::to_string(i)).c_str(), radii_[i]);
    requireNotNegative("metric_error", metric_error_);
    build(seed);
  }

  std::size_t size() const { return objects_.size(); }
  const std::vector<Object>& objects() const { return objects_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Evaluations of the metric that building took.
  std::size_t buildEvaluations() const { return build_evaluations_; }

  /// Calls visit(index, distance) from the nearest object on, equally far ones by their index,
  /// until it returns false. \returns evaluations of the metric
  template <class Query, class Visit>
  std::size_t visitNearest(const Query& query, Visit visit) const {
    std::size_t evaluations = 0;
    if (objects_.empty()) return evaluations;
    std::priority_queue<Neighbor, std::vector<Neighbor>, Farther> known;  // the nearest on top
    const auto evaluate = [&](std::size_t index) {
      ++evaluations;
      const double distance = metric_(query, objects_[index]);
      known.push({index, std::max(0.0, distance - radii_[index])});
      return distance;
    };
    std::priority_queue<Open> visits;
    const double to_root = evaluate(root_);
    if (!nodes_.empty()) visits.push({0.0, 0, to_root});
    while (!known.empty() || !visits.empty()) {
      // What is known is next if no node can hold one that is as near.
      if (!known.empty() && (visits.empty() || known.top().distance < visits.top().bound)) {
        if (!visit(known.top().index, known.top().distance)) break;
        known.pop();
        continue;
      }
      const Open next = visits.top();
      visits.pop();
      const Node& node = nodes_[static_cast<std::size_t>(next.node)];
      const double to_home = next.to_home, to_away = evaluate(node.away);
      // By the triangle inequality through the pivot, and because the other pivot is farther. Up to
      // four evaluated distances take part: from pivot and object, when building and now.
      const auto push = [&](std::int32_t child, double to_pivot, double to_other, double radius,
                            double largest) {
        if (child == kNone) return;
        visits.push({std::max({next.bound, to_pivot - radius - 4.0 * metric_error_,
                               0.5 * (to_pivot - to_other) - largest - 4.0 * metric_error_}),
                     child, to_pivot});
      };
      push(node.home_child, to_home, to_away, node.home_radius, node.home_largest);
      push(node.away_child, to_away, to_home, node.away_radius, node.away_largest);
    }
    return evaluations;
  }

  /// The `count` nearest objects (all, if there are fewer). Equally far ones: those of least index.
  template <class Query>
  Result nearest(const Query& query, std::size_t count) const {
    Result result;
    if (count == 0) return result;
    result.evaluations = visitNearest(query, [&](std::size_t index, double distance) {
      result.neighbors.push_back({index, distance});
      return result.neighbors.size() < count;
    });
    return result;
  }

  /// All objects within a distance (inclusive).
  template <class Query>
  Result within(const Query& query, double distance) const {
    Result result;
    result.evaluations = visitNearest(query, [&](std::size_t index, double found) {
      if (found <= distance) result.neighbors.push_back({index, found});
      return found <= distance;
    });
    return result;
  }

 private:
  static constexpr std::int32_t kNone = -1;

  struct Farther {
    bool operator()(const Neighbor& a, const Neighbor& b) const {
      return a.distance > b.distance || (a.distance == b.distance && a.index > b.index);
    }
  };

  /// An object and its distance from the pivot that a node inherits.
  struct Member {
    std::size_t index;
    double to_home;
  };

  /// Objects that are still to be given a node.
  struct Task {
    std::vector<Member> members;
    std::size_t home;
    std::int32_t parent;
    bool is_home_child;
    std::size_t depth;
  };

  /// A node that is still to be searched.
  struct Open {
    double bound;
    std::int32_t node;
    double to_home;
    bool operator<(const Open& other) const { return bound > other.bound; }  // least on top
  };

  double evaluateForBuild(std::size_t a, std::size_t b) {
    ++build_evaluations_;
    return metric_(objects_[a], objects_[b]);
  }

  // With a stack of its own: in an unlucky metric the tree may be as deep as it has objects.
  void build(std::uint32_t seed) {
    if (objects_.empty()) return;
    root_ = std::mt19937(seed)() % objects_.size();
    Task first{{}, root_, kNone, true, 0};
    for (std::size_t i = 0; i < objects_.size(); ++i)
      if (i != root_) first.members.push_back({i, evaluateForBuild(i, root_)});
    std::vector<Task> tasks;
    tasks.push_back(std::move(first));
    while (!tasks.empty()) {
      Task task = std::move(tasks.back());
      tasks.pop_back();
      if (!task.members.empty()) split(std::move(task), tasks);
    }
  }

  void split(Task task, std::vector<Task>& tasks) {
    auto& members = task.members;
    // The farthest object as the new pivot makes both radii shrink.
    const auto farthest =
        std::max_element(members.begin(), members.end(),
                         [](const Member& a, const Member& b) { return a.to_home < b.to_home; });
    Node node{task.home, farthest->index, 0, 0, 0, 0, kNone, kNone, task.depth};
    // All in one place: no split would get on; halves keep the tree shallow.
    const bool all_equal = farthest->to_home == 0.0;
    members.erase(farthest);

    const auto number = static_cast<std::int32_t>(nodes_.size());
    Task home{{}, node.home, number, true, task.depth + 1};
    Task away{{}, node.away, number, false, task.depth + 1};
    for (std::size_t i = 0; i < members.size(); ++i) {
      const Member& member = members[i];
      const double radius = radii_[member.index];
      const double to_away = all_equal ? 0.0 : evaluateForBuild(member.index, node.away);
      const bool at_home = all_equal ? i % 2 == 0 : member.to_home <= to_away;
      if (at_home) {
        home.members.push_back(member);
        node.home_radius = std::max(node.home_radius, member.to_home + radius);
        node.home_largest = std::max(node.home_largest, radius);
      } else {
        away.members.push_back({member.index, to_away});
        node.away_radius = std::max(node.away_radius, to_away + radius);
        node.away_largest = std::max(node.away_largest, radius);
      }
    }
    nodes_.push_back(node);
    if (task.parent != kNone) {
      Node& parent = nodes_[static_cast<std::size_t>(task.parent)];
      (task.is_home_child ? parent.home_child : parent.away_child) = number;
    }
    tasks.push_back(std::move(away));
    tasks.push_back(std::move(home));
  }

  std::vector<Object> objects_;
  Metric metric_;
  std::vector<double> radii_;
  double metric_error_;
  std::size_t root_ = 0;
  std::vector<Node> nodes_;
  std::size_t build_evaluations_ = 0;
};

}  // namespace mrpt_polyloc
