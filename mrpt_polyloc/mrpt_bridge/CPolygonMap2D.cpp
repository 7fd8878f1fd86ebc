#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/io/geojson.h>
#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>
#include <mrpt_polyloc/mrpt_bridge/IniSection.h>
#include <mrpt_polyloc/mrpt_bridge/PolygonLikelihood.h>
#include <mrpt_polyloc/mrpt_bridge/PolygonMapContent.h>
#include <mrpt_polyloc/mrpt_bridge/map_lines.h>
#include <mrpt_polyloc/mrpt_bridge/wall_matching.h>

#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <utility>

MAP_DEFINITION_REGISTER("mrpt_polyloc::CPolygonMap2D,polygonMap2D", mrpt_polyloc::CPolygonMap2D)

namespace mrpt_polyloc {

using mrpt::obs::CObservation2DRangeScan;

IMPLEMENTS_SERIALIZABLE(CPolygonMap2D, mrpt::maps::CMetricMap, mrpt_polyloc)

namespace {

const mrpt::maps::CMetricMap& notNull(const mrpt::maps::CMetricMap* other) {
  if (other == nullptr) throw std::invalid_argument("CPolygonMap2D: the map to match with is null");
  return *other;
}

}  // namespace

void CPolygonMap2D::setMap(PolygonMap map) {
  setMap(MapIndex::deferred(std::move(map)));
}

void CPolygonMap2D::setMap(MapIndex::Ptr index) {
  if (!index) throw InvalidParamsError("CPolygonMap2D: the index is null");
  auto content = std::make_shared<const PolygonMapContent>(std::move(index));
  content->predictor();
  content_ = std::move(content);
}

MapIndex::Ptr CPolygonMap2D::index() const {
  return content_ ? content_->index() : nullptr;
}

const PolygonMap* CPolygonMap2D::map() const {
  return content_ ? &content_->map() : nullptr;
}

std::string CPolygonMap2D::asString() const {
  if (!content_) return "CPolygonMap2D, empty";
  return "CPolygonMap2D, " + std::to_string(content_->map().vertexCount()) + " vertices";
}

bool CPolygonMap2D::internal_insertObservation(const mrpt::obs::CObservation&,
                                               const std::optional<const mrpt::poses::CPose3D>&) {
  return false;
}

double CPolygonMap2D::internal_computeObservationLikelihood(
    const mrpt::obs::CObservation& observation, const mrpt::poses::CPose3D& taken_from) const {
  const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation);
  if (!scan || !content_) return 0.0;
  return scanLogLikelihood(content_->predictor(), *scan,
                           {taken_from.x(), taken_from.y(), taken_from.yaw()}, likelihoodOptions);
}

std::vector<double> CPolygonMap2D::computeLikelihoods(
    const CObservation2DRangeScan& scan,
    const std::vector<mrpt::math::TPose2D>& poses_map_robot) const {
  if (!content_) return std::vector<double>(poses_map_robot.size(), 0.0);
  return scanLogLikelihoods(content_->predictor(), scan, poses_map_robot, likelihoodOptions);
}

bool CPolygonMap2D::internal_canComputeObservationLikelihood(
    const mrpt::obs::CObservation& observation) const {
  return content_ && dynamic_cast<const CObservation2DRangeScan*>(&observation) != nullptr;
}

void CPolygonMap2D::getVisualizationInto(drawn::CSetOfObjects& out) const {
  if (!content_ || !genericMapParams.enableSaveAs3DObject) return;
  addMapLines(content_->map(), out);
}

void CPolygonMap2D::saveMetricMapRepresentationToFile(const std::string& prefix) const {
  if (!content_) return;
  std::ofstream file(prefix + ".geojson", std::ios::binary);
  file << toGeoJson(content_->map()) << std::flush;
  if (!file) throw std::runtime_error(prefix + ".geojson: cannot be written");
}

mrpt::math::TBoundingBoxf CPolygonMap2D::boundingBox() const {
  if (!content_) return {};
  const BoundingBox& box = content_->map().boundingBox();
  return {{static_cast<float>(box.min.x), static_cast<float>(box.min.y), 0.0F},
          {static_cast<float>(box.max.x), static_cast<float>(box.max.y), 0.0F}};
}

float CPolygonMap2D::squareDistanceToClosestCorrespondence(float x, float y) const {
  const auto nearest =
      content_ ? content_->walls().nearest({static_cast<double>(x), static_cast<double>(y)})
               : std::nullopt;
  return nearest ? static_cast<float>(nearest->squared_distance)
                 : std::numeric_limits<float>::infinity();
}

