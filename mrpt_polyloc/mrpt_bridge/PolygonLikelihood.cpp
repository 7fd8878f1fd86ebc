#include <mrpt_polyloc/geometry/params_check.h>
#include <mrpt_polyloc/mrpt_bridge/PolygonLikelihood.h>
#include <mrpt_polyloc/mrpt_bridge/ini_keys.h>
#include <mrpt_polyloc/mrpt_bridge/observation.h>

#include <mrpt/config/CConfigFileBase.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <ostream>
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
        right_to_left_(scan.rightToLeft),
        pose_(scan.sensorPose) {
    const RangeScan all = toRangeScan(scan);
    std::vector<double> bearings;
    for (std::size_t i = 0; i < size_; i += decimation_) {
      ranges_.push_back(scan.getScanRange(i));
      valid_.push_back(scan.getScanRangeValidity(i));
      const Beam& beam = all.beams()[i];
      if (beam.kind == BeamKind::invalid) continue;
      beams.push_back(beam);
      bearings.push_back(beam.bearing);
    }
    pattern.emplace(bearings);
    origin.emplace(std::vector<Beam>{}, all.sensor());
  }

  /// Whether another preparation would give the same. Ranges by their bits, for the sake of NaN.
  bool isOf(const CObservation2DRangeScan& scan, unsigned decimation) const {
    if (decimation != decimation_ || scan.getScanSize() != size_ || scan.aperture != aperture_ ||
        scan.maxRange != max_range_ || scan.rightToLeft != right_to_left_ ||
        scan.sensorPose != pose_) {
      return false;
    }
    for (std::size_t i = 0, k = 0; i < size_; i += decimation_, ++k) {
      if (std::memcmp(&scan.getScanRange(i), &ranges_[k], sizeof(float)) != 0) return false;
      if (scan.getScanRangeValidity(i) != (valid_[k] != 0)) return false;
    }
    return true;
  }

  std::vector<Beam> beams;
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

double robustMean(const PreparedScan& scan, const PredictedRanges& seen, const RobustCost& cost) {
  double sum = 0.0;
  for (std::size_t i = 0; i < scan.beams.size(); ++i) {
    sum += static_cast<double>(cost(scan.beams[i], seen.wall[i], seen.open[i]));
  }
  return sum / static_cast<double>(scan.beams.size());
}

/// Of squares [m2]; beams without return have no place in the metric and cost nothing.
double polarMean(const PreparedScan& scan, const PredictedRanges& seen, double cap) {
  double sum = 0.0;
  for (std::size_t i = 0; i < scan.beams.size(); ++i) {
    if (scan.beams[i].kind != BeamKind::hit) continue;
    const double wall = static_cast<double>(seen.wall[i]);
    const double d = std::min(std::abs(scan.beams[i].range - wall), cap);
    sum += d * d;
  }
  return sum / static_cast<double>(scan.beams.size());
}

}  // namespace

void TLikelihoodOptions::check() const {
  if (metric != "robust" && metric != "polar") {
    throw InvalidParamsError("metric is '" + metric + "', not 'robust' or 'polar'");
  }
  requirePositive("sigma", sigma);
  requirePositive("independent_beams", independent_beams);
  requireInRange("decimation", decimation, 1.0, 1e6);
  cost.check();
}

void TLikelihoodOptions::loadFromConfigFile(const mrpt::config::CConfigFileBase& source,
                                            const std::string& section) {
  requireKnownKeys(source, section,
                   {"metric", "sigma", "decimation", "independent_beams", "tau_short", "tau_long",
                    "tau_open", "tau_none", "none_share"});
  metric = source.read_string(section, "metric", metric);
  sigma = source.read_double(section, "sigma", sigma);
  const double every = source.read_double(section, "decimation", decimation);
  requireInRange("decimation", every, 1.0, 1e6);
  decimation = static_cast<unsigned>(every);
  independent_beams = source.read_double(section, "independent_beams", independent_beams);
  cost.tau_short = source.read_double(section, "tau_short", cost.tau_short);
  cost.tau_long = source.read_double(section, "tau_long", cost.tau_long);
  cost.tau_open = source.read_double(section, "tau_open", cost.tau_open);
  cost.tau_none = source.read_double(section, "tau_none", cost.tau_none);
  cost.none_share = source.read_double(section, "none_share", cost.none_share);
  check();
}

void TLikelihoodOptions::dumpToTextStream(std::ostream& out) const {
  out << "metric = " << metric << "\nsigma = " << sigma << "\ndecimation = " << decimation
      << "\nindependent_beams = " << independent_beams << "\ntau_short = " << cost.tau_short
      << "\ntau_long = " << cost.tau_long << "\ntau_open = " << cost.tau_open
      << "\ntau_none = " << cost.tau_none << "\nnone_share = " << cost.none_share << "\n";
}

double scanLogLikelihood(const RangePredictor& predictor, const CObservation2DRangeScan& scan,
                         const mrpt::math::TPose2D& pose_map_robot,
                         const TLikelihoodOptions& options) {
  thread_local std::unique_ptr<const PreparedScan> prepared;
  thread_local PredictedRanges seen;
  if (!prepared || !prepared->isOf(scan, options.decimation)) {
    prepared = std::make_unique<const PreparedScan>(scan, options.decimation);
  }
  if (prepared->beams.empty()) return 0.0;
  const auto pose = prepared->origin->beamFrameFromRobot(pose_map_robot);
  const bool is_polar = options.metric == "polar";
  const double worst = std::max(options.cost.tau_short, options.cost.tau_long);
  double mean = is_polar ? options.cost.tau_long * options.cost.tau_long : worst;
  const bool is_placed = std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.phi);
  if (is_placed && predictor.index().covers({pose.x, pose.y})) {
    predictor.predict(pose, *prepared->pattern, seen);
    mean = is_polar ? polarMean(*prepared, seen, options.cost.tau_long)
                    : robustMean(*prepared, seen, RobustCost(options.cost));
  }
  const double beams =
      std::min(static_cast<double>(prepared->beams.size()), options.independent_beams);
  const double scale = is_polar ? 2.0 * options.sigma * options.sigma : options.sigma;
  return std::max(-beams * mean / scale, kLogLikelihoodFloor);
}

}  // namespace mrpt_polyloc
