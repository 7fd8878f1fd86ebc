#include "simulated_scans.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/localization/BandQuery.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

RangeScan scanOf(const std::vector<double>& bearings_deg, double range = 3.0) {
  std::vector<Beam> beams;
  for (const double bearing : bearings_deg) {
    beams.push_back({bearing * kPi / 180.0, range, BeamKind::hit});
  }
  return RangeScan(beams);
}

std::vector<double> regular(double first, double step, std::size_t count) {
  std::vector<double> bearings;
  for (std::size_t i = 0; i < count; ++i) {
    bearings.push_back(first + step * static_cast<double>(i));
  }
  return bearings;
}

TEST(BandQuery, TakesTheBeamsOfARegularScannerThatShareAPhase) {
  for (const auto& [step, count] : {std::pair{0.5, 361}, {1.0, 181}, {2.0, 91}}) {
    const BandQuery query(scanOf(regular(-90.3, step, static_cast<std::size_t>(count))));
    EXPECT_TRUE(query.is_in_phase) << step;
    EXPECT_NEAR(static_cast<double>(query.beams.size()), 90.5, 0.5) << step;
    // At every heading, every beam points to where a bin begins.
    for (const Beam& beam : query.beams) {
      const double bins = (query.heading(17.0) + beam.bearing) / kBandBinWidth;
      EXPECT_NEAR(bins, std::round(bins), 1e-3);
    }
  }
}

TEST(BandQuery, TakesOneBeamABinOfAnyOtherScanner) {
  const BandQuery query(scanOf(regular(-110.0, 220.0 / 625.0, 626)));
  EXPECT_FALSE(query.is_in_phase);
  EXPECT_NEAR(static_cast<double>(query.beams.size()), 110.0, 1.0);
}

TEST(BandQuery, OfNothingHasNoBeams) {
  EXPECT_TRUE(BandQuery(RangeScan({})).beams.empty());
  EXPECT_TRUE(BandQuery(RangeScan({Beam{}, Beam{}})).beams.empty());
  EXPECT_EQ(BandQuery(scanOf({12.0})).beams.size(), 1U);
}

/// Bands of any kind: some with open edges, some unbounded.
struct RandomBands {
  RandomBands(std::mt19937& random, bool has_open) {
    for (auto* values : {&near_low, &wall_high, &near_high, &wall_low}) {
      values->resize(CellTree::kStride + 1);
    }
    for (std::size_t b = 0; b < kBandBins; ++b) {
      std::vector<int> sorted(4);
      for (int& value : sorted) value = static_cast<int>(random() % 1200);
      std::sort(sorted.begin(), sorted.end());
      if (!has_open) sorted[1] = sorted[0], sorted[2] = sorted[3];
      const bool is_open = has_open && random() % 2 == 0;
      near_low[b] = static_cast<std::uint16_t>(sorted[0]);
      near_high[b] = static_cast<std::uint16_t>(is_open ? sorted[1] : sorted[3]);
      wall_low[b] = static_cast<std::uint16_t>(is_open ? sorted[2] : sorted[0]);
      wall_high[b] = static_cast<std::uint16_t>((sorted[3] & ~1) | (is_open ? 1 : 0));
      if (random() % 10 == 0) wall_high[b] = static_cast<std::uint16_t>(65534 | (is_open ? 1 : 0));
    }
    for (auto* values : {&near_low, &wall_high, &near_high, &wall_low}) {
      for (std::size_t b = kBandBins; b <= CellTree::kStride; ++b) {
        (*values)[b] = (*values)[b - kBandBins];
      }
    }
    bands = {near_low.data(), wall_high.data(), has_open ? near_high.data() : nullptr,
             has_open ? wall_low.data() : nullptr};
  }
  std::vector<std::uint16_t> near_low, wall_high, near_high, wall_low;
  CellTree::Bands bands{};
};

