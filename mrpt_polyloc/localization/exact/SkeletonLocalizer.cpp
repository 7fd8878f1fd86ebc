#include <mrpt_polyloc/localization/exact/ExactCandidates.h>
#include <mrpt_polyloc/localization/exact/ObservedPolygon.h>
#include <mrpt_polyloc/localization/exact/SkeletonLocalizer.h>

#include <cmath>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// How far outside of a cell a pose may lie that is tried all the same, in tolerances: a clear
/// polygon hides what is within some hundredths of one, seen from this much farther away.
constexpr double kClosedCell = 1000.0;

/// A cell takes as long to prepare as a single shot takes for so many vertices of the map: 17 us,
/// and 2.7 us a vertex (tests/bench/exact_bench.cpp, n = 196).
constexpr double kVerticesPerCell = 6.0;

const ExactLocalizerParams& checked(const ExactLocalizerParams& params) {
  params.check();
  return params;
}

}  // namespace

SkeletonLocalizer::SkeletonLocalizer(const PolygonMap& map, ExactLocalizerParams params,
                                     std::size_t max_cells)
    : params_(checked(params)),
      cells_(map, {max_cells, kUnlimitedRange}),
      classes_(cells_, params_.tolerance),
      single_shot_(map, params_) {}

bool SkeletonLocalizer::pays(const PolygonMap& map, std::size_t queries, std::size_t max_cells) {
  const auto n = static_cast<double>(map.vertexCount());
  const double most_cells = static_cast<double>(queries) * n / kVerticesPerCell;
  // Counting takes time with the square of what is counted; rooms make tens of cells for each
  // reflex vertex.
  if (most_cells < static_cast<double>(map.reflexVertexCount()) ||
      map.reflexVertexCount() > max_cells / 10) {
    return false;
  }
  const std::size_t cells = VisibilityCells::estimate(map).cells();
  return cells <= max_cells && static_cast<double>(cells) <= most_cells;
}

std::size_t SkeletonLocalizer::bytes() const {
  return cells_.memory() + classes_.memory() + single_shot_.bytes();
}

ExactAnswers SkeletonLocalizer::localize(const std::vector<TPoint2D>& view,
                                         const PosePrior& prior) const {
  prior.check();
  const ObservedPolygon seen(view, params_.tolerance);
  if (!seen.isClear()) return single_shot_.localize(view, prior);
  ViewExpander expander(cells_.triangulation(), true);
  ExactCandidates candidates(cells_.triangulation(), seen, prior, params_.tolerance);
  std::size_t positions = 0;
  for (const SkeletonClasses::Match& match : classes_.find(seen.skeleton(), expander)) {
    classes_.forEachEmbedding(match.index, [&](const SkeletonClasses::Embedding& embedding) {
      ++positions;
      const TPose2D pose = embedding.pose_map_skeleton + match.pose_skeleton_robot;
      const bool is_there =
          embedding.cell == VisibilityCells::kNone ||
          cells_.distanceOutside(static_cast<std::size_t>(embedding.cell), {pose.x, pose.y}) <=
              kClosedCell * params_.tolerance;
      if (is_there) candidates.consider(pose);
    });
  }
  if (candidates.kept() == 0) return single_shot_.localize(view, prior);
  ExactAnswers answers = candidates.answers();
  answers.positions = positions;
  return answers;
}

}  // namespace mrpt_polyloc
