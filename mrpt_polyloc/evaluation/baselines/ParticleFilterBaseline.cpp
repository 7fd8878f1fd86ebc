#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/evaluation/baselines/ParticleFilterBaseline.h>
#include <mrpt_polyloc/evaluation/baselines/mrpt_maps.h>
#include <mrpt_polyloc/io/observation.h>

#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <thread>
#include <tuple>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::bayes::CParticleFilter;
using mrpt::maps::COccupancyGridMap2D;
using mrpt::math::TPose2D;
using mrpt::obs::CActionCollection;
using mrpt::obs::CActionRobotMovement2D;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::slam::CMonteCarloLocalization2D;

constexpr double kHeapSide = 0.5;             // [m]
constexpr double kHeapTurn = 15.0 * kDegree;  // [rad]
constexpr std::size_t kMostHeaps = 20;
constexpr std::size_t kMostBins = 60;  // of particles, that heaps are looked for around

constexpr double kMaxRange = 1000.0;  // [m]: hits are hits, however far

mrpt::obs::CSensoryFrame frameOf(const Moment& moment) {
  mrpt::obs::CSensoryFrame frame;
  for (const RangeScan& scan : moment.scans) {
    if (scan.hitCount() == 0) continue;
    frame.insert(std::make_shared<CObservation2DRangeScan>(toEvenObservation(scan, kMaxRange)));
  }
  return frame;
}

CActionCollection actionOf(const Motion& motion, const ParticleFilterBaselineParams& params) {
  CActionRobotMovement2D::TMotionModelOptions model;
  model.modelSelection = CActionRobotMovement2D::mmGaussian;
  model.gaussianModel.minStdXY = params.min_std_xy;
  model.gaussianModel.minStdPHI = params.min_std_phi;
  CActionRobotMovement2D movement;
  movement.computeFromOdometry(mrpt::poses::CPose2D(motion.pose_before_after), model);
  CActionCollection action;
  action.insert(movement);
  return action;
}

struct Weighted {
  TPose2D pose;
  double weight = 0.0;
};

/// The mean of the particles near a pose, and the share of the weight that they hold.
Weighted meanNear(const std::vector<Weighted>& particles, const TPose2D& middle) {
  double x = 0.0, y = 0.0, turn = 0.0, weight = 0.0;
  for (const Weighted& particle : particles) {
    const double away = std::remainder(particle.pose.phi - middle.phi, kTwoPi);
    if (std::hypot(particle.pose.x - middle.x, particle.pose.y - middle.y) > kHeapSide ||
        std::abs(away) > kHeapTurn) {
      continue;
    }
    x += particle.weight * particle.pose.x;
    y += particle.weight * particle.pose.y;
    turn += particle.weight * away;
    weight += particle.weight;
  }
  if (weight <= 0.0) return {middle, 0.0};
  return {{x / weight, y / weight, std::remainder(middle.phi + turn / weight, kTwoPi)}, weight};
}

/// Means of heaps of particles, the heaviest first, no two of them near each other.
std::vector<Weighted> heapsOf(const std::vector<Weighted>& particles) {
  std::map<std::tuple<long, long, long>, Weighted> bins;
  for (const Weighted& particle : particles) {
    Weighted& bin =
        bins[{std::lround(particle.pose.x / kHeapSide), std::lround(particle.pose.y / kHeapSide),
              std::lround(std::remainder(particle.pose.phi, kTwoPi) / kHeapTurn)}];
    if (bin.weight == 0.0) bin.pose = particle.pose;
    bin.weight += particle.weight;
  }
  std::vector<Weighted> heaviest;
  for (const auto& bin : bins) heaviest.push_back(bin.second);
  const auto is_heavier = [](const Weighted& a, const Weighted& b) { return a.weight > b.weight; };
  std::stable_sort(heaviest.begin(), heaviest.end(), is_heavier);
  if (heaviest.size() > kMostBins) heaviest.resize(kMostBins);
  std::vector<Weighted> heaps;
  for (const Weighted& bin : heaviest) {
    if (heaps.size() == kMostHeaps) break;
    const Weighted heap = meanNear(particles, meanNear(particles, bin.pose).pose);
    const bool is_known = std::any_of(heaps.begin(), heaps.end(), [&](const Weighted& other) {
      return std::hypot(heap.pose.x - other.pose.x, heap.pose.y - other.pose.y) < kHeapSide &&
             angleBetween(heap.pose.phi, other.pose.phi) < kHeapTurn;
    });
    if (!is_known && heap.weight > 0.0) heaps.push_back(heap);
  }
  std::stable_sort(heaps.begin(), heaps.end(), is_heavier);
  return heaps;
}

}  // namespace

