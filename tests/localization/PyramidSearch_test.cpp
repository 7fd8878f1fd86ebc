#include "lattice_costs.h"
#include "params_messages.h"
#include <mrpt_polyloc/localization/PyramidSearch.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <tuple>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;
using ::testing::HasSubstr;

/// The cells of which one candidate each is wanted.
using Cell = std::tuple<int, int, int>;
Cell cellOf(const TPose2D& pose) {
  const int heading = static_cast<int>(std::lround(pose.phi / headingOfBin(1)));
  return {static_cast<int>(std::floor(pose.x / 0.3)), static_cast<int>(std::floor(pose.y / 0.3)),
          heading / 4};
}

/// The least cost in each cell, of the lattice poses that are allowed.
std::map<Cell, unsigned> leastCosts(const SignaturePyramid& pyramid,
                                    const std::vector<unsigned>& costs,
                                    const std::function<bool(const TPose2D&)>& allowed) {
  std::map<Cell, unsigned> least;
  for (std::size_t i = 0; i < pyramid.blocks(0).size(); ++i) {
    const TPoint2D p = pyramid.center(0, i);
    for (std::size_t heading = 0; heading < kBins; ++heading) {
      const TPose2D pose(p.x, p.y, headingOfBin(heading));
      if (!allowed(pose)) continue;
      const unsigned cost = costs[i * kBins + heading];
      const auto [place, is_new] = least.emplace(cellOf(pose), cost);
      if (!is_new) place->second = std::min(place->second, cost);
    }
  }
  return least;
}

PyramidSearchParams unlimited() {
  PyramidSearchParams params;
  params.max_candidates = 1000000;
  return params;
}

/// The search's candidates are the exhaustive comparison's: best first, the best of every cell that
/// is within the margin, nothing else.
void expectExhaustive(const PyramidSearchResult& found, const std::map<Cell, unsigned>& least,
                      std::size_t used_bins, const PyramidSearchParams& params) {
  if (least.empty()) {
    EXPECT_TRUE(found.candidates.empty());
    return;
  }
  unsigned best = ~0U;
  for (const auto& [cell, cost] : least) best = std::min(best, cost);
  const double limit =
      best * (1.0 + params.margin_share) + params.margin * static_cast<double>(used_bins);
  std::map<Cell, unsigned> wanted;
  for (const auto& [cell, cost] : least) {
    if (cost <= limit) wanted.emplace(cell, cost);
  }
  ASSERT_FALSE(found.candidates.empty());
  EXPECT_EQ(found.candidates.front().cost, best);
  std::map<Cell, unsigned> got;
  unsigned before = 0;
  for (const PyramidCandidate& candidate : found.candidates) {
    EXPECT_GE(candidate.cost, before);
    before = candidate.cost;
    EXPECT_TRUE(got.emplace(cellOf(candidate.pose_map_beams), candidate.cost).second);
  }
  EXPECT_EQ(got, wanted);
}

class PyramidSearchOnMaps : public ::testing::TestWithParam<std::uint32_t> {
 protected:
  PyramidOfMap built_{smallBuilding(GetParam())};
  const SignaturePyramid& pyramid_ = built_.pyramid;
};

TEST_P(PyramidSearchOnMaps, FindsWhatAnExhaustiveComparisonFinds) {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const SignatureQuery query(roughScan(built_.map, seed));
    const std::vector<unsigned> costs = latticeCosts(pyramid_, query);
    const auto found = searchPyramid(pyramid_, query, {}, {0, 0}, unlimited());
    expectExhaustive(found, leastCosts(pyramid_, costs, [](const TPose2D&) { return true; }),
                     query.used_bins, unlimited());
    EXPECT_GT(found.evaluated, 0U);
  }
}

