#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/travel/ExactTravel.h>
#include <mrpt_polyloc/visibility/VisibilitySkeleton.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// How far places stand off the corners of cells, as a share of the way to the middle.
constexpr double kInset = 1e-3;

bool cross(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c, const TPoint2D& d) {
  const auto side = [](const TPoint2D& o, const TPoint2D& p, const TPoint2D& q) {
    return mrpt_polyloc::cross(o, p, q);
  };
  return (side(a, b, c) > 0.0) != (side(a, b, d) > 0.0) &&
         (side(c, d, a) > 0.0) != (side(c, d, b) > 0.0);
}

}  // namespace

ExactTravel::ExactTravel(const VisibilityCells& cells, const SkeletonClasses& classes,
                         std::vector<TPoint2D> starts, std::size_t truth, double tolerance)
    : cells_(&cells),
      classes_(&classes),
      starts_(std::move(starts)),
      truth_(truth),
      tolerance_(tolerance),
      class_of_cell_(cells.size(), -1) {
  requireInRange("truth", static_cast<double>(truth), 0.0,
                 static_cast<double>(starts_.size()) - 1.0);
  for (std::size_t group = 0; group < classes.size(); ++group) {
    classes.forEachEmbedding(group, [&](const SkeletonClasses::Embedding& embedding) {
      if (embedding.cell == VisibilityCells::kNone) return;
      class_of_cell_[static_cast<std::size_t>(embedding.cell)] = static_cast<std::int64_t>(group);
    });
  }
  collectPlaces();
  connect();
}

/// Points of the truth's copy, relative to the start, inside of cells of any copy.
void ExactTravel::collectPlaces() {
  places_.emplace_back(0.0, 0.0);
  std::set<std::pair<std::int64_t, std::int64_t>> taken;  // millimetres
  const auto add = [&](const TPoint2D& place) {
    if (cells_->locate(starts_[truth_] + place) == VisibilityCells::kNone) return;
    if (taken.emplace(std::llround(1e3 * place.x), std::llround(1e3 * place.y)).second) {
      places_.push_back(place);
    }
  };
  for (const TPoint2D& start : starts_) {
    for (std::size_t cell = 0; cell < cells_->size(); ++cell) {
      const TPoint2D middle = cells_->representative(cell);
      add(middle - start);
      for (const TPoint2D& corner : cells_->polygon(cell)) {
        add(corner + (middle - corner) * kInset - start);
      }
    }
  }
}

/// Joins all places that see each other in the truth's copy.
void ExactTravel::connect() {
  std::vector<std::pair<TPoint2D, TPoint2D>> walls;
  const Triangulation& triangulation = cells_->triangulation();
  for (const Triangulation::Face& face : triangulation.faces()) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!face.is_free || face.passage[i] == Passage::clear) continue;
      const auto a = static_cast<std::size_t>(face.vertex[(i + 1) % 3]);
      const auto b = static_cast<std::size_t>(face.vertex[(i + 2) % 3]);
      walls.emplace_back(triangulation.vertices()[a] - starts_[truth_],
                         triangulation.vertices()[b] - starts_[truth_]);
    }
  }
  graph_.resize(places_.size());
  for (std::size_t a = 0; a < places_.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const bool is_seen = std::none_of(walls.begin(), walls.end(), [&](const auto& wall) {
        return cross(places_[a], places_[b], wall.first, wall.second);
      });
      if (!is_seen) continue;
      const double length = (places_[a] - places_[b]).norm();
      graph_[a].emplace_back(static_cast<std::uint32_t>(b), length);
      graph_[b].emplace_back(static_cast<std::uint32_t>(a), length);
    }
  }
}

