#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/geometry/angles.h>
#include <mrpt_polyloc/geometry/errors.h>
#include <mrpt_polyloc/geometry/params_check.h>
#include <mrpt_polyloc/localization/BandQuery.h>
#include <mrpt_polyloc/localization/CellTree.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/ScanCost.h>
#include <mrpt_polyloc/localization/SignaturePyramid.h>
#include <mrpt_polyloc/localization/assessment.h>
#include <mrpt_polyloc/localization/search_index_file.h>
#include <mrpt_polyloc/localization/search_positions.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Whether the prior allows a pose, or one that counts as the same hypothesis: refinement may lead
/// away from where the search was allowed to look.
bool isAllowed(const PosePrior& prior, const mrpt::math::TPose2D& pose_map_robot,
               const HypothesisParams& params) {
  if (prior.compass) {
    const double off = angleBetween(pose_map_robot.phi, prior.compass->heading);
    if (off > prior.compass->tolerance + params.merge_angle) return false;
  }
  if (prior.near) {
    const double away =
        std::hypot(pose_map_robot.x - prior.near->x, pose_map_robot.y - prior.near->y);
    if (away > prior.near->radius + params.merge_distance) return false;
  }
  return true;
}

}  // namespace

void GlobalLocalizerParams::check() const {
  requireInRange("max_hypotheses", static_cast<double>(max_hypotheses), 1.0, 1e6);
  requireInRange("threads", threads, 0.0, 1024.0);
  requireInRange("spacing", spacing, 0.01, 10.0);
  requireInRange("cell_size", cell_size, 0.01, 10.0);
  cost.check();
  search_cost.check();
  certified.check();
  signature.check();
  search.check();
  refinement.check();
  hypotheses.check();
}

struct GlobalLocalizer::Impl {
  Impl(PolygonMap polygon_map, const GlobalLocalizerParams& parameters)
      : params(parameters),
        map(std::move(polygon_map)),
        triangulation(map),
        predictor(triangulation,
                  params.method == SearchMethod::certified ? 2.0 * params.cell_size
                                                           : RangePredictor::kCellSize,
                  params.threads) {
    if (params.method == SearchMethod::certified) {
      cells.emplace(triangulation, predictor, CellTreeParams{params.cell_size, params.threads});
    } else {
      pyramid.emplace(predictor, searchPositions(triangulation, params.spacing),
                      triangulation.box().min, params.spacing, params.threads);
    }
    build_seconds = watch.seconds();
  }

  Impl(PolygonMap polygon_map, SearchIndex index, const GlobalLocalizerParams& parameters)
      : params(parameters),
        map(std::move(polygon_map)),
        triangulation(map),
        predictor(triangulation, std::move(index.edges)),
        cells(std::in_place, std::move(index.cells)),
        build_seconds(watch.seconds()) {}

  /// The poses to be refined, and what is known of the others.
  std::vector<TPose2D> search(const RangeScan& scan, const PosePrior& prior,
                              LocalizationResult& result) const;
  std::vector<TPose2D> searchCertified(const RangeScan& scan, const PosePrior& prior,
                                       LocalizationResult& result) const;

  /// Candidates refined with some of the beams, the best of them with all, of these what the prior
  /// allows; sorted by cost.
  std::vector<RankedPose> refine(const std::vector<TPose2D>& candidates, const RangeScan& scan,
                                 const PosePrior& prior, const ScanCost& cost) const;

  Stopwatch watch;
  GlobalLocalizerParams params;
  PolygonMap map;
  Triangulation triangulation;
  RangePredictor predictor;
  std::optional<CellTree> cells;            ///< certified
  std::optional<SignaturePyramid> pyramid;  ///< exhaustive
  double build_seconds = 0.0;
};

std::vector<TPose2D> GlobalLocalizer::Impl::search(const RangeScan& scan, const PosePrior& prior,
                                                   LocalizationResult& result) const {
  if (cells) return searchCertified(scan, prior, result);
  const SignatureQuery query(scan, params.signature, params.cost.none_share);
  const PyramidSearchResult found =
      searchPyramid(*pyramid, query, prior, scan.sensor(), params.search);
  result.statistics.positions = pyramid->blocks(0).size();
  result.statistics.evaluated = found.evaluated;
  std::vector<TPose2D> poses;
  for (const PyramidCandidate& candidate : found.candidates) {
    poses.push_back(candidate.pose_map_beams);
  }
  return poses;
}

