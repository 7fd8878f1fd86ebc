#include "map_scenes.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/io/geojson.h>
#include <mrpt_polyloc/localization/scan/RobustCost.h>
#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>

#include <gmock/gmock.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPose2D.h>

#include <cmath>
#include <random>
#include <thread>

namespace mrpt_polyloc {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPose3D;
using test::castScan;
using test::partlyOpenRoom;
using test::room;

TEST(PolygonMap2D, LikelihoodIsTheSumOverRaysCastOneByOne) {
  const PolygonMap polygons = room();
  CPolygonMap2D map(polygons);
  map.likelihoodOptions.independent_beams = 10;
  const auto scan = castScan(polygons, 2, 2, 0.5);
  EXPECT_NEAR(map.computeObservationLikelihood(scan, CPose3D(2, 2, 0, 0.5, 0, 0)), 0.0, 1e-2);
  const RobustCost cost;
  const float none = std::numeric_limits<float>::infinity();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> offset(-0.8, 0.8);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const CPose3D pose(2 + offset(random), 2 + offset(random), 0, offset(random), 0, 0);
    const auto seen = castScan(polygons, pose.x(), pose.y(), pose.yaw());
    double robust = 0.0, polar = 0.0;
    for (std::size_t i = 0; i < 61; ++i) {
      const float z = scan.getScanRange(i), w = seen.getScanRange(i);
      robust += static_cast<double>(cost.hit(z, w, none)) / 61.0;
      const double d = std::min(static_cast<double>(std::abs(z - w)), 0.6);
      polar += d * d / 61.0;
    }
    map.likelihoodOptions.metric = "robust";
    EXPECT_NEAR(map.computeObservationLikelihood(scan, pose), -10.0 * robust / 0.1, 0.02);
    map.likelihoodOptions.metric = "polar";
    EXPECT_NEAR(map.computeObservationLikelihood(scan, pose), -10.0 * polar / 0.02, 0.1);
  }
}

TEST(PolygonMap2D, SeesThatAnObservationChangedInPlace) {
  CPolygonMap2D map(room());
  auto scan = castScan(room(), 2, 2, 0.5);
  const CPose3D pose(2, 2, 0, 0.5, 0, 0);
  const double before = map.computeObservationLikelihood(scan, pose);
  for (std::size_t i = 0; i < 61; ++i) scan.setScanRange(i, 0.5F);
  EXPECT_LT(map.computeObservationLikelihood(scan, pose), before - 10.0);
}

TEST(PolygonMap2D, IsFiniteForScansAndPosesThatSayNothing) {
  CPolygonMap2D map(room());
  auto scan = castScan(room(), 2, 2, 0.5);
  EXPECT_EQ(map.computeObservationLikelihood(CObservation2DRangeScan(), CPose3D()), 0.0);
  const double far = map.computeObservationLikelihood(scan, CPose3D(1e6, 0, 0, 0, 0, 0));
  EXPECT_NEAR(far, -map.likelihoodOptions.independent_beams * 0.6 / map.likelihoodOptions.sigma,
              1e-3);
  // Readings that are no ranges say nothing; of a scan that has some, the others count.
  const CPose3D pose(2, 2, 0, 0.5, 0, 0);
  const float none[] = {std::nanf(""), -0.0F, -HUGE_VALF, -1.0F, 0.0F};
  for (std::size_t i = 0; i < 61; i += 2) scan.setScanRange(i, none[i / 2 % 5]);
  EXPECT_NEAR(map.computeObservationLikelihood(scan, pose), 0.0, 1e-2);
  EXPECT_LT(map.computeObservationLikelihood(scan, CPose3D(2.3, 2, 0, 0.5, 0, 0)), -1.0);
  for (std::size_t i = 0; i < 61; ++i) scan.setScanRange(i, none[i % 5]);
  for (const char* metric : {"robust", "polar"}) {
    map.likelihoodOptions.metric = metric;
    EXPECT_EQ(map.computeObservationLikelihood(scan, pose), 0.0);
    EXPECT_EQ(map.computeLikelihoods(scan, {{2, 2, 0.5}}), std::vector<double>{0.0});
  }
}

