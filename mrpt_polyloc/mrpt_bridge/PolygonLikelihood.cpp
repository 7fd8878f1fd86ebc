#include <mrpt_polyloc/base/cpu_dispatch.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/localization/scan/RobustCost.h>
#include <mrpt_polyloc/mrpt_bridge/PolygonLikelihood.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

using mrpt::obs::CObservation2DRangeScan;

/// The beams of a scan that are compared, and all they were made from.
class PreparedScan {
 public:
  PreparedScan(const CObservation2DRangeScan& scan, unsigned decimation)
      : decimation_(decimation),
        size_(scan.getScanSize()),
        aperture_(scan.aperture),
        max_range_(scan.maxRange),
        right_to_left_(rightToLeft(scan)),
        pose_(scan.sensorPose) {
    const RangeScan all = toRangeScan(scan);
    if (size_ > 0) ranges_.assign(&scan.getScanRange(0), &scan.getScanRange(0) + size_);
    std::vector<double> bearings;
    for (std::size_t i = 0; i < size_; i += decimation_) {
      valid_.push_back(scan.getScanRangeValidity(i));
      const Beam& beam = all.beams()[i];
      if (beam.kind != BeamKind::invalid) beams.push_back(beam);
    }
    std::stable_partition(beams.begin(), beams.end(),
                          [](const Beam& beam) { return beam.kind == BeamKind::hit; });
    for (const Beam& beam : beams) {
      bearings.push_back(beam.bearing);
      if (beam.kind == BeamKind::hit) hits.push_back(static_cast<float>(beam.range));
    }
    pattern.emplace(bearings);
    origin.emplace(std::vector<Beam>{}, all.sensor());
  }

  /// Whether another preparation would give the same. Ranges by their bits, for the sake of NaN.
  bool isOf(const CObservation2DRangeScan& scan, unsigned decimation) const {
    if (decimation != decimation_ || scan.getScanSize() != size_ || scan.aperture != aperture_ ||
        scan.maxRange != max_range_ || rightToLeft(scan) != right_to_left_ ||
        scan.sensorPose != pose_) {
      return false;
    }
    if (size_ > 0 &&
        std::memcmp(&scan.getScanRange(0), ranges_.data(), size_ * sizeof(float)) != 0) {
      return false;
    }
    for (std::size_t i = 0, k = 0; i < size_; i += decimation_, ++k) {
      if (scan.getScanRangeValidity(i) != (valid_[k] != 0)) return false;
    }
    return true;
  }

  std::vector<Beam> beams;  ///< hits first
  std::vector<float> hits;  ///< their ranges
  std::optional<BeamPattern> pattern;
  std::optional<RangeScan> origin;  ///< without beams: where the sensor is

 private:
  unsigned decimation_;
  std::size_t size_;
  float aperture_, max_range_;
  bool right_to_left_;
  mrpt::poses::CPose3D pose_;
  std::vector<float> ranges_;
  std::vector<char> valid_;
};

/// The robust cost of hits, summed over lanes of their own so that vectors of them can be added.
POLYLOC_HOT_LOOP
float sumOfHits(const RobustCost& cost, const float* z, const float* wall, const float* open,
                std::size_t count) {
  constexpr std::size_t kLanes = 16;
  float sums[kLanes] = {};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      sums[lane] += cost.hit(z[i + lane], wall[i + lane], open[i + lane]);
    }
  }
  for (std::size_t lane = 0; i < count; ++i, ++lane) {
    sums[lane] += cost.hit(z[i], wall[i], open[i]);
  }
  return std::accumulate(sums, sums + kLanes, 0.0F);
}

double robustMean(const PreparedScan& scan, const PredictedRanges& seen, const RobustCost& cost) {
  float sum =
      sumOfHits(cost, scan.hits.data(), seen.wall.data(), seen.open.data(), scan.hits.size());
  for (std::size_t i = scan.hits.size(); i < scan.beams.size(); ++i) {
    sum += cost(scan.beams[i], seen.wall[i], seen.open[i]);
  }
  return static_cast<double>(sum) / static_cast<double>(scan.beams.size());
}