void ParticleFilterBaselineParams::check() const {
  requireInRange("particles", static_cast<double>(particles), 1.0, 1e8);
  requirePositive("sigma", sigma);
  requireInRange("decimation", decimation, 1, 10'000);
  requireNotNegative("min_std_xy", min_std_xy);
  requireNotNegative("min_std_phi", min_std_phi);
}

struct ParticleFilterBaseline::Parts {
  ParticleFilterBaselineParams params;
  TPose2D pose_map_grid;
  COccupancyGridMap2D::Ptr grid;
  mutable tbb::enumerable_thread_specific<COccupancyGridMap2D::Ptr> grids;

  /// The calling thread's: MRPT's grid keeps a cache.
  const COccupancyGridMap2D::Ptr& ownGrid() const {
    COccupancyGridMap2D::Ptr& own = grids.local();
    if (!own) own = std::make_shared<COccupancyGridMap2D>(*grid);
    return own;
  }

  std::vector<Weighted> run(const ScanSet& drive, std::uint32_t seed,
                            const COccupancyGridMap2D::Ptr& own) const {
    mrpt::random::getRandomGenerator().randomize(seed);
    CMonteCarloLocalization2D pdf;
    pdf.options.metricMap = own;
    pdf.options.KLD_params.KLD_binSize_XY = 0.1;
    pdf.options.KLD_params.KLD_binSize_PHI = 10.0 * kDegree;
    pdf.options.KLD_params.KLD_delta = 0.01;
    pdf.options.KLD_params.KLD_epsilon = 0.01;
    pdf.options.KLD_params.KLD_minSampleSize = 150;
    pdf.options.KLD_params.KLD_maxSampleSize = static_cast<unsigned int>(params.particles);
    pdf.resetUniformFreeSpace(own.get(), 0.7, static_cast<int>(params.particles));
    CParticleFilter filter;
    filter.m_options.PF_algorithm = CParticleFilter::pfStandardProposal;
    filter.m_options.resamplingMethod = CParticleFilter::prMultinomial;
    filter.m_options.adaptiveSampleSize = true;
    filter.m_options.BETA = 0.5;
    for (std::size_t i = 0; i < drive.moments().size(); ++i) {
      const Moment& moment = drive.moments()[i];
      const mrpt::obs::CSensoryFrame frame = frameOf(moment);
      if (i == 0) {
        filter.executeOn(pdf, nullptr, &frame, nullptr);
        continue;
      }
      const CActionCollection action = actionOf(moment.since_before, params);
      filter.executeOn(pdf, &action, &frame, nullptr);
    }
    std::vector<Weighted> particles;
    double most = pdf.m_particles.front().log_w, all = 0.0;
    for (const auto& particle : pdf.m_particles) most = std::max(most, particle.log_w);
    for (const auto& particle : pdf.m_particles) {
      particles.push_back({particle.d, std::exp(particle.log_w - most)});
      all += particles.back().weight;
    }
    for (Weighted& particle : particles) particle.weight /= all;
    return heapsOf(particles);
  }
};

ParticleFilterBaseline::ParticleFilterBaseline(const OccupancyBitmap& bitmap,
                                               const ParticleFilterBaselineParams& params)
    : parts_(std::make_unique<Parts>()) {
  params.check();
  parts_->params = params;
  parts_->pose_map_grid = bitmap.pose_map_bitmap;
  if (std::count(bitmap.cells.begin(), bitmap.cells.end(), CellState::free) == 0) {
    throw InvalidMapError("the grid has no free cell");
  }
  parts_->grid = std::make_shared<COccupancyGridMap2D>(gridOf(bitmap, params.sigma));
  parts_->grid->likelihoodOptions.LF_decimation = static_cast<uint32_t>(params.decimation);
}

ParticleFilterBaseline::~ParticleFilterBaseline() = default;

std::size_t ParticleFilterBaseline::bytes() const {
  return static_cast<std::size_t>(parts_->grid->getSizeX()) * parts_->grid->getSizeY() *
         (sizeof(COccupancyGridMap2D::cellType) + sizeof(double));
}

std::vector<BaselineAnswer> ParticleFilterBaseline::localize(const ScanSet& drive,
                                                             std::uint32_t seed) const {
  if (drive.hitCount() == 0) return {};
  std::vector<Weighted> heaps;
  std::exception_ptr failure;
  std::thread thread([&, own = parts_->ownGrid()] {
    try {
      heaps = parts_->run(drive, seed, own);
    } catch (...) {
      failure = std::current_exception();
    }
  });
  thread.join();
  if (failure) std::rethrow_exception(failure);
  const mrpt::poses::CPose2D origin(parts_->pose_map_grid);
  std::vector<BaselineAnswer> answers;
  for (const Weighted& heap : heaps) {
    answers.push_back(
        {(origin + mrpt::poses::CPose2D(heap.pose)).asTPose(), std::clamp(heap.weight, 0.0, 1.0)});
  }
  return answers;
}

}  // namespace mrpt_polyloc