TEST(PolygonMap2D, SaysNothingWhereMrptsOptionForbidsIt) {
  CPolygonMap2D map(room());
  const auto scan = castScan(room(), 2, 2, 0.5);
  const CPose3D elsewhere(3, 1, 0, 1.5, 0, 0), nowhere(std::nan(""), 0, 0, 0, 0, 0);
  EXPECT_LT(map.computeObservationLikelihood(scan, elsewhere), -10.0);
  EXPECT_NEAR(map.computeObservationLikelihood(scan, nowhere),
              -map.likelihoodOptions.independent_beams * 0.6 / map.likelihoodOptions.sigma, 1e-3);
  map.genericMapParams.enableObservationLikelihood = false;
  EXPECT_EQ(map.computeObservationLikelihood(scan, elsewhere), 0.0);
}

TEST(PolygonMap2D, RefusesASensorThatIsNotPlanar) {
  const CPolygonMap2D map(room());
  auto scan = castScan(room(), 2, 2, 0.5);
  const auto complaint = [&] {
    return test::messageOf<std::invalid_argument>(
        [&] { map.computeObservationLikelihood(scan, CPose3D()); });
  };
  for (const CPose3D& tilted : {CPose3D(0, 0, 0, 0, 0.5, 0), CPose3D(0, 0, 0, 0, 0, 0.2)}) {
    scan.sensorPose = tilted;
    EXPECT_THAT(complaint(), testing::HasSubstr("tilted"));
    EXPECT_THROW(map.computeLikelihoods(scan, {{0, 0, 0}}), std::invalid_argument);
  }
  scan.sensorPose = CPose3D(std::nan(""), 0, 0, 0, 0, 0);
  EXPECT_THROW(map.computeObservationLikelihood(scan, CPose3D()), std::invalid_argument);
}

TEST(PolygonMap2D, ThePolarMetricIsAMeanOverTheHits) {
  CPolygonMap2D map(room());
  map.likelihoodOptions.metric = "polar";
  auto scan = castScan(room(), 2, 2, 0.5);
  for (std::size_t i = 0; i < 61; ++i) scan.setScanRange(i, scan.getScanRange(i) + 0.1F);
  const CPose3D pose(2, 2, 0, 0.5, 0, 0);
  const double all = map.computeObservationLikelihood(scan, pose);
  EXPECT_NEAR(all, -map.likelihoodOptions.independent_beams * 0.01 / 0.02, 0.01);
  for (std::size_t i = 0; i < 30; ++i) scan.setScanRangeValidity(i, false);  // no-returns
  EXPECT_NEAR(map.computeObservationLikelihood(scan, pose), all, 0.01);
  for (std::size_t i = 30; i < 61; ++i) scan.setScanRangeValidity(i, false);
  EXPECT_EQ(map.computeObservationLikelihood(scan, pose), 0.0);
}

TEST(PolygonMap2D, DistanceIsThatToTheNearestWall) {
  for (const PolygonMap& polygons : {room(), partlyOpenRoom()}) {
    const CPolygonMap2D map(polygons);
    const WallSegments walls(polygons);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> anywhere(-4.0F, 16.0F);
    for (int i = 0; i < 500; ++i) {
      const float x = anywhere(random), y = anywhere(random);
      const double d = walls.distance({static_cast<double>(x), static_cast<double>(y)});
      EXPECT_NEAR(map.squareDistanceToClosestCorrespondence(x, y), d * d, 1e-5 * (1.0 + d * d));
    }
    EXPECT_TRUE(std::isinf(map.squareDistanceToClosestCorrespondence(std::nanf(""), 0.0F)));
  }
  EXPECT_TRUE(std::isinf(CPolygonMap2D().squareDistanceToClosestCorrespondence(0.0F, 0.0F)));
}

