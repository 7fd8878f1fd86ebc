#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/io/map_files.h>
#include <mrpt_polyloc/io/mrpt_compat.h>
#include <mrpt_polyloc/localization/MapIndex.h>
#include <mrpt_polyloc/mrpt_bridge/TLikelihoodOptions.h>

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/math/TBoundingBox.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc {

class PolygonMapContent;

/// A polygon map as a metric map of MRPT (alias `polygonMap2D` in ini files): the likelihood of
/// laser scans for any of its filters.
///
/// The map is given, not built: observations are not inserted, and clear() keeps it, for
/// loadFromSimpleMap() clears all maps first. Const calls are thread-safe. Copies share the map
/// and its index, also those that MRPT makes by storing and loading within a process; one that is
/// loaded otherwise is indexed when it first weighs a scan.
class POLYLOC_EXPORT CPolygonMap2D : public mrpt::maps::CMetricMap {
  DEFINE_SERIALIZABLE(CPolygonMap2D, mrpt_polyloc)

 public:
  CPolygonMap2D() = default;
  explicit CPolygonMap2D(PolygonMap map) { setMap(std::move(map)); }
  explicit CPolygonMap2D(MapIndex::Ptr index) { setMap(std::move(index)); }

  /// Builds the index of what is seen from where: up to a second for the largest maps.
  void setMap(PolygonMap map);
  /// With an index that others use as well: a localizer, a particle seeder. Prepares of it what
  /// weighing scans needs, if it is a deferred one. \throws InvalidParamsError if it is null
  void setMap(MapIndex::Ptr index);
  /// For others to share; null if the map is empty.
  MapIndex::Ptr index() const;
  /// Null if empty.
  const PolygonMap* map() const;

  TLikelihoodOptions likelihoodOptions;

  /// computeObservationLikelihood() for many poses of the robot at once, which is faster; 0 for
  /// each if the map is empty.
  std::vector<double> computeLikelihoods(
      const mrpt::obs::CObservation2DRangeScan& scan,
      const std::vector<mrpt::math::TPose2D>& poses_map_robot) const;

  bool isEmpty() const override { return content_ == nullptr; }
  std::string asString() const override;
  /// Walls dark, open edges orange, walls beyond grey.
  void getVisualizationInto(drawn::CSetOfObjects& out) const override;
  /// Writes PREFIX.geojson, which loadMap() reads; nothing for an empty map.
  /// \throws std::runtime_error if it cannot be written
  void saveMetricMapRepresentationToFile(const std::string& prefix) const override;
  /// Of free space and walls beyond [m], flat at z = 0; all 0 for an empty map.
  mrpt::math::TBoundingBoxf boundingBox() const POLYLOC_OVERRIDE_FROM_2_11_3;
  /// To the nearest wall or wall beyond [m2]; infinity if there is none. About O(log n).
  float squareDistanceToClosestCorrespondence(float x, float y) const override;
  /// ICP's pairs with the points of another map, which must be a points map: see matchWalls().
  /// \throws std::invalid_argument if it is null or no points map
  void determineMatching2D(const mrpt::maps::CMetricMap* other,
                           const mrpt::poses::CPose2D& other_pose,
                           mrpt::tfest::TMatchingPairList& pairs,
                           const mrpt::maps::TMatchingParams& params,
                           mrpt::maps::TMatchingExtraResults& results) const override;
  void determineMatching3D(const mrpt::maps::CMetricMap* other,
                           const mrpt::poses::CPose3D& other_pose,
                           mrpt::tfest::TMatchingPairList& pairs,
                           const mrpt::maps::TMatchingParams& params,
                           mrpt::maps::TMatchingExtraResults& results) const override;
  /// The share of another points map's points within `maxDistForCorr` of a wall.
  float compute3DMatchingRatio(const mrpt::maps::CMetricMap* other,
                               const mrpt::poses::CPose3D& other_pose,
                               const mrpt::maps::TMatchingRatioParams& params) const override;

 private:
  void internal_clear() override {}
  bool internal_insertObservation(
      const mrpt::obs::CObservation& observation,
      const std::optional<const mrpt::poses::CPose3D>& robot_pose) override;
  double internal_computeObservationLikelihood(
      const mrpt::obs::CObservation& observation,
      const mrpt::poses::CPose3D& taken_from) const override;
  bool internal_canComputeObservationLikelihood(
      const mrpt::obs::CObservation& observation) const override;

  std::shared_ptr<const PolygonMapContent> content_;

  MAP_DEFINITION_START(CPolygonMap2D)
  std::string file;    ///< any map that loadMap() reads
  double scale = 1.0;  ///< metres per unit of the file
  GridMapParams grid;  ///< how a grid becomes polygons
  mrpt_polyloc::TLikelihoodOptions likelihood;
  MAP_DEFINITION_END(CPolygonMap2D)
};

}  // namespace mrpt_polyloc