std::vector<TPose2D> GlobalLocalizer::Impl::searchCertified(const RangeScan& scan,
                                                            const PosePrior& prior,
                                                            LocalizationResult& result) const {
  const BandQuery query(scan, params.search_cost);
  const RangeScan searched(query.beams, scan.sensor());
  const ScanCost cost(predictor, searched, params.search_cost);
  const PoseRefiner refiner(predictor, searched, params.refinement);
  const CertifiedSearchResult found = searchCells(
      *cells, query, prior, scan.sensor(),
      [&](const TPose2D& pose) {
        return std::min(cost.mean(pose), cost.mean(refiner.refine(pose).pose_map_beams));
      },
      params.certified);
  result.statistics.positions = cells->nodes(0).size();
  result.statistics.evaluated = found.evaluated;
  result.certificate = Certificate{found.certified_cost, found.is_complete, found.regions.size()};
  if (params.keep_regions) {
    for (const RemainingCell& remaining : found.regions) {
      const TPoint2D* polygon = cells->polygon(remaining.cell);
      result.regions.push_back({{polygon, polygon + cells->polygonSize(remaining.cell)},
                                query.heading(remaining.heading),
                                query.heading(remaining.heading + 1.0),
                                static_cast<double>(remaining.bound)});
    }
  }
  std::vector<TPose2D> poses;
  for (const PoseCandidate& candidate : found.candidates) poses.push_back(candidate.pose_map_beams);
  return poses;
}

std::vector<RankedPose> GlobalLocalizer::Impl::refine(const std::vector<TPose2D>& candidates,
                                                      const RangeScan& scan, const PosePrior& prior,
                                                      const ScanCost& cost) const {
  // Enough beams to come near the optimum; all of them only where it may matter.
  constexpr std::size_t kCoarseBeams = 90;
  const PoseRefiner coarse(predictor, scan, params.refinement, kCoarseBeams);
  const PoseRefiner fine(predictor, scan, params.refinement);
  std::vector<RankedPose> poses;
  poses.reserve(candidates.size());
  for (const TPose2D& candidate : candidates) {
    const RefinedPose refined = coarse.refine(candidate);
    const auto pose_map_robot = scan.robotFromBeamFrame(refined.pose_map_beams);
    if (!isAllowed(prior, pose_map_robot, params.hypotheses)) continue;
    poses.push_back({refined, cost.mean(refined.pose_map_beams)});
  }
  poses = mergeNearPoses(std::move(poses), params.hypotheses);
  // Rivals count even where they are not asked for: one hypothesis may be all that is returned.
  constexpr std::size_t kLeastRivals = 20;
  const std::size_t kept = std::max(params.max_hypotheses, kLeastRivals);
  if (poses.size() > 2 * kept) poses.resize(2 * kept);
  for (RankedPose& pose : poses) {
    const RefinedPose refined = fine.refine(pose.refined.pose_map_beams);
    const double refined_cost = cost.mean(refined.pose_map_beams);
    if (refined_cost < pose.cost) pose = {refined, refined_cost};
  }
  poses = mergeNearPoses(std::move(poses), params.hypotheses);
  if (poses.size() > kept) poses.resize(kept);
  return poses;
}

GlobalLocalizer::GlobalLocalizer(PolygonMap map, GlobalLocalizerParams params) {
  params.check();
  impl_ = std::make_unique<Impl>(std::move(map), params);
}
GlobalLocalizer::GlobalLocalizer(PolygonMap map, const std::string& index, const std::string& file,
                                 GlobalLocalizerParams params) {
  params.method = SearchMethod::certified;
  params.check();
  SearchIndex parsed = parseIndex(index, file, map.hash());
  try {
    impl_ = std::make_unique<Impl>(std::move(map), std::move(parsed), params);
  } catch (const InvalidMapError& error) {
    throw FormatError(file, "", error.what());
  }
}
GlobalLocalizer::~GlobalLocalizer() = default;
GlobalLocalizer::GlobalLocalizer(GlobalLocalizer&&) noexcept = default;

const PolygonMap& GlobalLocalizer::map() const {
  return impl_->map;
}
std::size_t GlobalLocalizer::indexBytes() const {
  return (impl_->cells ? impl_->cells->bytes() : impl_->pyramid->bytes()) +
         impl_->predictor.index().bytes();
}
std::string GlobalLocalizer::serializedIndex() const {
  if (!impl_->cells) throw std::logic_error("only the certified method's index can be kept");
  return serializeIndex(impl_->predictor.index().lists(), impl_->cells->data(), impl_->map.hash());
}
double GlobalLocalizer::indexBuildSeconds() const {
  return impl_->build_seconds;
}

LocalizationResult GlobalLocalizer::localize(const RangeScan& scan, const PosePrior& prior) const {
  prior.check();
  const GlobalLocalizerParams& params = impl_->params;
  LocalizationResult result;
  if (scan.hitCount() < params.least_hits) return result;

  const Stopwatch search_watch;
  const std::vector<TPose2D> candidates = impl_->search(scan, prior, result);
  result.statistics.refined = candidates.size();
  result.statistics.search_ms = 1e3 * search_watch.seconds();

  const Stopwatch refinement_watch;
  const ScanCost cost(impl_->predictor, scan, params.cost);
  const std::vector<RankedPose> poses = impl_->refine(candidates, scan, prior, cost);
  assess(poses, scan, cost, params.hypotheses, params.max_hypotheses, result);
  result.statistics.refinement_ms = 1e3 * refinement_watch.seconds();
  return result;
}

}  // namespace mrpt_polyloc
