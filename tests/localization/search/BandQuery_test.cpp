#include "tests/support/random_maps.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/localization/search/bound_costs.h>
#include <mrpt_polyloc/localization/search/view_cost.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Bands of any kind: with gaps and without, some open, some unbounded.
struct RandomBands {
  RandomBands(std::mt19937& random, bool has_open) {
    for (auto* values : {&near_low, &wall_high, &gap_low, &gap_high}) {
      values->resize(SearchTree::kStride + 1);
    }
    for (std::size_t b = 0; b < kBandBins; ++b) {
      std::vector<int> sorted(4);
      for (int& value : sorted) value = static_cast<int>(random() % 256);
      std::sort(sorted.begin(), sorted.end());
      const bool has_gap = random() % 3 != 0;
      near_low[b] = static_cast<std::uint8_t>(sorted[0]);
      gap_low[b] = static_cast<std::uint8_t>((has_gap ? sorted[1] : 254) & ~1);
      gap_high[b] = static_cast<std::uint8_t>(has_gap ? sorted[2] : 0);
      wall_high[b] = static_cast<std::uint8_t>(random() % 10 == 0 ? 255 : sorted[3]);
      if (has_open && random() % 2 == 0) gap_low[b] |= 1;
    }
    for (auto* values : {&near_low, &wall_high, &gap_low, &gap_high}) {
      for (std::size_t b = kBandBins; b <= SearchTree::kStride; ++b) {
        (*values)[b] = (*values)[b - kBandBins];
      }
    }
    bands = {near_low.data(),
             wall_high.data(),
             gap_low.data(),
             gap_high.data(),
             random() % QuantizedRange::kScales,
             has_open};
  }
  std::vector<std::uint8_t> near_low, wall_high, gap_low, gap_high;
  SearchTree::Bands bands{};
};

/// The bin that a beam meets first at a heading.
std::size_t binOf(const Beam& beam, const BandQuery& query, std::size_t heading) {
  const double place = (beam.bearing - query.phase) / kBandBinWidth;
  const double bin = query.is_in_phase ? std::round(place) : std::floor(place);
  return static_cast<std::size_t>(static_cast<long>(bin) + static_cast<long>(heading) +
                                  2 * static_cast<long>(kBandBins)) %
         kBandBins;
}

/// The lower bound beam by beam, in plain arithmetic on units.
unsigned plainBound(const RandomBands& r, const BandQuery& query, std::size_t heading,
                    const RobustCostParams& cost) {
  const double unit = QuantizedRange::unit(r.bands.scale);
  const auto units = [&](double meters) {
    return std::min(static_cast<int>(std::floor(meters / unit)), QuantizedRange::kGreatest);
  };
  int sum = 0;
  for (const Beam& beam : query.beams) {
    const std::size_t bin = binOf(beam, query, heading);
    const std::size_t next = query.is_in_phase ? bin : bin + 1;
    const bool may_be_open = r.bands.has_open && ((r.gap_low[bin] | r.gap_low[next]) & 1) != 0;
    const int wall_high = std::max(r.wall_high[bin], r.wall_high[next]);
    if (beam.kind == BeamKind::no_return) {
      const int z = units(cost.none_share * beam.range);
      if (!may_be_open) sum += std::clamp(z - wall_high, 0, units(cost.tau_none));
      continue;
    }
    const int below = units(beam.range);
    const int above = std::min(static_cast<int>(std::ceil(beam.range / unit)), 255);
    sum +=
        std::clamp(std::min(r.near_low[bin], r.near_low[next]) - above, 0, units(cost.tau_short));
    sum += std::clamp(below - wall_high, 0, units(cost.tau_long));
    const int past = below - std::max(r.gap_low[bin], r.gap_low[next]);
    const int before = std::min(r.gap_high[bin], r.gap_high[next]) - above;
    const double cap = std::min({cost.tau_short, cost.tau_long, may_be_open ? cost.tau_open : 1e9});
    sum += std::clamp(std::min(past, before), 0, units(cap));
  }
  return static_cast<unsigned>(sum) << r.bands.scale;
}

