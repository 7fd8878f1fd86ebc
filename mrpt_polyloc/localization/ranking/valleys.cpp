#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/matrices.h>
#include <mrpt_polyloc/localization/ranking/pose_covariance.h>
#include <mrpt_polyloc/localization/ranking/valleys.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

constexpr double kLong = 0.25;        // [m]: half of what a pose that nothing holds is given
constexpr double kAcross = 0.2;       // [m]
constexpr double kTurn = 0.07;        // [rad], 4 degrees
constexpr double kApart = 1.5;        // [m]: poses of a valley are found each half metre or so
constexpr double kRise = 0.01;        // [m]
constexpr double kValleyStep = 0.25;  // [m] along the way between two

/// The direction along which the scan does not hold a pose, if there is one.
std::optional<Eigen::Vector2d> longAxis(const RefinedPose& pose, std::size_t sectors) {
  const Eigen::Matrix2d position = toEigen(covarianceOfBeams(pose, sectors)).topLeftCorner<2, 2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(position);
  if (!(solver.eigenvalues()[1] >= kLong * kLong)) return std::nullopt;
  return Eigen::Vector2d(solver.eigenvectors().col(1));
}

Eigen::Vector2d wayBetween(const TPose2D& from, const TPose2D& to) {
  return {to.x - from.x, to.y - from.y};
}

bool liesAlong(const Eigen::Vector2d& way, const Eigen::Vector2d& axis) {
  return std::abs(way.x() * axis.y() - way.y() * axis.x()) < kAcross;
}

/// Whether the cost stays low on the straight way between two poses.
bool isLevel(const ScoredPose& from, const ScoredPose& to, const ScanCost& cost) {
  const TPose2D &a = from.refined.pose_map_beams, &b = to.refined.pose_map_beams;
  const double most = std::max(from.cost, to.cost) + kRise;
  const int steps = static_cast<int>(std::ceil(wayBetween(a, b).norm() / kValleyStep));
  const double turn = std::remainder(b.phi - a.phi, kTwoPi);
  for (int i = 1; i < steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const TPose2D between(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
                          a.phi + share * turn);
    if (cost.mean(between) > most) return false;
  }
  return true;
}

/// Numbers that are united step by step; each knows the least of its set.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t least(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::size_t a, std::size_t b) {
    const auto [low, high] = std::minmax({least(a), least(b)});
    parent_[high] = low;
  }

 private:
  std::vector<std::size_t> parent_;
};

Eigen::Vector2d positionOf(const Hypothesis& hypothesis) {
  return {hypothesis.pose_map_robot.x, hypothesis.pose_map_robot.y};
}

/// How much of a valley each of its members stands for, in all 1: its weight times the length to
/// the middles between it and its neighbours, for members may stand closer here than there.
std::vector<double> sharesOf(const std::vector<const Hypothesis*>& members) {
  Eigen::Vector2d middle(0, 0);
  for (const Hypothesis* member : members) middle += positionOf(*member);
  middle /= static_cast<double>(members.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const Hypothesis* member : members) {
    const Eigen::Vector2d off = positionOf(*member) - middle;
    scatter += off * off.transpose();
  }
  const Eigen::Vector2d axis =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(scatter).eigenvectors().col(1);
  std::vector<std::pair<double, std::size_t>> along;
  for (std::size_t i = 0; i < members.size(); ++i) {
    along.emplace_back(axis.dot(positionOf(*members[i])), i);
  }
  std::sort(along.begin(), along.end());
  std::vector<double> shares(members.size());
  double sum = 0.0;
  for (std::size_t k = 0; k < along.size(); ++k) {
    const double before = along[k == 0 ? 0 : k - 1].first;
    const double after = along[std::min(k + 1, along.size() - 1)].first;
    const std::size_t i = along[k].second;
    shares[i] = members[i]->weight * 0.5 * (after - before);
    sum += shares[i];
  }
  const double each = 1.0 / static_cast<double>(shares.size());
  for (double& share : shares) share = sum > 0.0 ? share / sum : each;
  return shares;
}

/// At the hypothesis nearest to the mean, of hypotheses that are ranked.
Hypothesis united(const std::vector<const Hypothesis*>& members) {
  Hypothesis result = *members.front();
  if (members.size() == 1) return result;
  const std::vector<double> shares = sharesOf(members);
  result.weight = 0.0;
  Eigen::Vector2d mean(0, 0);
  for (std::size_t i = 0; i < members.size(); ++i) {
    result.weight += members[i]->weight;
    mean += shares[i] * positionOf(*members[i]);
  }
  const Hypothesis* nearest = *std::min_element(
      members.begin(), members.end(), [&mean](const Hypothesis* a, const Hypothesis* b) {
        return (positionOf(*a) - mean).norm() < (positionOf(*b) - mean).norm();
      });
  result.pose_map_robot = nearest->pose_map_robot;
  result.cost = nearest->cost;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < members.size(); ++i) {
    const TPose2D& pose = members[i]->pose_map_robot;
    const Eigen::Vector3d away(pose.x - result.pose_map_robot.x, pose.y - result.pose_map_robot.y,
                               std::remainder(pose.phi - result.pose_map_robot.phi, kTwoPi));
    spread += shares[i] * (toEigen(members[i]->covariance) + away * away.transpose());
  }
  result.covariance = fromEigen(spread);
  return result;
}

}  // namespace

std::vector<std::size_t> valleysOf(const std::vector<ScoredPose>& poses, const ScanCost& cost,
                                   const BeamSectors& sectors) {
  std::vector<std::pair<std::size_t, Eigen::Vector2d>> uncertain;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::optional<Eigen::Vector2d> axis = longAxis(poses[i].refined, sectors.count());
    if (axis) uncertain.emplace_back(i, *axis);
  }
  // The nearest first, so that few ways are walked.
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t k = 0; k < uncertain.size(); ++k) {
    for (std::size_t m = k + 1; m < uncertain.size(); ++m) {
      const TPose2D& a = poses[uncertain[k].first].refined.pose_map_beams;
      const TPose2D& b = poses[uncertain[m].first].refined.pose_map_beams;
      const Eigen::Vector2d way = wayBetween(a, b);
      if (way.norm() > kApart || angleBetween(a.phi, b.phi) > kTurn) continue;
      if (!liesAlong(way, uncertain[k].second) || !liesAlong(way, uncertain[m].second)) continue;
      pairs.emplace_back(way.norm(), uncertain[k].first, uncertain[m].first);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  Sets sets(poses.size());
  for (const auto& [length, a, b] : pairs) {
    if (sets.least(a) != sets.least(b) && isLevel(poses[a], poses[b], cost)) sets.unite(a, b);
  }
  std::vector<std::size_t> valley(poses.size());
  for (std::size_t i = 0; i < valley.size(); ++i) valley[i] = sets.least(i);
  return valley;
}

std::vector<Hypothesis> uniteValleys(const std::vector<Hypothesis>& hypotheses,
                                     const std::vector<std::size_t>& valley) {
  std::map<std::size_t, std::size_t> group_of;
  std::vector<std::vector<const Hypothesis*>> groups;
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    const auto [found, is_new] = group_of.try_emplace(valley[i], groups.size());
    if (is_new) groups.emplace_back();
    groups[found->second].push_back(&hypotheses[i]);
  }
  std::vector<Hypothesis> result;
  for (const auto& members : groups) result.push_back(united(members));
  std::stable_sort(result.begin(), result.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.weight > b.weight; });
  return result;
}

}  // namespace mrpt_polyloc