TEST(PolygonMap2D, PairsPointsWithTheNearestWalls) {
  const PolygonMap polygons = partlyOpenRoom();
  const CPolygonMap2D map(polygons);
  const WallSegments walls(polygons);
  mrpt::maps::CSimplePointsMap points;
  std::mt19937 random(2);
  std::uniform_real_distribution<float> anywhere(-2.0F, 14.0F);
  for (int i = 0; i < 400; ++i) points.insertPoint(anywhere(random), anywhere(random), 0.7F);
  const mrpt::poses::CPose2D pose(1.0, -0.5, 0.4);
  mrpt::maps::TMatchingParams params;
  params.maxDistForCorrespondence = 0.4F;
  params.maxAngularDistForCorrespondence = 0.02F;
  params.angularDistPivotPoint = {2, 2, 0};
  params.decimation_other_map_points = 2;
  params.offset_other_map_points = 1;
  mrpt::tfest::TMatchingPairList pairs;
  mrpt::maps::TMatchingExtraResults results;
  map.determineMatching2D(&points, pose, pairs, params, results);

  // By brute force: which points have a wall in reach.
  std::size_t next = 0, near_all = 0;
  double squares = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    mrpt::math::TPoint3D local;
    points.getPoint(i, local);
    const auto global = CPose3D(pose).composePoint(local);
    const double distance = walls.distance({global.x, global.y});
    near_all += distance <= 0.4;
    const double reach = 0.4 + 0.02 * params.angularDistPivotPoint.distanceTo(global);
    if (i % 2 == 0 || distance > reach) continue;
    ASSERT_LT(next, pairs.size());
    const auto& pair = pairs[next++];
    EXPECT_EQ(pair.localIdx, i);
    EXPECT_NEAR(pair.local.x, local.x, 1e-5);
    const mrpt::math::TPoint3D on_wall(pair.global);
    EXPECT_NEAR(walls.distance({on_wall.x, on_wall.y}), 0.0, 1e-5);
    EXPECT_NEAR(on_wall.distanceTo(global), distance, 1e-4);  // heights are equal
    EXPECT_NEAR(pair.errorSquareAfterTransformation, distance * distance, 1e-5);
    squares += distance * distance;
  }
  EXPECT_EQ(pairs.size(), next);
  EXPECT_GT(next, 20U);
  EXPECT_FLOAT_EQ(results.correspondencesRatio, static_cast<float>(next) / 200.0F);
  EXPECT_NEAR(results.sumSqrDist, squares, 1e-3 * squares);

  mrpt::maps::TMatchingRatioParams ratio;
  ratio.maxDistForCorr = 0.4F;
  EXPECT_NEAR(map.compute3DMatchingRatio(&points, CPose3D(pose), ratio),
              static_cast<float>(near_all) / 400.0F, 0.0026);  // 0.4 as float: one point's worth
}

TEST(PolygonMap2D, MatchesPointsMapsOnly) {
  const CPolygonMap2D map(room());
  mrpt::tfest::TMatchingPairList pairs;
  mrpt::maps::TMatchingExtraResults results;
  EXPECT_THROW(map.determineMatching2D(&map, {}, pairs, {}, results), std::invalid_argument);
  EXPECT_THROW(map.compute3DMatchingRatio(&map, {}, {}), std::invalid_argument);
  for (const CPolygonMap2D& any : {map, CPolygonMap2D()}) {
    EXPECT_THROW(any.determineMatching2D(nullptr, {}, pairs, {}, results), std::invalid_argument);
    EXPECT_THROW(any.determineMatching3D(nullptr, {}, pairs, {}, results), std::invalid_argument);
    EXPECT_THROW(any.compute3DMatchingRatio(nullptr, {}, {}), std::invalid_argument);
  }
  // The messages say what was given.
  const auto complaint = [&](const mrpt::maps::CMetricMap* other) {
    return test::messageOf<std::invalid_argument>(
        [&] { map.determineMatching2D(other, {}, pairs, {}, results); });
  };
  EXPECT_THAT(complaint(nullptr), testing::HasSubstr("null"));
  EXPECT_THAT(complaint(&map), testing::HasSubstr("points maps only, not mrpt_polyloc::"));
  const mrpt::maps::CSimplePointsMap none;
  map.determineMatching2D(&none, {}, pairs, {}, results);
  EXPECT_TRUE(pairs.empty());
  EXPECT_EQ(results.correspondencesRatio, 0.0F);
  EXPECT_EQ(map.compute3DMatchingRatio(&none, {}, {}), 0.0F);
  CPolygonMap2D().determineMatching2D(&map, {}, pairs, {}, results);  // nothing to match with
  EXPECT_TRUE(pairs.empty());
}

