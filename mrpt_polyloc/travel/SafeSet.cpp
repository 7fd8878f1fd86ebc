#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/travel/SafeSet.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_set>
#include <utility>

namespace mrpt_polyloc {
namespace {

enum State : std::int8_t { kUnknown, kRoomy, kTight, kUnsafe };

/// A metre where there is little room counts as so many.
constexpr float kTightCost = 3.0F;

/// Beside the start a robot may be as close to things as it is already [m].
constexpr double kNearby = 1.0;
/// Hypotheses and readings are off by some centimetres: what has the robot in a wall by less is
/// taken as free [m].
constexpr double kTolerated = 0.05;

/// Standard deviation of the position along its widest direction [m].
double spreadOf(const Hypothesis& hypothesis) {
  const double a = hypothesis.covariance(0, 0), b = hypothesis.covariance(0, 1),
               d = hypothesis.covariance(1, 1);
  return std::sqrt(std::max(0.0, 0.5 * (a + d) + std::hypot(0.5 * (a - d), b)));
}

}  // namespace

double clearanceAt(const ClearanceField& field, const mrpt::math::TPose2D& pose_map_robot,
                   const TPoint2D& place) {
  const double c = std::cos(pose_map_robot.phi), s = std::sin(pose_map_robot.phi);
  return field.at(
      {pose_map_robot.x + c * place.x - s * place.y, pose_map_robot.y + s * place.x + c * place.y});
}

void SafeSetParams::check() const {
  requirePositive("robot_radius", robot_radius);
  requireNotNegative("margin", margin);
  requireNotNegative("comfort", comfort);
  requireNotNegative("deviations", deviations);
  requireNotNegative("most_uncertainty", most_uncertainty);
  requireInRange("square", square, 0.01, 1.0);
  requireInRange("reach", reach, square, 1000.0 * square);
  requireInRange("quorum", quorum, 0.0, 1.0);
}

SafeSet::SafeSet(const ClearanceField& field, const std::vector<Hypothesis>& hypotheses,
                 const Sight& sight, const SafeSetParams& params)
    : field_(&field), hypotheses_(&hypotheses), sight_(&sight), params_(params) {
  params.check();
  const double radius = params.robot_radius + params.margin;
  for (const Hypothesis& hypothesis : hypotheses) {
    const double needed =
        radius + std::min(params.deviations * spreadOf(hypothesis), params.most_uncertainty);
    const double start = clearanceAt(field, hypothesis.pose_map_robot, {0, 0});
    needed_.push_back(std::min(needed, field.limit()));
    needed_nearby_.push_back(
        std::min(needed_.back(), std::max(start, params.robot_radius - kTolerated)));
  }
  start_hit_ = std::numeric_limits<double>::infinity();
  for (const TPoint2D& hit : sight.hits()) start_hit_ = std::min(start_hit_, hit.norm());
  is_start_free_ = start_hit_ >= params.robot_radius - kTolerated;

  const auto half = static_cast<std::size_t>(std::ceil(params.reach / params.square));
  side_ = 2 * half + 1;
  half_ = (static_cast<double>(half) + 0.5) * params.square;
  constexpr float kFar = std::numeric_limits<float>::infinity();
  squares_.assign(side_ * side_, {kFar, kFar, -1, kUnknown, false});
  block(sight);
  if (is_start_free_) spread();
  hypotheses_ = nullptr;
  sight_ = nullptr;
}

std::size_t SafeSet::index(const TPoint2D& point) const {
  const double column = (point.x + half_) / params_.square,
               row = (point.y + half_) / params_.square;
  const auto side = static_cast<double>(side_);
  if (!(column >= 0.0 && row >= 0.0 && column < side && row < side)) return squares_.size();
  return static_cast<std::size_t>(row) * side_ + static_cast<std::size_t>(column);
}

TPoint2D SafeSet::centre(std::size_t square) const {
  return {(static_cast<double>(square % side_) + 0.5) * params_.square - half_,
          (static_cast<double>(square / side_) + 0.5) * params_.square - half_};
}

/// Marks the squares in which the robot would touch what a scan hit.
void SafeSet::block(const Sight& sight) {
  const double radius = params_.robot_radius + params_.margin;
  const double nearby = std::min(radius, start_hit_);
  const auto span = static_cast<int>((radius + params_.comfort) / params_.square) + 1;
  for (const TPoint2D& hit : sight.hits()) {
    for (int row = -span; row <= span; ++row) {
      for (int column = -span; column <= span; ++column) {
        const std::size_t square =
            index({hit.x + column * params_.square, hit.y + row * params_.square});
        if (square == squares_.size()) continue;
        const TPoint2D at = centre(square);
        const double needed = at.norm() < kNearby ? nearby : radius;
        const double distance = (at - hit).norm();
        if (distance < needed) squares_[square].state = kUnsafe;
        if (distance < radius + params_.comfort) squares_[square].is_near_hit = true;
      }
    }
  }
}

bool SafeSet::mayBe(const TPoint2D& point, double room) const {
  const std::vector<double>& needed =
      point.norm() < kNearby && room == 0.0 ? needed_nearby_ : needed_;
  double for_it = 0.0, all = 0.0;
  bool is_unanimous = true;
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const Hypothesis& hypothesis = (*hypotheses_)[i];
    all += hypothesis.weight;
    const double least = std::min(needed[i] + room, field_->limit());
    if (clearanceAt(*field_, hypothesis.pose_map_robot, point) >= least) {
      for_it += hypothesis.weight;
    } else {
      is_unanimous = false;
      if (params_.quorum >= 1.0) break;
    }
  }
  if (is_unanimous && !needed.empty()) return true;
  if (params_.quorum < 1.0 && for_it >= params_.quorum * all) return true;
  // Whatever the maps say, what was seen free is.
  return sight_->seesDisc(point, params_.robot_radius + params_.margin + room);
}