/// Of the hits' squares [m2]; beams without return have no place in the metric. 0 without hits.
double polarMean(const PreparedScan& scan, const PredictedRanges& seen, double cap) {
  double sum = 0.0;
  for (std::size_t i = 0; i < scan.hits.size(); ++i) {
    const double wall = static_cast<double>(seen.wall[i]);
    const double d = std::min(std::abs(scan.beams[i].range - wall), cap);
    sum += d * d;
  }
  return scan.hits.empty() ? 0.0 : sum / static_cast<double>(scan.hits.size());
}

/// The prepared form of a scan, kept by the calling thread until another scan comes.
const PreparedScan& preparedFor(const CObservation2DRangeScan& scan, unsigned decimation) {
  thread_local std::unique_ptr<const PreparedScan> prepared;
  if (!prepared || !prepared->isOf(scan, decimation)) {
    prepared = std::make_unique<const PreparedScan>(scan, decimation);
  }
  return *prepared;
}

/// The likelihood of a prepared scan that says something, as a function of what is predicted.
class Weigher {
 public:
  Weigher(const RangePredictor& predictor, const PreparedScan& scan,
          const TLikelihoodOptions& options)
      : predictor_(&predictor),
        scan_(&scan),
        cost_(options.cost),
        cap_(options.cost.tau_long),
        is_polar_(options.metric == "polar"),
        worst_(is_polar_ ? cap_ * cap_ : std::max(options.cost.tau_short, cap_)),
        scale_(is_polar_ ? 2.0 * options.sigma * options.sigma : options.sigma),
        beams_(std::min(static_cast<double>(scan.beams.size()), options.independent_beams)) {}

  /// Of a pose of the beam frame.
  double operator()(const mrpt::math::TPose2D& pose) const {
    thread_local PredictedRanges seen;
    const bool is_placed =
        std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.phi);
    double mean = worst_;
    if (is_placed && predictor_->index().covers({pose.x, pose.y})) {
      predictor_->predict(pose, *scan_->pattern, seen);
      mean = is_polar_ ? polarMean(*scan_, seen, cap_) : robustMean(*scan_, seen, cost_);
    }
    return std::max(-beams_ * mean / scale_, kLogLikelihoodFloor);
  }

 private:
  const RangePredictor* predictor_;
  const PreparedScan* scan_;
  RobustCost cost_;
  double cap_;
  bool is_polar_;
  double worst_, scale_, beams_;
};

}  // namespace

double scanLogLikelihood(const RangePredictor& predictor, const CObservation2DRangeScan& scan,
                         const mrpt::math::TPose2D& pose_map_robot,
                         const TLikelihoodOptions& options) {
  const PreparedScan& prepared = preparedFor(scan, options.decimation);
  if (prepared.beams.empty()) return 0.0;
  const Weigher weigh(predictor, prepared, options);
  return weigh(prepared.origin->beamFrameFromRobot(pose_map_robot));
}

std::vector<double> scanLogLikelihoods(const RangePredictor& predictor,
                                       const CObservation2DRangeScan& scan,
                                       const std::vector<mrpt::math::TPose2D>& poses_map_robot,
                                       const TLikelihoodOptions& options) {
  std::vector<double> likelihoods(poses_map_robot.size(), 0.0);
  const PreparedScan& prepared = preparedFor(scan, options.decimation);
  if (prepared.beams.empty()) return likelihoods;
  std::vector<mrpt::math::TPose2D> poses;
  std::vector<std::pair<std::int64_t, std::size_t>> order;  // cell and number
  poses.reserve(poses_map_robot.size());
  order.reserve(poses_map_robot.size());
  for (const mrpt::math::TPose2D& pose : poses_map_robot) {
    poses.push_back(prepared.origin->beamFrameFromRobot(pose));
    order.emplace_back(predictor.index().squareNumber({poses.back().x, poses.back().y}),
                       order.size());
  }
  std::sort(order.begin(), order.end());
  const Weigher weigh(predictor, prepared, options);
  for (const auto& [cell, i] : order) likelihoods[i] = weigh(poses[i]);
  return likelihoods;
}

}  // namespace mrpt_polyloc
