#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/mrpt_bridge/FilterRecovery.h>

#include <gtest/gtest.h>

#include <cmath>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPosePDFParticles;

CPosePDFParticles particlesAt(const std::vector<TPose2D>& poses,
                              const std::vector<double>& weights = {}) {
  CPosePDFParticles particles;
  particles.clearParticles();
  particles.m_particles.resize(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    particles.m_particles[i].d = poses[i];
    particles.m_particles[i].log_w = weights.empty() ? 0.0 : std::log(weights[i]);
  }
  return particles;
}

/// Belief within 0.3 m and 0.2 rad of a pose.
double beliefNear(const CPosePDFParticles& particles, const TPose2D& pose) {
  double near = 0.0, all = 0.0;
  for (const auto& particle : particles.m_particles) {
    const double weight = std::exp(particle.log_w);
    all += weight;
    if (test::distanceBetween(particle.d, pose) < 0.3 && test::turnBetween(particle.d, pose) < 0.2)
      near += weight;
  }
  return near / all;
}

class FilterRecoveryTest : public testing::Test {
 protected:
  CObservation2DRangeScan scanFrom(const TPose2D& pose, std::uint32_t seed,
                                   std::size_t beams = 180) const {
    test::ScanOptions options;
    options.beams = beams;
    options.field_of_view = kTwoPi;
    options.sigma = 0.02;
    options.seed = seed;
    const double aperture = kTwoPi * (1.0 - 1.0 / static_cast<double>(beams));
    return toObservation(test::simulatedScan(map_, pose, options), aperture, 0.0, 80.0);
  }
  /// Along the lower wall of the room and back.
  static TPose2D onTheWay(int step) { return {3.5 + 2.5 * std::sin(0.1 * step), 1.0, 0.05 * step}; }

  PolygonMap map_ = test::asymmetricRoom();
  GlobalLocalizer localizer_{map_};
  ParticleSeeder seeder_{map_};
  CPolygonMap2D polygons_{map_};
};

TEST_F(FilterRecoveryTest, FitIsTheWeightedMeanOfTheLikelihoodPerBeam) {
  const TPose2D right{1.5, 1.0, 0.3}, wrong{4.5, 1.0, 2.0};
  const CObservation2DRangeScan scan = scanFrom(right, 5);
  CPolygonMap2D judge = polygons_;
  judge.likelihoodOptions.independent_beams = 1.0;
  const std::vector<double> fits = judge.computeLikelihoods(scan, {right, wrong});
  ASSERT_GT(fits[0], fits[1] + 0.5);
  // Of 50 looked at, systematic sampling takes 0.7 of them from the first, to within one.
  const double fit = filterFit(polygons_, scan, particlesAt({right, wrong}, {0.7, 0.3}), 50);
  EXPECT_NEAR(fit, 0.7 * fits[0] + 0.3 * fits[1], std::abs(fits[0] - fits[1]) / 50.0);
  // The filter's options do not change it.
  CPolygonMap2D other = polygons_;
  other.likelihoodOptions.sigma = 0.7;
  other.likelihoodOptions.decimation = 9;
  EXPECT_DOUBLE_EQ(filterFit(other, scan, particlesAt({right}), 1), fits[0]);
}