/// The same of a bin that windows a and b have in common, in plain arithmetic: what both exclude.
int plainCostOfBin(const RandomBands& r, std::size_t a, std::size_t b, const Beam& beam,
                   const RobustCostParams& cost) {
  const double unit = QuantizedRange::unit(r.bands.scale);
  const auto units = [&](double meters) {
    return std::min(static_cast<int>(std::floor(meters / unit)), QuantizedRange::kGreatest);
  };
  const bool may_be_open = r.bands.has_open && (r.gap_low[a] & r.gap_low[b] & 1) != 0;
  const int wall_high = std::min(r.wall_high[a], r.wall_high[b]);
  if (beam.kind == BeamKind::no_return) {
    const int passed = units(cost.none_share * beam.range) - wall_high;
    return may_be_open ? 0 : std::clamp(passed, 0, units(cost.tau_none));
  }
  const int below = units(beam.range);
  const int above = std::min(static_cast<int>(std::ceil(beam.range / unit)), 255);
  const int near_low = std::max(r.near_low[a], r.near_low[b]);
  int low = r.gap_low[a], high = r.gap_high[a];
  if (low < r.gap_high[b] && r.gap_low[b] < high) {
    low = std::min<int>(low, r.gap_low[b]);
    high = std::max<int>(high, r.gap_high[b]);
  } else if (std::max(r.gap_high[b] - r.gap_low[b], 0) > std::max(high - low, 0)) {
    low = r.gap_low[b];
    high = r.gap_high[b];
  }
  const double cap = std::min({cost.tau_short, cost.tau_long, may_be_open ? cost.tau_open : 1e9});
  return std::max({std::clamp(near_low - above, 0, units(cost.tau_short)),
                   std::clamp(below - wall_high, 0, units(cost.tau_long)),
                   std::clamp(std::min(below - low, high - above), 0, units(cap))});
}

unsigned plainBoundOfBin(const RandomBands& r, const BandQuery& query, std::size_t heading,
                         const RobustCostParams& cost) {
  int sum = 0;
  for (const Beam& beam : query.beams) {
    const std::size_t bin = binOf(beam, query, heading);
    const std::size_t before = query.is_in_phase ? (bin + kBandBins - 1) % kBandBins : bin;
    sum += plainCostOfBin(r, before, bin, beam, cost);
  }
  return static_cast<unsigned>(sum) << r.bands.scale;
}

unsigned boundOfBin(const SearchTree::Bands& bands, const BandQuery& query, std::size_t heading) {
  const auto bin = static_cast<std::uint32_t>(heading);
  const std::uint32_t headings[] = {bin, (bin + 31) % 180};
  unsigned bounds[2] = {};
  boundCostsOfBins(bands, query, headings, 2, bounds);
  return bounds[0];
}

unsigned boundOf(const SearchTree::Bands& bands, const BandQuery& query, std::size_t heading) {
  // In the company of others, and none of them changes it.
  const auto bin = static_cast<std::uint32_t>(heading);
  const std::uint32_t headings[] = {(bin + 77) % 180, bin, (bin + 2) % 180};
  unsigned bounds[3] = {};
  boundCosts(bands, query, headings, 3, bounds);
  return bounds[1];
}

TEST(BandQuery, BoundsAsBeamByBeam) {
  std::mt19937 random(21);
  for (int i = 0; i < 800; ++i) {
    // Every other time with caps that bytes do not hold the sums of.
    const RobustCostParams cost =
        i % 16 < 8 ? RobustCostParams{1.2, 2.0, 0.6, 0.3, 0.8} : RobustCostParams{7, 9, 3, 4, 0.8};
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
    ASSERT_EQ(query.has_wide_caps, i % 16 >= 8);
    EXPECT_EQ(boundOf(bands.bands, query, heading), plainBound(bands, query, heading, cost)) << i;
    EXPECT_EQ(boundOfBin(bands.bands, query, heading), plainBoundOfBin(bands, query, heading, cost))
        << i;
  }
}

/// The node of a level that a leaf is in.
std::size_t ancestor(const SearchTree& tree, std::size_t leaf, std::size_t level) {
  for (std::size_t l = 1; l <= level; ++l) {
    std::size_t node = 0;
    while (tree.nodes(l)[node].first_child + tree.nodes(l)[node].child_count <= leaf) ++node;
    leaf = node;
  }
  return leaf;
}

