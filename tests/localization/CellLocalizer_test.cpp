#include "expect_pose.h"
#include "tests/support/constants.h"
#include "tests/support/params_messages.h"
#include "tests/support/random_maps.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/CellLocalizer.h>
#include <mrpt_polyloc/localization/nearest_cells/ViewIndex.h>
#include <mrpt_polyloc/localization/nearest_cells/cell_views.h>
#include <mrpt_polyloc/localization/nearest_cells/scan_view.h>
#include <mrpt_polyloc/polar/PolarMetric.h>
#include <mrpt_polyloc/visibility/VisibilityCells.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;
using ::testing::HasSubstr;

const CellLocalizer& inAsymmetricRoom() {
  static const CellLocalizer localizer(asymmetricRoom());
  return localizer;
}

TEST(CellLocalizer, FindsCleanScans) {
  for (const TPose2D& truth :
       {TPose2D(1.52, 2.13, 0.3), TPose2D(6.3, 1.1, -2.0), TPose2D(3.71, 4.46, kPi)}) {
    const auto result = inAsymmetricRoom().localize(simulatedScan(asymmetricRoom(), truth));
    EXPECT_EQ(result.status, LocalizationStatus::unique);
    expectFirstIs(result, truth);
    EXPECT_LT(result.hypotheses[0].cost, 0.01);
    EXPECT_GT(result.statistics.refined, 0U);
    EXPECT_LE(result.statistics.refined, CellLocalizerParams{}.max_candidates);
    EXPECT_LE(result.statistics.evaluated, result.statistics.positions);
    EXPECT_EQ(result.statistics.positions, inAsymmetricRoom().viewpoints().size());
  }
}

TEST(CellLocalizer, FindsRandomPosesInRandomPlans) {
  std::mt19937 random(51);
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    FloorPlanParams params = smallFlat();
    params.furniture_per_room = 1;
    const PolygonMap map = floorPlan(params, seed);
    const CellLocalizer localizer(map);
    for (const TPoint2D& p : randomFreePoints(map, 5, random)) {
      const TPose2D truth(p.x, p.y, 0.01 * static_cast<double>(random() % 628) - kPi);
      const auto result = localizer.localize(simulatedScan(map, truth));
      EXPECT_TRUE(holdsPose(result, truth)) << "seed " << seed << " " << truth.asString();
    }
  }
}

// The oracle: views from the exact visibility polygons, compared one by one.
TEST(CellLocalizer, ComparesWithTheCellsThatALinearScanFindsNearest) {
  const PolygonMap map = asymmetricRoom();
  const CellLocalizer& localizer = inAsymmetricRoom();
  const VisibilityCells cells(map);
  EXPECT_EQ(localizer.cellCount(), cells.size());
  ViewExpander expander(cells.triangulation());
  std::vector<SampledPolarFunction> views;
  for (const TPoint2D& p : localizer.viewpoints()) {
    const auto polygon = visibilityPolygon(cells.triangulation(), expander.expand(p));
    views.emplace_back(PolarFunction::fromPolygon(polygon, p, 20.0), 180);
  }
  for (const TPose2D& pose : {TPose2D(1.52, 2.13, 0.3), TPose2D(6.3, 1.1, -2.0)}) {
    const auto scan = viewOfScan(simulatedScan(map, pose));
    std::vector<double> distances;
    for (const auto& view : views)
      distances.push_back(distanceOverRotations(scan->samples, view).distance);
    const auto nearest = localizer.views().nearest({scan->samples, {}, kInfinity, {}}, 50);
    std::vector<double> sorted = distances;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      // Predicted in single precision, and a ray may pass a vertex on either side.
      EXPECT_NEAR(nearest[i].distance, distances[nearest[i].view], 0.3);
      EXPECT_NEAR(nearest[i].distance, sorted[i], 0.1);
    }
  }
}

TEST(CellLocalizer, ViewsCoverEveryCell) {
  const PolygonMap map = floorPlan(smallFlat(), 2);
  const VisibilityCells cells(map);
  constexpr double kSpacing = 0.5;
  const std::vector<TPoint2D> viewpoints = cellViewpoints(cells, kSpacing);
  std::vector<std::vector<TPoint2D>> in_cell(cells.size());
  for (const TPoint2D& p : viewpoints) {
    const std::int32_t cell = cells.locate(p);
    ASSERT_NE(cell, VisibilityCells::kNone);
    in_cell[static_cast<std::size_t>(cell)].push_back(p);
  }
  std::mt19937 random(52);
  for (const TPoint2D& p : randomFreePoints(map, 300, random)) {
    double nearest = kInfinity;  // of any cell: by the border the next one's is as good
    for (const TPoint2D& v : viewpoints)
      nearest = std::min(nearest, std::hypot(v.x - p.x, v.y - p.y));
    EXPECT_LT(nearest, kSpacing);
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells.area(c) > 1e-7) {
      EXPECT_FALSE(in_cell[c].empty()) << c << cells.locate(cells.representative(c));
    }
  }
}

