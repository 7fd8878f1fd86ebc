#include <mrpt_polyloc/mrpt_bridge/wall_matching.h>

#include <mrpt/maps/CPointsMap.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPoint3D;

const mrpt::maps::CPointsMap& pointsOf(const mrpt::maps::CMetricMap& map) {
  const auto* points = dynamic_cast<const mrpt::maps::CPointsMap*>(&map);
  if (points == nullptr) {
    throw std::invalid_argument(
        std::string("CPolygonMap2D is matched with points maps only, not ") +
        map.GetRuntimeClass()->className);
  }
  return *points;
}

/// Calls visit(index, local point, point in this map) for every `step`-th point from `first` on;
/// returns how many there were.
template <class Visitor>
std::size_t forEachPoint(const mrpt::maps::CPointsMap& points, const mrpt::poses::CPose3D& pose,
                         std::size_t first, std::size_t step, const Visitor& visit) {
  std::size_t count = 0;
  for (std::size_t i = first; i < points.size(); i += std::max<std::size_t>(step, 1), ++count) {
    TPoint3D local;
    points.getPoint(i, local);
    visit(i, local, pose.composePoint(local));
  }
  return count;
}

}  // namespace

void matchWalls(const NearestWalls& walls, const mrpt::maps::CMetricMap& other,
                const mrpt::poses::CPose3D& other_pose, const mrpt::maps::TMatchingParams& params,
                mrpt::tfest::TMatchingPairList& pairs, mrpt::maps::TMatchingExtraResults& results) {
  pairs.clear();
  results = {};
  double squares = 0.0;
  const auto match = [&](std::size_t index, const TPoint3D& local, const TPoint3D& global) {
    const auto found = walls.nearest({global.x, global.y});
    if (!found) return;
    const double reach = static_cast<double>(params.maxDistForCorrespondence) +
                         static_cast<double>(params.maxAngularDistForCorrespondence) *
                             params.angularDistPivotPoint.distanceTo(global);
    if (found->squared_distance > reach * reach) return;
    const TPoint3D on_wall(found->point.x, found->point.y, global.z);
    mrpt::tfest::TMatchingPair pair(found->wall, static_cast<std::uint32_t>(index),
                                    mrpt::math::TPoint3Df(on_wall), mrpt::math::TPoint3Df(local));
    pair.errorSquareAfterTransformation = static_cast<float>(found->squared_distance);
    pairs.push_back(pair);
    squares += found->squared_distance;
  };
  const std::size_t considered =
      forEachPoint(pointsOf(other), other_pose, params.offset_other_map_points,
                   params.decimation_other_map_points, match);
  if (considered > 0) {
    results.correspondencesRatio =
        static_cast<float>(pairs.size()) / static_cast<float>(considered);
  }
  results.sumSqrDist = static_cast<float>(squares);
}

float wallMatchingRatio(const NearestWalls& walls, const mrpt::maps::CMetricMap& other,
                        const mrpt::poses::CPose3D& other_pose, double distance) {
  std::size_t near = 0;
  const std::size_t points = forEachPoint(
      pointsOf(other), other_pose, 0, 1, [&](std::size_t, const TPoint3D&, const TPoint3D& global) {
        const auto found = walls.nearest({global.x, global.y});
        near += found && found->squared_distance <= distance * distance;
      });
  return points == 0 ? 0.0F : static_cast<float>(near) / static_cast<float>(points);
}

}  // namespace mrpt_polyloc