TEST(PolygonMap2D, LikelihoodsAreTheSameFromSeveralThreads) {
  const PolygonMap polygons = room();
  const CPolygonMap2D map(polygons);
  const CObservation2DRangeScan scans[] = {castScan(polygons, 2, 1, 0.3),
                                           castScan(polygons, 2, 6, -2.0)};
  std::vector<CPose3D> poses;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 400; ++i) {
    poses.emplace_back(10 * unit(random), 8 * unit(random), 0, 6 * unit(random), 0, 0);
  }
  const auto weigh = [&](std::size_t offset) {
    std::vector<double> weights(poses.size());
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const std::size_t i = (k + offset) % poses.size();
      weights[i] = map.computeObservationLikelihood(scans[i % 2], poses[i]);
    }
    return weights;
  };
  const std::vector<double> expected = weigh(0);
  std::vector<std::vector<double>> found(4);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < found.size(); ++t) {
    threads.emplace_back([&, t] { found[t] = weigh(97 * t); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& weights : found) EXPECT_EQ(weights, expected);
}

TEST(PolygonMap2D, ManyPosesAtOnceAreWeighedAsOneByOne) {
  const PolygonMap polygons = partlyOpenRoom();
  CPolygonMap2D map(polygons);
  const CObservation2DRangeScan scan = castScan(polygons, 2, 1, 0.3);
  std::vector<mrpt::math::TPose2D> poses;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    poses.emplace_back(14 * unit(random) - 2, 10 * unit(random) - 2, 6 * unit(random));
  }
  for (const char* metric : {"robust", "polar"}) {
    map.likelihoodOptions.metric = metric;
    const std::vector<double> found = map.computeLikelihoods(scan, poses);
    ASSERT_EQ(found.size(), poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      EXPECT_EQ(found[i], map.computeObservationLikelihood(scan, CPose3D(poses[i])));
    }
  }
  EXPECT_TRUE(map.computeLikelihoods(scan, {}).empty());
  EXPECT_EQ(CPolygonMap2D().computeLikelihoods(scan, poses), std::vector<double>(300, 0.0));
}

TEST(PolygonMap2D, BoundingBoxHoldsTheWallsBeyond) {
  const auto box = CPolygonMap2D(partlyOpenRoom()).boundingBox();
  EXPECT_EQ(box.min, mrpt::math::TPoint3Df(0, 0, 0));
  EXPECT_EQ(box.max, mrpt::math::TPoint3Df(13, 6, 0));
  EXPECT_EQ(CPolygonMap2D().boundingBox().max, mrpt::math::TPoint3Df(0, 0, 0));
}

TEST(PolygonMap2D, ShowsItselfAsLinesAndSavesItselfAsGeoJson) {
  const PolygonMap polygons = partlyOpenRoom();
  const CPolygonMap2D map(polygons);
  drawn::CSetOfObjects scene;
  map.getVisualizationInto(scene);
  std::vector<std::size_t> counts;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto lines = scene.getByClass<drawn::CSetOfLines>(i);
    ASSERT_TRUE(lines);
    counts.push_back(lines->size());
  }
  EXPECT_EQ(counts, (std::vector<std::size_t>{7, 1, 2}));  // walls, open edges, walls beyond
  EXPECT_NE(map.asString(), CPolygonMap2D().asString());

  const test::TempFile file(".geojson", "");
  const std::string prefix = file.path().substr(0, file.path().size() - 8);
  map.saveMetricMapRepresentationToFile(prefix);
  EXPECT_EQ(toGeoJson(loadMap(prefix + ".geojson").map), toGeoJson(polygons));
  EXPECT_THROW(map.saveMetricMapRepresentationToFile("/no/such/folder/map"), std::runtime_error);
}

}  // namespace
}  // namespace mrpt_polyloc
