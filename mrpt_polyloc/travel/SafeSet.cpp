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

enum State : std::int8_t { kUnknown, kSafe, kUnsafe };

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
  squares_.assign(side_ * side_, {std::numeric_limits<float>::infinity(), -1, kUnknown});
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
  const auto span = static_cast<int>(radius / params_.square) + 1;
  for (const TPoint2D& hit : sight.hits()) {
    for (int row = -span; row <= span; ++row) {
      for (int column = -span; column <= span; ++column) {
        const std::size_t square =
            index({hit.x + column * params_.square, hit.y + row * params_.square});
        if (square == squares_.size()) continue;
        const TPoint2D at = centre(square);
        const double needed = at.norm() < kNearby ? nearby : radius;
        if ((at - hit).norm() < needed) squares_[square].state = kUnsafe;
      }
    }
  }
}

bool SafeSet::mayBe(const TPoint2D& point) const {
  const std::vector<double>& needed = point.norm() < kNearby ? needed_nearby_ : needed_;
  double for_it = 0.0, all = 0.0;
  bool is_unanimous = true;
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const Hypothesis& hypothesis = (*hypotheses_)[i];
    all += hypothesis.weight;
    if (clearanceAt(*field_, hypothesis.pose_map_robot, point) >= needed[i]) {
      for_it += hypothesis.weight;
    } else {
      is_unanimous = false;
      if (params_.quorum >= 1.0) break;
    }
  }
  if (is_unanimous && !needed.empty()) return true;
  if (params_.quorum < 1.0 && for_it >= params_.quorum * all) return true;
  // Whatever the maps say, what was seen free is.
  return sight_->seesDisc(point, params_.robot_radius + params_.margin);
}

bool SafeSet::isSafe(std::size_t square) {
  std::int8_t& state = squares_[square].state;
  if (state == kUnknown) state = mayBe(centre(square)) ? kSafe : kUnsafe;
  return state == kSafe;
}

/// Dijkstra's algorithm over neighbouring squares from where the robot stands.
void SafeSet::spread() {
  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const std::size_t start = index({0, 0});
  squares_[start].state = kSafe;
  squares_[start].distance = 0.0F;
  queue.emplace(0.0F, start);
  const auto straight = static_cast<float>(params_.square);
  const auto diagonal = static_cast<float>(params_.square * std::sqrt(2.0));
  while (!queue.empty()) {
    const auto [distance, square] = queue.top();
    queue.pop();
    if (distance > squares_[square].distance) continue;
    reached_.push_back({centre(square), static_cast<double>(distance)});
    const std::size_t column = square % side_, row = square / side_;
    if (column == 0 || row == 0 || column + 1 == side_ || row + 1 == side_) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        const std::size_t next = (row + static_cast<std::size_t>(dy + 1) - 1) * side_ + column +
                                 static_cast<std::size_t>(dx + 1) - 1;
        const float there = distance + (dx == 0 || dy == 0 ? straight : diagonal);
        if (there >= squares_[next].distance || static_cast<double>(there) > params_.reach ||
            !isSafe(next)) {
          continue;
        }
        squares_[next].distance = there;
        squares_[next].from = static_cast<std::int32_t>(square);
        queue.emplace(there, next);
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

bool SafeSet::isStraightSafe(const TPoint2D& a, const TPoint2D& b) const {
  const double length = (b - a).norm();
  const auto steps = static_cast<int>(std::ceil(2.0 * length / params_.square));
  for (int i = 1; i < steps; ++i) {
    if (!isReached(a + (b - a) * (static_cast<double>(i) / steps))) return false;
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