bool SafeSet::isSafe(std::size_t square) {
  Square& at = squares_[square];
  if (at.state == kUnknown) {
    const TPoint2D point = centre(square);
    if (!at.is_near_hit && mayBe(point, params_.comfort)) {
      at.state = kRoomy;
    } else {
      at.state = mayBe(point, 0.0) ? kTight : kUnsafe;
    }
  }
  return at.state != kUnsafe;
}

/// Dijkstra's algorithm over neighbouring squares from where the robot stands, by cost: ways keep
/// to the middle where a little longer.
void SafeSet::spread() {
  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const std::size_t start = index({0, 0});
  squares_[start].state = kTight;
  squares_[start].cost = squares_[start].distance = 0.0F;
  queue.emplace(0.0F, start);
  const auto straight = static_cast<float>(params_.square);
  const auto diagonal = static_cast<float>(params_.square * std::sqrt(2.0));
  while (!queue.empty()) {
    const auto [cost, square] = queue.top();
    queue.pop();
    if (cost > squares_[square].cost) continue;
    const float distance = squares_[square].distance;
    reached_.push_back({centre(square), static_cast<double>(distance)});
    const std::size_t column = square % side_, row = square / side_;
    if (column == 0 || row == 0 || column + 1 == side_ || row + 1 == side_) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        const std::size_t next = (row + static_cast<std::size_t>(dy + 1) - 1) * side_ + column +
                                 static_cast<std::size_t>(dx + 1) - 1;
        const float step = dx == 0 || dy == 0 ? straight : diagonal;
        Square& there = squares_[next];
        if (cost + step >= there.cost || static_cast<double>(distance + step) > params_.reach ||
            !isSafe(next)) {
          continue;
        }
        const float cost_there = cost + (there.state == kRoomy ? step : kTightCost * step);
        if (cost_there >= there.cost) continue;
        there.cost = cost_there;
        there.distance = distance + step;
        there.from = static_cast<std::int32_t>(square);
        queue.emplace(cost_there, next);
      }
    }
  }
}

std::vector<SafeSet::Place> SafeSet::places(double spacing) const {
  const auto squares = std::max<std::size_t>(1, static_cast<std::size_t>(spacing / params_.square));
  const std::size_t blocks = side_ / squares + 1;
  std::unordered_set<std::size_t> taken;
  std::vector<Place> places;
  for (const Place& place : reached_) {
    const std::size_t square = index(place.point);
    const std::size_t block = (square / side_) / squares * blocks + (square % side_) / squares;
    if (taken.insert(block).second) places.push_back(place);
  }
  return places;
}

bool SafeSet::isReached(const TPoint2D& point) const {
  const std::size_t square = index(point);
  return square < squares_.size() && std::isfinite(squares_[square].distance);
}

bool SafeSet::isRoomy(const TPoint2D& point) const {
  return isReached(point) && squares_[index(point)].state == kRoomy;
}

bool SafeSet::isStraightSafe(const TPoint2D& a, const TPoint2D& b) const {
  const double length = (b - a).norm();
  const auto steps = static_cast<int>(std::ceil(2.0 * length / params_.square));
  for (int i = 1; i < steps; ++i) {
    if (!isRoomy(a + (b - a) * (static_cast<double>(i) / steps))) return false;
  }
  return true;
}

std::vector<TPoint2D> SafeSet::pathTo(const TPoint2D& place) const {
  if (!isReached(place)) return {};
  std::vector<TPoint2D> squares;
  for (auto square = static_cast<std::int32_t>(index(place)); square >= 0;
       square = squares_[static_cast<std::size_t>(square)].from) {
    squares.push_back(centre(static_cast<std::size_t>(square)));
  }
  std::reverse(squares.begin(), squares.end());
  squares.front() = {0, 0};
  std::vector<TPoint2D> path{squares.front()};
  for (std::size_t at = 0; at + 1 < squares.size();) {
    // The farthest square of the way that is reached in a straight line, by doubling steps.
    std::size_t next = at + 1;
    for (std::size_t step = 1; step > 0;) {
      const std::size_t further = next + step;
      if (further < squares.size() && isStraightSafe(squares[at], squares[further])) {
        next = further;
        step *= 2;
      } else {
        step /= 2;
      }
    }
    path.push_back(squares[next]);
    at = next;
  }
  return path;
}

}  // namespace mrpt_polyloc