TEST(CellLocalizer, HonoursTheCompass) {
  const PolygonMap square = squareMap(6.0);
  const CellLocalizer localizer(square);
  const TPose2D truth(1.5, 2.2, 0.4);
  const RangeScan scan = simulatedScan(square, truth);
  const auto all = localizer.localize(scan);
  EXPECT_EQ(all.status, LocalizationStatus::ambiguous);
  for (int quarter = 0; quarter < 4; ++quarter) {  // the room's symmetry
    const double c = std::cos(quarter * kPi / 2), s = std::sin(quarter * kPi / 2);
    const double x = truth.x - 3, y = truth.y - 3;
    EXPECT_TRUE(
        holdsPose(all, {3 + c * x - s * y, 3 + s * x + c * y, truth.phi + quarter * kPi / 2}))
        << quarter;
  }
  for (const double tolerance : {0.0, 0.1, 1.0}) {
    PosePrior prior;
    prior.compass = PosePrior::Compass{truth.phi, tolerance};
    const auto result = localizer.localize(scan, prior);
    EXPECT_EQ(result.status, LocalizationStatus::unique) << tolerance;
    expectFirstIs(result, truth);
    prior.compass->heading += kPi / 2;
    EXPECT_FALSE(holdsPose(localizer.localize(scan, prior), truth)) << tolerance;
  }
}

TEST(CellLocalizer, HonoursNearness) {
  const PolygonMap square = squareMap(6.0);
  const CellLocalizer localizer(square);
  ScanOptions options;
  options.sensor = {0.4, 0.1};
  const TPose2D truth(1.5, 2.2, 0.4);
  PosePrior prior;
  prior.near = PosePrior::Disk{1.6, 2.0, 0.5};
  const auto result = localizer.localize(simulatedScan(square, truth, options), prior);
  EXPECT_EQ(result.status, LocalizationStatus::unique);
  expectFirstIs(result, truth);
  prior.near = PosePrior::Disk{100.0, 0.0, 0.5};
  EXPECT_EQ(localizer.localize(simulatedScan(square, truth), prior).status,
            LocalizationStatus::no_match);
}

TEST(CellLocalizer, SensorsOfAllKindsAreBorne) {
  const TPose2D truth(1.2, 1.1, 0.5);
  ScanOptions half;
  half.field_of_view = kPi;
  half.beams = 181;
  expectFirstIs(inAsymmetricRoom().localize(simulatedScan(asymmetricRoom(), truth, half)), truth);
  ScanOptions few = half;
  few.beams = 40;
  few.sensor = {0.1, -0.2};
  expectFirstIs(inAsymmetricRoom().localize(simulatedScan(asymmetricRoom(), truth, few)), truth);
  ScanOptions noisy;
  noisy.sigma = 0.02;
  noisy.short_share = 0.1;
  expectFirstIs(inAsymmetricRoom().localize(simulatedScan(asymmetricRoom(), truth, noisy)), truth,
                0.05);
  ScanOptions shortsighted;  // sees some walls all around, others never
  shortsighted.max_range = 3.0;
  const RangeScan scan = simulatedScan(asymmetricRoom(), truth, shortsighted);
  ASSERT_GT(scan.noReturnCount(), 50U);
  EXPECT_TRUE(holdsPose(inAsymmetricRoom().localize(scan), truth));
}

TEST(CellLocalizer, ScansThatSayTooLittleAreAStatus) {
  for (const std::size_t beams : {0U, 1U, 14U}) {
    ScanOptions options;
    options.beams = beams;
    const auto result =
        inAsymmetricRoom().localize(simulatedScan(asymmetricRoom(), {1.2, 1.1, 0}, options));
    EXPECT_EQ(result.status, LocalizationStatus::too_few_beams);
    EXPECT_TRUE(result.hypotheses.empty());
  }
  // All in one direction.
  const std::vector<Beam> beams(30, {0.5, 2.0, BeamKind::hit});
  EXPECT_EQ(inAsymmetricRoom().localize(RangeScan(beams)).status,
            LocalizationStatus::too_few_beams);
  const auto elsewhere = simulatedScan(windmillMap(), {0.3, 0.4, 0.2});
  EXPECT_EQ(inAsymmetricRoom().localize(elsewhere).status, LocalizationStatus::no_match);
}