/// No pose of a node costs less than the node's bound.
TEST(BandQuery, BoundsNeverExceedTheCostOfAPose) {
  std::mt19937 random(22);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const RobustCostParams params{1.2, 2.0, 0.6, 0.3, 0.8};
  const RobustCost cost(params);
  std::size_t tighter = 0;
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const PolygonMap map = floorPlan(randomParams(random), seed);
    const Triangulation triangulation(map);
    const RangePredictor predictor(triangulation, 1.0, 1);
    const SearchTree tree(triangulation, predictor, {0.25, 1});
    const BruteForceRays rays(map);
    ScanOptions options;
    options.beams = seed % 2 == 0 ? 360 : 227;
    options.max_range = seed % 3 == 0 ? 4.0 : 80.0;
    options.short_share = 0.2;
    const TPoint2D place = randomFreePoints(map, 1, random).front();
    const BandQuery query(simulatedScan(map, {place.x, place.y, 1.0}, options), params);
    const auto cost_at = [&](const TPoint2D& p, double phi) {
      double sum = 0.0;
      for (const Beam& beam : query.beams) {
        const RayHit hit = rays.cast(p, phi + beam.bearing);
        sum += static_cast<double>(
            cost(beam, static_cast<float>(hit.wall), static_cast<float>(hit.open)));
      }
      return sum / static_cast<double>(query.beams.size());
    };
    for (int i = 0; i < 300; ++i) {
      const std::size_t leaf = random() % tree.nodes(0).size();
      TPoint2D p = tree.middle(leaf);
      p += (tree.polygon(leaf)[random() % tree.polygonSize(leaf)] - p) * (0.999 * unit(random));
      // The leaf, or the block it is in, and any window that holds the heading.
      const std::size_t level = random() % SearchTree::kLevels;
      const std::size_t node = ancestor(tree, leaf, level);
      const std::size_t first = random() % kBandBins;
      const double phi =
          query.heading(static_cast<double>(first) +
                        unit(random) * static_cast<double>(SearchTree::kWindow[level]));
      EXPECT_LE(query.meters(boundOf(tree.bands(level, node), query, first)),
                cost_at(p, phi) + 1e-5);
      // A bin of the leaf's window.
      const double in_bin = query.heading(static_cast<double>(first) + unit(random));
      const unsigned bound = boundOfBin(tree.bands(0, leaf), query, first);
      EXPECT_LE(query.meters(bound), cost_at(p, in_bin) + 1e-5);
      const unsigned of_window = boundOf(tree.bands(0, leaf), query, first);
      EXPECT_GE(bound, of_window);
      tighter += bound > of_window ? 1 : 0;
    }
  }
  EXPECT_GT(tighter, 900U);  // of 1800
}

TEST(BandQuery, AViewCostsWhatItsRangesCost) {
  std::mt19937 random(23);
  const RobustCostParams params{1.2, 2.0, 0.6, 0.3, 0.8};
  const RobustCost cost(params);
  std::vector<std::uint16_t> near(SearchTree::kStride + 1), wall(SearchTree::kStride + 1);
  for (int i = 0; i < 200; ++i) {
    for (std::size_t b = 0; b < near.size(); ++b) {
      wall[b] = static_cast<std::uint16_t>(b < kBandBins ? random() % 1500 : wall[b - kBandBins]);
      const bool is_open = random() % 3 == 0;
      near[b] = b >= kBandBins ? near[b - kBandBins]
                : is_open      ? static_cast<std::uint16_t>(random() % (wall[b] + 1U))
                               : wall[b];
    }
    std::vector<Beam> beams;
    for (const double bearing : regular(-90.0 - 0.01 * i, 1.0, 181)) {
      const double range = 0.01 * static_cast<double>(random() % 1200) + 0.003;
      beams.push_back({bearing * kPi / 180.0, range,
                       i % 2 == 0 && random() % 5 == 0 ? BeamKind::no_return : BeamKind::hit});
    }
    const BandQuery query(RangeScan(beams), params);
    const std::size_t heading = random() % kBandBins;
    double sum = 0.0, clipped = 0.0;
    for (const Beam& beam : query.beams) {
      const std::size_t bin = binOf(beam, query, heading);
      const auto meters = [](unsigned units) {
        return static_cast<float>(units * SearchTree::kViewUnit);
      };
      const bool is_open = near[bin] < wall[bin];
      const auto of_beam = static_cast<double>(
          cost(beam, meters(wall[bin]),
               is_open ? meters(near[bin]) : std::numeric_limits<float>::infinity()));
      sum += of_beam;
      clipped += std::min(of_beam, kMostClipped);
    }
    const ViewCost found = viewCost({near.data(), wall.data()}, query, heading);
    const auto beams_held = static_cast<double>(query.beams.size());
    EXPECT_NEAR(static_cast<double>(found.search), sum / beams_held, 0.01) << i;
    EXPECT_NEAR(static_cast<double>(found.clipped), clipped / beams_held, 0.01) << i;
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