TEST_F(FilterRecoveryTest, MixingKeepsBothSharesOfBelief) {
  std::vector<TPose2D> old;
  std::vector<double> weights;
  for (int i = 0; i < 1000; ++i) {
    old.push_back({i < 250 ? 1.0 : 2.0, 1.0, 0.0});
    weights.push_back(i < 250 ? 3.0 : 1.0);  // each group half of the belief
  }
  CPosePDFParticles particles = particlesAt(old, weights);
  const std::vector<WeightedPose> drawn(100, {{5.0, 1.0, 0.0}, std::log(0.01)});
  mixIn(drawn, 0.25, particles);
  EXPECT_EQ(particles.size(), 1000U);
  double sum = 0.0;
  for (const auto& particle : particles.m_particles) sum += std::exp(particle.log_w);
  EXPECT_NEAR(sum, 1.0, 1e-9);
  EXPECT_NEAR(beliefNear(particles, {5.0, 1.0, 0.0}), 0.25, 1e-9);
  EXPECT_NEAR(beliefNear(particles, {1.0, 1.0, 0.0}), 0.375, 0.002);
  EXPECT_NEAR(beliefNear(particles, {2.0, 1.0, 0.0}), 0.375, 0.002);

  CPosePDFParticles few = particlesAt({{1, 1, 0}, {1, 1, 0}, {1, 1, 0}});
  mixIn(drawn, 0.5, few);
  EXPECT_EQ(few.size(), 2U + 100U);  // at least half of the old ones stay
  CPosePDFParticles replaced = particlesAt(old, weights);
  mixIn(drawn, 1.0, replaced);
  EXPECT_NEAR(beliefNear(replaced, {5.0, 1.0, 0.0}), 1.0, 1e-12);
  CPosePDFParticles same = particlesAt(old, weights);
  mixIn(drawn, 0.0, same);
  EXPECT_NEAR(beliefNear(same, {1.0, 1.0, 0.0}), 0.5, 0.002);
}

TEST_F(FilterRecoveryTest, StartsWhereTheFirstScanWasTaken) {
  FilterRecovery recovery(localizer_, seeder_, polygons_);
  CPosePDFParticles particles;
  const TPose2D pose = onTheWay(0);
  const LocalizationResult found = recovery.start(scanFrom(pose, 1), 1, particles);
  ASSERT_FALSE(found.hypotheses.empty());
  EXPECT_GT(beliefNear(particles, pose), 0.9);
}

TEST_F(FilterRecoveryTest, FindsATeleportedRobotAndLeavesAHealthyFilterAlone) {
  FilterRecovery recovery(localizer_, seeder_, polygons_);
  CPosePDFParticles particles;
  recovery.start(scanFrom(onTheWay(0), 1), 1, particles);
  for (int step = 1; step < 40; ++step) {
    particles = particlesAt({onTheWay(step)});  // a filter that follows the robot
    const auto verdict =
        recovery.update(scanFrom(onTheWay(step), static_cast<std::uint32_t>(step)), 2, particles);
    ASSERT_TRUE(verdict.fit);
    ASSERT_FALSE(verdict.search) << step;
    ASSERT_EQ(particles.size(), 1U);
  }
  int steps = 0;
  const TPose2D elsewhere{3.0, 4.5, -2.0};
  bool is_found = false;
  while (!is_found && ++steps < 10) {  // the filter stays where it was
    particles = particlesAt(std::vector<TPose2D>(500, onTheWay(40)));
    is_found =
        recovery.update(scanFrom(elsewhere, 500 + static_cast<std::uint32_t>(steps)), 3, particles)
            .mixed_in;
  }
  ASSERT_TRUE(is_found);
  EXPECT_EQ(steps, static_cast<int>(FilterMonitorParams{}.patience));
  EXPECT_GT(beliefNear(particles, elsewhere), 0.4);  // of a share of 0.5
  EXPECT_NEAR(beliefNear(particles, onTheWay(40)), 0.5, 0.02);
}

/// In a room without anything in it.
class AmbiguousRecoveryTest : public FilterRecoveryTest {
 protected:
  AmbiguousRecoveryTest() {
    test::ScanOptions options;
    options.beams = 180;
    options.sigma = 0.01;
    options.seed = 3;
    const double aperture = kTwoPi * (1.0 - 1.0 / 180.0);
    scan_ = toObservation(test::simulatedScan(box_, {2.0, 1.5, 0.3}, options), aperture, 0.0, 80.0);
  }
  /// How many bad steps it takes until hypotheses are mixed in; 0 if they never are.
  int stepsUntilMixed(const FilterRecoveryParams& params) {
    const GlobalLocalizer localizer(box_);
    const ParticleSeeder seeder(box_);
    FilterRecovery recovery(localizer, seeder, CPolygonMap2D(box_), params);
    CPosePDFParticles particles = particlesAt({{2.0, 1.5, 0.3}});
    for (int i = 0; i < 20; ++i) recovery.update(scan_, 1, particles);
    for (int step = 1; step < 40; ++step) {
      particles = particlesAt({{3.4, 2.6, 1.0}});
      const auto verdict = recovery.update(scan_, 1, particles);
      if (verdict.search) {
        EXPECT_EQ(verdict.search->status, LocalizationStatus::ambiguous);
      }
      if (verdict.mixed_in) return step;
    }
    return 0;
  }