/// The lower bound beam by beam, in plain arithmetic on units.
unsigned plainBound(const RandomBands& r, const BandQuery& query, std::size_t heading,
                    const RobustCostParams& cost) {
  const auto units = [](double meters) { return static_cast<int>(meters * RangeUnits::kPerMeter); };
  int sum = 0;
  for (const Beam& beam : query.beams) {
    const double place = (beam.bearing - query.phase) / kBandBinWidth;
    const auto bin = static_cast<std::size_t>(
        (static_cast<long>(query.is_in_phase ? std::lround(place)
                                             : std::lround(std::floor(place))) +
         static_cast<long>(heading) + 2 * static_cast<long>(kBandBins)) %
        static_cast<long>(kBandBins));
    const std::size_t next = query.is_in_phase ? bin : bin + 1;
    const int near_low = std::min(r.near_low[bin], r.near_low[next]);
    const int near_high = std::max(r.near_high[bin], r.near_high[next]);
    const int wall_low = std::min(r.wall_low[bin], r.wall_low[next]);
    const bool may_be_open = ((r.wall_high[bin] | r.wall_high[next]) & 1) != 0;
    const int wall_high = std::max(r.wall_high[bin], r.wall_high[next]) | (may_be_open ? 1 : 0);
    if (beam.kind == BeamKind::no_return) {
      const int z = units(cost.none_share * beam.range);
      if (r.bands.near_high != nullptr && may_be_open) continue;
      sum += std::clamp(z - wall_high, 0, units(cost.tau_none));
      continue;
    }
    const int z = static_cast<int>(std::lround(beam.range * RangeUnits::kPerMeter));
    sum += std::clamp(near_low - z, 0, units(cost.tau_short));
    sum += std::clamp(z - wall_high, 0, units(cost.tau_long));
    if (r.bands.near_high != nullptr && z >= near_high) {
      sum += std::clamp(wall_low - z, 0, units(cost.tau_open));
    }
  }
  return static_cast<unsigned>(sum);
}

TEST(BandQuery, BoundsAsBeamByBeam) {
  std::mt19937 random(21);
  const RobustCostParams cost{1.2, 2.0, 0.6, 0.3, 0.8};
  for (int i = 0; i < 400; ++i) {
    const bool is_regular = i % 3 != 0;
    std::vector<Beam> beams;
    for (double bearing : is_regular ? regular(-100.0 - 0.01 * i, 1.0, 200 + random() % 161)
                                     : regular(-180.0, 360.0 / 227.0, 227)) {
      const double range = 0.01 * static_cast<double>(random() % 1200) + 0.003;
      const bool no_return = i % 4 == 1 && random() % 5 == 0;
      beams.push_back({bearing * kPi / 180.0, range,
                       no_return           ? BeamKind::no_return
                       : random() % 7 == 0 ? BeamKind::invalid
                                           : BeamKind::hit});
    }
    const BandQuery query(RangeScan(beams), cost);
    ASSERT_EQ(query.is_in_phase, is_regular);
    const RandomBands bands(random, i % 8 < 4);  // with no-returns, and without
    const std::size_t heading = random() % kBandBins;
    EXPECT_EQ(bandCost(bands.bands, query, heading), plainBound(bands, query, heading, cost)) << i;
  }
}

/// No pose of a node costs less than the node's bound.
TEST(BandQuery, BoundsNeverExceedTheCostOfAPose) {
  std::mt19937 random(22);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const RobustCostParams params{1.2, 2.0, 0.6, 0.3, 0.8};
  const RobustCost cost(params);
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const PolygonMap map = floorPlan(randomParams(random), seed);
    const Triangulation triangulation(map);
    const RangePredictor predictor(triangulation, 0.5, 1);
    const CellTree tree(triangulation, predictor, {0.25, 1});
    const BruteForceRays rays(map);
    ScanOptions options;
    options.beams = seed % 2 == 0 ? 360 : 227;
    options.max_range = seed % 3 == 0 ? 4.0 : 80.0;
    options.short_share = 0.2;
    const TPoint2D place = randomFreePoints(map, 1, random).front();
    const BandQuery query(simulatedScan(map, {place.x, place.y, 1.0}, options), params);
    for (int i = 0; i < 300; ++i) {
      const std::size_t cell = random() % tree.nodes(0).size();
      TPoint2D p = tree.middle(cell);
      p += (tree.polygon(cell)[random() % tree.polygonSize(cell)] - p) * (0.999 * unit(random));
      const std::size_t heading = random() % kBandBins;
      const double phi = query.heading(static_cast<double>(heading) + unit(random));
      double sum = 0.0;
      for (const Beam& beam : query.beams) {
        const RayHit hit = rays.cast(p, phi + beam.bearing);
        sum += static_cast<double>(
            cost(beam, static_cast<float>(hit.wall), static_cast<float>(hit.open)));
      }
      EXPECT_LE(query.meters(bandCost(tree.bands(0, cell), query, heading)),
                sum / static_cast<double>(query.beams.size()) + 1e-5);
    }
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