bool ExactTravel::seesAlike(const TPoint2D& place, std::size_t a, std::size_t b) const {
  if (a == b) return true;
  const std::int32_t cell_a = cells_->locate(starts_[a] + place);
  const std::int32_t cell_b = cells_->locate(starts_[b] + place);
  if (cell_a == VisibilityCells::kNone || cell_b == VisibilityCells::kNone) {
    return cell_a == cell_b;
  }
  if (class_of_cell_[static_cast<std::size_t>(cell_a)] !=
      class_of_cell_[static_cast<std::size_t>(cell_b)]) {
    return false;
  }
  // Of one shape; also in one place? Symmetric skeletons lie alike in several ways.
  const TPoint2D expected = starts_[b] - starts_[a];
  ViewExpander expander(cells_->triangulation(), true);
  const double flat = tolerance_;
  const VisibilitySkeleton seen_a =
      skeletonOf(*cells_, static_cast<std::size_t>(cell_a), expander, flat);
  const VisibilitySkeleton seen_b =
      skeletonOf(*cells_, static_cast<std::size_t>(cell_b), expander, flat);
  for (const mrpt::math::TPose2D& motion : alignments(seen_a, seen_b, tolerance_)) {
    if (std::abs(std::remainder(motion.phi, kTwoPi)) > 1e-6) continue;
    if (std::hypot(motion.x - expected.x, motion.y - expected.y) < 1e-4) return true;
  }
  return false;
}

ExactTravel::Run ExactTravel::nearest(bool back) const {
  Run run;
  run.left.resize(starts_.size());
  std::iota(run.left.begin(), run.left.end(), std::size_t{0});
  std::size_t at = 0;
  std::vector<std::size_t> order(places_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  while (run.left.size() > 1) {
    const std::vector<double> distances = distancesFrom(graph_, at);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::make_pair(distances[a], a) < std::make_pair(distances[b], b);
    });
    std::vector<std::size_t> kept;
    std::size_t place = places_.size();
    for (const std::size_t candidate : order) {
      if (!std::isfinite(distances[candidate])) break;
      const std::size_t first = run.left.front();
      const bool splits =
          std::any_of(run.left.begin(), run.left.end(), [&](std::size_t hypothesis) {
            return !seesAlike(places_[candidate], first, hypothesis);
          });
      if (!splits) continue;
      place = candidate;
      break;
    }
    if (place == places_.size()) break;
    // The way back is part of the next step, if there is one.
    run.travel += distances[place];
    ++run.looks;
    for (const std::size_t hypothesis : run.left) {
      if (seesAlike(places_[place], truth_, hypothesis)) kept.push_back(hypothesis);
    }
    run.left = std::move(kept);
    if (back && run.left.size() > 1) {
      run.travel += distances[place];
    } else {
      at = place;
    }
  }
  return run;
}

std::vector<std::uint32_t> ExactTravel::toldFromTruth() const {
  std::vector<std::uint32_t> told(places_.size(), 0);
  for (std::size_t place = 0; place < places_.size(); ++place) {
    std::uint32_t bit = 1;
    for (std::size_t rival = 0; rival < starts_.size(); ++rival) {
      if (rival == truth_) continue;
      if (!seesAlike(places_[place], truth_, rival)) told[place] |= bit;
      bit <<= 1U;
    }
  }
  return told;
}

std::optional<double> ExactTravel::shortestTour() const {
  const std::vector<std::uint32_t> told = toldFromTruth();
  const std::vector<double> distances = distancesFrom(graph_, 0);
  std::uint32_t possible = 0;
  for (std::size_t place = 0; place < places_.size(); ++place) {
    if (std::isfinite(distances[place])) possible |= told[place];
  }
  // Rivals that nothing tells from the truth are left out: bits moved together.
  std::vector<std::uint32_t> bits(told.size(), 0);
  std::size_t rivals = 0;
  for (std::uint32_t bit = 1; bit != 0 && bit <= possible; bit <<= 1U) {
    if ((possible & bit) == 0) continue;
    for (std::size_t place = 0; place < told.size(); ++place) {
      if ((told[place] & bit) != 0) bits[place] |= std::uint32_t{1} << rivals;
    }
    ++rivals;
  }
  return shortestVerificationTour(graph_, 0, bits, rivals);
}

}  // namespace mrpt_polyloc