  // Half a turn maps it onto itself: every scan has two places.
  PolygonMap box_ = test::mapOf({{0, 0}, {6, 0}, {6, 4}, {0, 4}});
  CObservation2DRangeScan scan_;
};

TEST_F(AmbiguousRecoveryTest, WaitsForASureAnswerButNotForEver) {
  FilterRecoveryParams params;
  const auto alarm = static_cast<int>(params.monitor.patience);
  EXPECT_EQ(stepsUntilMixed(params), alarm + static_cast<int>(params.patience));
  params.patience = 0;
  EXPECT_EQ(stepsUntilMixed(params), alarm);
  params.patience = 10;
  params.sure_weight = 0.3;  // two of about a half
  EXPECT_EQ(stepsUntilMixed(params), alarm);
  params.least_gain = 100.0;  // no hypothesis is so much better
  EXPECT_EQ(stepsUntilMixed(params), 0);
}

/// A corridor with equal niches at unequal distances, and a laser that sees one of them at most:
/// only who has driven from one to the next knows where he is.
class CorridorRecoveryTest : public testing::Test {
 protected:
  static constexpr double kRange = 2.5;  // [m]
  static constexpr double kStep = 0.75;  // [m]

  static TPose2D at(int step) { return {6.0 + kStep * step, 1.0, 0.0}; }

  CObservation2DRangeScan scanFrom(const TPose2D& pose, std::uint32_t seed) const {
    test::ScanOptions options;
    options.beams = 180;
    options.max_range = kRange;
    options.sigma = 0.01;
    options.seed = seed;
    const double aperture = kTwoPi * (1.0 - 1.0 / 180.0);
    return toObservation(test::simulatedScan(corridor_, pose, options), aperture, 0.0, kRange);
  }

  /// After a filter that follows the robot standing at one end, the robot is carried to at(0) and
  /// drives on, while the filter's particles stay. \returns the step at which hypotheses were mixed
  /// in that are right, 0: never.
  int stepsUntilFound(double accumulate) {
    FilterRecoveryParams params;
    params.patience = 1000;
    params.last_metres.length = accumulate;
    FilterRecovery recovery(localizer_, seeder_, CPolygonMap2D(corridor_), params);
    const TPose2D before{27.5, 1.0, 0.8};
    CPosePDFParticles particles = particlesAt({before});
    recovery.start(scanFrom(before, 1), 1, particles);
    for (std::uint32_t i = 0; i < 20; ++i) {
      particles = particlesAt({before});
      recovery.update(scanFrom(before, 2 + i), 2, particles);
    }
    for (int step = 1; step < 20; ++step) {
      particles = particlesAt({before});
      recovery.move(measuredMotion({kStep, 0.0, 0.0}));
      const auto verdict =
          recovery.update(scanFrom(at(step), 100 + static_cast<std::uint32_t>(step)), 3, particles);
      if (!verdict.mixed_in) continue;
      EXPECT_GT(beliefNear(particles, at(step)), 0.4) << step;
      return step;
    }
    return 0;
  }

  PolygonMap corridor_ = test::mapOf({{0, 0},  {30, 0}, {30, 2}, {25, 2}, {25, 3}, {24, 3}, {24, 2},
                                      {20, 2}, {20, 3}, {19, 3}, {19, 2}, {12, 2}, {12, 3}, {11, 3},
                                      {11, 2}, {6, 2},  {6, 3},  {5, 3},  {5, 2},  {0, 2}});
  GlobalLocalizer localizer_{corridor_};
  ParticleSeeder seeder_{corridor_};
};

