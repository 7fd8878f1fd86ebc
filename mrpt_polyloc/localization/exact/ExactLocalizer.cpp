#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/localization/exact/ExactCandidates.h>
#include <mrpt_polyloc/localization/exact/ExactLocalizer.h>
#include <mrpt_polyloc/localization/exact/ObservedPolygon.h>

#include <cmath>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

double angleOf(const TPoint2D& from, const TPoint2D& to) {
  return std::atan2(to.y - from.y, to.x - from.x);
}

}  // namespace

void ExactLocalizerParams::check() const {
  requireInRange("tolerance", tolerance, 1e-8, 1e-2);
}

ExactLocalizer::ExactLocalizer(const PolygonMap& map, ExactLocalizerParams params)
    : params_(params), triangulation_(map) {
  params_.check();
  const auto& vertices = triangulation_.vertices();
  for (const Triangulation::Face& face : triangulation_.faces()) {
    for (std::size_t i = 0; face.is_free && i < 3; ++i) {
      if (face.passage[i] == Passage::clear) continue;
      borders_.push_back({vertices[static_cast<std::size_t>(face.vertex[(i + 1) % 3])],
                          vertices[static_cast<std::size_t>(face.vertex[(i + 2) % 3])]});
    }
  }
}

std::size_t ExactLocalizer::bytes() const {
  return borders_.size() * sizeof(Border) +
         triangulation_.faces().size() * sizeof(Triangulation::Face) +
         triangulation_.vertices().size() * sizeof(TPoint2D);
}

ExactAnswers ExactLocalizer::localize(const std::vector<TPoint2D>& view,
                                      const PosePrior& prior) const {
  prior.check();
  const ObservedPolygon seen(view, params_.tolerance);
  ExactCandidates candidates(triangulation_, seen, prior, params_.tolerance);
  const WallAnchor& anchor = candidates.anchor();
  const TPoint2D& anchor_point = anchor.at_begin ? anchor.from : anchor.to;
  for (const Border& border : borders_) {
    TPose2D pose(0, 0, angleOf(border.from, border.to) - angleOf(anchor.from, anchor.to));
    pose.phi = std::remainder(pose.phi, kTwoPi);
    const TPoint2D point =
        (anchor.at_begin ? border.from : border.to) - turned(anchor_point, pose.phi);
    pose.x = point.x;
    pose.y = point.y;
    candidates.consider(pose);
  }
  return candidates.answers();
}

}  // namespace mrpt_polyloc