TEST_P(PyramidSearchOnMaps, APriorRestrictsTheExhaustiveComparison) {
  const TPoint2D sensor(0.4, -0.3);
  std::mt19937 random(GetParam());
  for (std::uint32_t seed = 20; seed < 26; ++seed) {
    SCOPED_TRACE(seed);
    const RangeScan scan = roughScan(built_.map, seed, sensor);
    const SignatureQuery query(scan);
    const std::vector<unsigned> costs = latticeCosts(pyramid_, query);
    PosePrior prior;
    const TPoint2D p = randomFreePoints(built_.map, 1, random).front();
    if (seed % 3 != 0) prior.near = PosePrior::Disk{p.x, p.y, seed % 2 == 0 ? 0.6 : 2.0};
    if (seed % 3 != 1) prior.compass = PosePrior::Compass{seed * 1.0, seed % 2 == 0 ? 0.05 : 1.0};
    const auto within = [&](const TPose2D& pose, double grace, double heading_grace) {
      const TPose2D robot = scan.robotFromBeamFrame(pose);
      if (prior.near && std::hypot(robot.x - prior.near->x, robot.y - prior.near->y) >
                            prior.near->radius + grace) {
        return false;
      }
      return !prior.compass ||
             std::abs(std::remainder(robot.phi - prior.compass->heading, 2 * kPi)) <=
                 prior.compass->tolerance + heading_grace;
    };
    // Lattice poses stand for those around them.
    const double half_bin = 0.5 * headingOfBin(1);
    const auto found = searchPyramid(pyramid_, query, prior, sensor, unlimited());
    expectExhaustive(found,
                     leastCosts(pyramid_, costs,
                                [&](const TPose2D& pose) {
                                  return within(pose, PyramidOfMap::kSpacing, half_bin);
                                }),
                     query.used_bins, unlimited());
    for (const PyramidCandidate& candidate : found.candidates) {
      EXPECT_TRUE(within(candidate.pose_map_beams, PyramidOfMap::kSpacing, half_bin));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, PyramidSearchOnMaps, ::testing::Values(0U, 1U, 2U, 3U, 4U));

TEST(PyramidSearch, NothingWhereThePriorIsOutsideTheMap) {
  const PyramidOfMap built(squareMap(4.0));
  const SignatureQuery query(roughScan(built.map, 2));
  PosePrior prior;
  prior.near = PosePrior::Disk{40, 2, 3};
  EXPECT_TRUE(searchPyramid(built.pyramid, query, prior, {0, 0}).candidates.empty());
}

TEST(PyramidSearch, ACompassThatMayBeAnythingChangesNothing) {
  const PyramidOfMap built(asymmetricRoom());
  const SignatureQuery query(roughScan(built.map, 2));
  PosePrior prior;
  prior.compass = PosePrior::Compass{1.0, kPi};
  const auto without = searchPyramid(built.pyramid, query, {}, {0, 0});
  const auto with = searchPyramid(built.pyramid, query, prior, {0, 0});
  ASSERT_EQ(with.candidates.size(), without.candidates.size());
  for (std::size_t i = 0; i < with.candidates.size(); ++i) {
    EXPECT_EQ(with.candidates[i].pose_map_beams, without.candidates[i].pose_map_beams);
  }
}

TEST(PyramidSearch, EndsWithTheMostCandidatesAskedFor) {
  const PyramidOfMap built(asymmetricRoom());
  const SignatureQuery query(roughScan(built.map, 3));
  const auto all = searchPyramid(built.pyramid, query, {}, {0, 0}, unlimited());
  ASSERT_GT(all.candidates.size(), 5U);
  PyramidSearchParams params;
  params.max_candidates = 5;
  const auto few = searchPyramid(built.pyramid, query, {}, {0, 0}, params);
  ASSERT_EQ(few.candidates.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(few.candidates[i].cost, all.candidates[i].cost);
  EXPECT_LE(few.evaluated, all.evaluated);
}

TEST(PyramidSearch, EvaluatesFarFewerThanAll) {
  const PyramidOfMap built(asymmetricRoom());
  const SignatureQuery query(simulatedScan(built.map, {1.5, 2.0, 0.7}));
  PyramidSearchParams params;
  params.margin = 0.0;
  params.margin_share = 0.0;
  const auto found = searchPyramid(built.pyramid, query, {}, {0, 0}, params);
  EXPECT_LT(found.evaluated, built.pyramid.blocks(0).size() * kBins / 4);
  ASSERT_FALSE(found.candidates.empty());
  EXPECT_LT(distanceBetween(found.candidates[0].pose_map_beams, {1.5, 2.0, 0.7}), 0.25);
}

TEST(PyramidSearch, GreatestCapsDoNotOverflow) {
  const PyramidOfMap built(squareMap(3.0));
  SignatureCosts costs;
  costs.cap_short = costs.cap_long = costs.cap_open = costs.cap_none = 63;
  std::vector<Beam> beams;  // ends far beyond all walls: every bin at its cap
  for (std::size_t i = 0; i < kBins; ++i) beams.push_back({headingOfBin(i), 50.0, BeamKind::hit});
  const SignatureQuery query(RangeScan(std::move(beams)), costs);
  const auto found = searchPyramid(built.pyramid, query, {}, {0, 0});
  ASSERT_FALSE(found.candidates.empty());
  EXPECT_EQ(found.candidates[0].cost, 63U * kBins);
}

TEST(PyramidSearchParams, ChecksNameTheField) {
  EXPECT_EQ(complaintOf(PyramidSearchParams{}), "");
  PyramidSearchParams params;
  params.margin_share = -0.1;
  EXPECT_THAT(complaintOf(params), HasSubstr("margin_share"));
  params = {};
  params.margin = std::nan("");
  EXPECT_THAT(complaintOf(params), HasSubstr("margin"));
  params = {};
  params.max_candidates = 0;
  EXPECT_THAT(complaintOf(params), HasSubstr("max_candidates"));
}

}  // namespace
}  // namespace mrpt_polyloc::test