void CPolygonMap2D::determineMatching2D(const mrpt::maps::CMetricMap* other,
                                        const mrpt::poses::CPose2D& other_pose,
                                        mrpt::tfest::TMatchingPairList& pairs,
                                        const mrpt::maps::TMatchingParams& params,
                                        mrpt::maps::TMatchingExtraResults& results) const {
  determineMatching3D(other, mrpt::poses::CPose3D(other_pose), pairs, params, results);
}

void CPolygonMap2D::determineMatching3D(const mrpt::maps::CMetricMap* other,
                                        const mrpt::poses::CPose3D& other_pose,
                                        mrpt::tfest::TMatchingPairList& pairs,
                                        const mrpt::maps::TMatchingParams& params,
                                        mrpt::maps::TMatchingExtraResults& results) const {
  pairs.clear();
  results = {};
  const mrpt::maps::CMetricMap& points = notNull(other);
  if (content_) matchWalls(content_->walls(), points, other_pose, params, pairs, results);
}

float CPolygonMap2D::compute3DMatchingRatio(const mrpt::maps::CMetricMap* other,
                                            const mrpt::poses::CPose3D& other_pose,
                                            const mrpt::maps::TMatchingRatioParams& params) const {
  const mrpt::maps::CMetricMap& points = notNull(other);
  if (!content_) return 0.0F;
  return wallMatchingRatio(content_->walls(), points, other_pose,
                           static_cast<double>(params.maxDistForCorr));
}

// Version 0: the map as GeoJSON, which keeps every bit (empty: none), then the options.
uint8_t CPolygonMap2D::serializeGetVersion() const {
  return 0;
}

void CPolygonMap2D::serializeTo(mrpt::serialization::CArchive& out) const {
  const TLikelihoodOptions& o = likelihoodOptions;
  out << (content_ ? PolygonMapContent::textOf(content_) : std::string()) << o.metric << o.sigma
      << static_cast<uint32_t>(o.decimation) << o.independent_beams << o.cost.tau_short
      << o.cost.tau_long << o.cost.tau_open << o.cost.tau_none << o.cost.none_share;
  out << genericMapParams;
}

void CPolygonMap2D::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version) {
  if (version != 0) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  std::string text;
  uint32_t decimation = 1;
  TLikelihoodOptions o;
  mrpt::maps::TMapGenericParams generic;
  in >> text >> o.metric >> o.sigma >> decimation >> o.independent_beams >> o.cost.tau_short >>
      o.cost.tau_long >> o.cost.tau_open >> o.cost.tau_none >> o.cost.none_share;
  in >> generic;
  o.decimation = decimation;
  o.check();
  content_ = text.empty() ? nullptr : PolygonMapContent::fromText(text);
  likelihoodOptions = o;
  genericMapParams = generic;
}

CPolygonMap2D::TMapDefinition::TMapDefinition() = default;

void CPolygonMap2D::TMapDefinition::loadFromConfigFile_map_specific(
    const mrpt::config::CConfigFileBase& source, const std::string& prefix) {
  const std::string section = prefix + "_creationOpts";
  const IniSection ini(source, section,
                       {"file", "scale", "max_wall_gap", "tolerance_cells", "min_component_area",
                        "max_filled_unknown_area", "enableSaveAs3DObject",
                        "enableObservationLikelihood", "enableObservationInsertion"});
  file = ini.text("file", file);
  if (file.empty()) throw InvalidParamsError("no 'file' is given in section '" + section + "'");
  const auto read = [&](const char* name, double& value) { value = ini.number(name, value); };
  read("scale", scale);
  read("max_wall_gap", grid.cleaning.max_wall_gap);
  read("tolerance_cells", grid.tracing.tolerance_cells);
  read("min_component_area", grid.tracing.min_component_area);
  read("max_filled_unknown_area", grid.tracing.max_filled_unknown_area);
  namingSection(section, [this] {
    requirePositive("scale", scale);
    grid.cleaning.check();
    grid.tracing.check();
  });
  likelihood.loadFromConfigFile(source, prefix + "_likelihoodOpts");
}

void CPolygonMap2D::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const {
  out << "file = " << file << "\nscale = " << formatted("%g", scale) << "\n";
  likelihood.dumpToTextStream(out);
}

CreatedMap CPolygonMap2D::internal_CreateFromMapDefinition(
    const mrpt::maps::TMetricMapInitializer& definition) {
  const auto& def = dynamic_cast<const TMapDefinition&>(definition);
  auto map = std::make_unique<CPolygonMap2D>(loadMap(def.file, def.grid, nullptr, def.scale).map);
  map->likelihoodOptions = def.likelihood;
  map->genericMapParams = def.genericMapParams;
  return toCreatedMap(std::move(map));
}

}  // namespace mrpt_polyloc