TEST_F(CorridorRecoveryTest, FindsByTheWayDrivenWhatNoScanTells) {
  EXPECT_EQ(stepsUntilFound(0.0), 0);
  const int found = stepsUntilFound(8.0);
  EXPECT_GT(found, 0);
  EXPECT_LT(found,
            9);  // at the next niche: what was seen before the robot was carried is forgotten
}

TEST_F(FilterRecoveryTest, TakesScansOfAClockThatIsSetBack) {
  FilterRecoveryParams params;
  params.last_metres.length = 2.0;
  FilterRecovery recovery(localizer_, seeder_, polygons_, params);
  CPosePDFParticles particles;
  CObservation2DRangeScan scan = scanFrom(onTheWay(0), 1);
  scan.timestamp = mrpt::Clock::fromDouble(2000.0);
  recovery.start(scan, 1, particles);
  scan = scanFrom(onTheWay(1), 2);
  scan.timestamp = mrpt::Clock::fromDouble(1000.0);
  recovery.move(measuredMotion({0.5, 0.0, 0.0}));
  EXPECT_NO_THROW(recovery.update(scan, 2, particles));
  EXPECT_THROW(recovery.move(measuredMotion({std::nan(""), 0.0, 0.0})), InvalidParamsError);
}

TEST_F(FilterRecoveryTest, SearchesUntilSomethingIsFound) {
  FilterRecovery recovery(localizer_, seeder_, polygons_);
  CPosePDFParticles particles;
  const CObservation2DRangeScan nothing;
  const TPose2D pose = onTheWay(7);
  EXPECT_EQ(recovery.start(nothing, 1, particles).status, LocalizationStatus::too_few_beams);
  EXPECT_EQ(particles.size(), ParticleSeederParams{}.particles);  // all over the map
  EXPECT_LT(beliefNear(particles, pose), 0.2);
  auto verdict = recovery.update(nothing, 2, particles);
  EXPECT_FALSE(verdict.fit);  // says nothing, so it is not judged
  EXPECT_FALSE(verdict.search);
  verdict = recovery.update(scanFrom(pose, 9), 3, particles);
  EXPECT_TRUE(verdict.mixed_in);
  EXPECT_GT(beliefNear(particles, pose), 0.4);
  verdict = recovery.update(scanFrom(pose, 10), 4, particles);
  EXPECT_FALSE(verdict.search);
}

TEST_F(FilterRecoveryTest, IsTheSameForTheSameSeed) {
  CPosePDFParticles a, b, c;
  FilterRecovery(localizer_, seeder_, polygons_).start(scanFrom(onTheWay(3), 1), 5, a);
  FilterRecovery(localizer_, seeder_, polygons_).start(scanFrom(onTheWay(3), 1), 5, b);
  FilterRecovery(localizer_, seeder_, polygons_).start(scanFrom(onTheWay(3), 1), 6, c);
  ASSERT_EQ(a.size(), b.size());
  bool differs = a.size() != c.size();
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.m_particles[i].d, b.m_particles[i].d);
    differs = differs || a.m_particles[i].d != c.m_particles[i].d;
  }
  EXPECT_TRUE(differs);
}

TEST_F(FilterRecoveryTest, NamesBadParameters) {
  FilterRecoveryParams params;
  params.share = 1.5;
  EXPECT_THROW(FilterRecovery(localizer_, seeder_, polygons_, params), InvalidParamsError);
  params = {};
  params.sure_weight = -0.1;
  EXPECT_THROW(FilterRecovery(localizer_, seeder_, polygons_, params), InvalidParamsError);
  params = {};
  params.judged_particles = 0;
  EXPECT_THROW(FilterRecovery(localizer_, seeder_, polygons_, params), InvalidParamsError);
  params = {};
  params.last_metres.spacing = -1.0;
  EXPECT_THROW(FilterRecovery(localizer_, seeder_, polygons_, params), InvalidParamsError);
  params = {};
  params.monitor.patience = 0;
  EXPECT_THROW(FilterRecovery(localizer_, seeder_, polygons_, params), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