TEST(CellLocalizer, WorksOnMapsWithOpenEdgesAndWallsBeyond) {
  FloorPlanParams params = smallFlat();
  params.unknown_share = 0.5;
  const PolygonMap map = floorPlan(params, 4);
  const CellLocalizer localizer(map);
  std::mt19937 random(53);
  std::size_t found = 0;
  constexpr std::size_t kScans = 10;
  for (const TPoint2D& p : randomFreePoints(map, kScans, random)) {
    const TPose2D truth(p.x, p.y, 0.5);
    found += holdsPose(localizer.localize(simulatedScan(map, truth)), truth) ? 1 : 0;
  }
  EXPECT_GE(found, kScans - 1);
}

TEST(CellLocalizer, LimitsTheRangeWhereTheBudgetIsExceeded) {
  const PolygonMap map = pillarMap(4, 3);
  CellLocalizerParams params;
  const CellLocalizer unlimited(map, params);
  EXPECT_TRUE(std::isinf(unlimited.cellRange()));
  params.max_cells = unlimited.cellCount() / 4;
  const CellLocalizer limited(map, params);
  EXPECT_LT(limited.cellRange(), 16.0);
  EXPECT_LE(limited.cellCount(), params.max_cells);
  const TPose2D truth(4.3, 1.2, 0.3);
  EXPECT_TRUE(holdsPose(limited.localize(simulatedScan(map, truth)), truth));
  params.range = kInfinity;
  EXPECT_THROW(CellLocalizer(map, params), CellBudgetError);
  params.range = limited.cellRange();
  EXPECT_EQ(CellLocalizer(map, params).cellCount(), limited.cellCount());
  params.range = std::nullopt;
  params.max_cells = 2;
  EXPECT_THROW(CellLocalizer(map, params), CellBudgetError);
}

TEST(CellLocalizer, DoesNotDependOnThreads) {
  const PolygonMap map = floorPlan(smallFlat(), 3);
  CellLocalizerParams params;
  params.threads = 1;
  const CellLocalizer one(map, params);
  params.threads = 3;
  const CellLocalizer three(map, params);
  EXPECT_EQ(one.indexBytes(), three.indexBytes());
  EXPECT_GT(one.indexBytes(), one.viewpoints().size() * 180 * 8);
  std::mt19937 random(54);
  for (const TPoint2D& p : randomFreePoints(map, 5, random)) {
    const RangeScan scan = simulatedScan(map, {p.x, p.y, 1.0});
    const auto a = one.localize(scan), b = three.localize(scan);
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.statistics.evaluated, b.statistics.evaluated);
    ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size());
    for (std::size_t i = 0; i < a.hypotheses.size(); ++i) {
      EXPECT_EQ(a.hypotheses[i].pose_map_robot, b.hypotheses[i].pose_map_robot);
      EXPECT_EQ(a.hypotheses[i].weight, b.hypotheses[i].weight);
    }
  }
}

TEST(CellLocalizer, BadParamsAreNamed) {
  const auto complaint = [](auto&& spoil) {
    CellLocalizerParams params;
    spoil(params);
    return complaintOf(params);
  };
  EXPECT_EQ(complaint([](auto&) {}), "");
  EXPECT_EQ(complaint([](auto& p) { p.range = kInfinity; }), "");
  EXPECT_THAT(complaint([](auto& p) { p.range = -1.0; }), HasSubstr("range"));
  EXPECT_THAT(complaint([](auto& p) { p.range = std::nan(""); }), HasSubstr("range"));
  EXPECT_THAT(complaint([](auto& p) { p.max_cells = 0; }), HasSubstr("max_cells"));
  EXPECT_THAT(complaint([](auto& p) { p.spacing = 0.0; }), HasSubstr("spacing"));
  EXPECT_THAT(complaint([](auto& p) { p.view.samples = 7; }), HasSubstr("samples"));
  EXPECT_THAT(complaint([](auto& p) { p.max_candidates = 0; }), HasSubstr("max_candidates"));
  EXPECT_THAT(complaint([](auto& p) { p.distance_share = 0.5; }), HasSubstr("distance_share"));
  EXPECT_THAT(complaint([](auto& p) { p.distance_margin = -1; }), HasSubstr("distance_margin"));
  EXPECT_THAT(complaint([](auto& p) { p.threads = -1; }), HasSubstr("threads"));
  EXPECT_THROW(inAsymmetricRoom().localize(simulatedScan(asymmetricRoom(), {1, 1, 0}),
                                           {PosePrior::Compass{0.0, 4.0}, {}}),
               InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc::test
