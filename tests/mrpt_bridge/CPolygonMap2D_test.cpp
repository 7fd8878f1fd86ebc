#include "tests/support/map_factories.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/geometry/geojson.h>
#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>
#include <mrpt_polyloc/mrpt_bridge/registration.h>

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <random>

namespace mrpt_polyloc {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPose3D;

/// What is seen of a map from a pose of the robot, by casting rays one by one.
CObservation2DRangeScan castScan(const PolygonMap& map, double x, double y, double phi) {
  const WallSegments walls(map);
  CObservation2DRangeScan scan;
  scan.aperture = 3.0F;
  scan.maxRange = 80.0F;
  scan.sensorPose = CPose3D(0.3, 0.1, 0, 0.2, 0, 0);
  scan.resizeScanAndAssign(61, 1.0F, true);
  const CPose3D sensor = CPose3D(x, y, 0, phi, 0, 0) + scan.sensorPose;
  for (std::size_t i = 0; i < 61; ++i) {
    const double direction = sensor.yaw() - 1.5 + 0.05 * static_cast<double>(i);
    scan.setScanRange(i, static_cast<float>(walls.range({sensor.x(), sensor.y()}, direction)));
  }
  return scan;
}

PolygonMap room() {
  return test::mapOf({{0, 0}, {10, 0}, {10, 3}, {4, 3}, {4, 8}, {0, 8}});
}

mrpt::maps::TSetOfMetricMapInitializers fromIni(const std::string& text) {
  registerClasses();
  mrpt::config::CConfigFileMemory ini(text);
  mrpt::maps::TSetOfMetricMapInitializers maps;
  maps.loadFromConfigFile(ini, "M");
  return maps;
}

std::string iniFor(const std::string& file, const std::string& options = "") {
  return "[M]\npolygonMap2D_count=1\n[M_polygonMap2D_00_creationOpts]\nfile=" + file +
         "\n[M_polygonMap2D_00_likelihoodOpts]\n" + options + "\n";
}

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
  EXPECT_NEAR(far, -20.0 * 0.6 / 0.1, 1e-3);
  for (std::size_t i = 0; i < 61; ++i) scan.setScanRange(i, std::nanf(""));
  EXPECT_EQ(map.computeObservationLikelihood(scan, CPose3D(2, 2, 0, 0, 0, 0)), 0.0);
  scan.sensorPose = CPose3D(0, 0, 0, 0, 0.5, 0);
  EXPECT_THROW(map.computeObservationLikelihood(scan, CPose3D()), std::invalid_argument);
}

TEST(PolygonMap2D, IsMadeByAnIniCopiedBySerializationAndKeptByClear) {
  const test::TempFile file(".geojson", toGeoJson(room()));
  mrpt::maps::CMultiMetricMap maps(fromIni(iniFor(file.path(), "sigma=0.25\ndecimation=3")));
  const mrpt::maps::CMultiMetricMap copy(maps);
  auto made = copy.mapByClass<CPolygonMap2D>();
  ASSERT_TRUE(made && made->map());
  EXPECT_EQ(made->map()->hash(), room().hash());
  EXPECT_EQ(made->likelihoodOptions.sigma, 0.25);
  EXPECT_EQ(made->likelihoodOptions.decimation, 3U);
  made->loadFromSimpleMap(mrpt::maps::CSimpleMap());
  EXPECT_FALSE(made->isEmpty());
}

TEST(PolygonMap2D, ComplainsOfABadIni) {
  const test::TempFile good(".geojson", toGeoJson(room())), broken(".geojson", "{");
  const auto make = [](const std::string& ini) { mrpt::maps::CMultiMetricMap maps(fromIni(ini)); };
  EXPECT_ANY_THROW(make(iniFor("")));
  EXPECT_ANY_THROW(make(iniFor("/nowhere/map.geojson")));
  EXPECT_ANY_THROW(make(iniFor(broken.path())));
  EXPECT_ANY_THROW(make(iniFor(good.path(), "sigmma=0.2")));
  EXPECT_ANY_THROW(make(iniFor(good.path(), "sigma=-1")));
  EXPECT_NO_THROW(make(iniFor(good.path())));
}

TEST(PolygonMap2D, RefusesWhatANewerVersionStored) {
  registerClasses();
  for (const int newer : {0, 1}) {
    mrpt::io::CMemoryStream stream;
    auto archive = mrpt::serialization::archiveFrom(stream);
    archive << CPolygonMap2D(room());
    // MRPT writes the length of the class's name in one byte, the name, and then the version.
    auto* bytes = static_cast<char*>(stream.getRawBufferData());
    bytes[1 + std::string("mrpt_polyloc::CPolygonMap2D").size()] = static_cast<char>(newer);
    stream.Seek(0);
    if (newer == 0) {
      EXPECT_NO_THROW(archive.ReadObject());
    } else {
      EXPECT_ANY_THROW(archive.ReadObject());
    }
  }
}

TEST(PolygonMap2D, DistanceIsThatToTheNearestWall) {
  const CPolygonMap2D map(room());
  const WallSegments walls(room());
  for (const TPoint2D& p : {TPoint2D(2, 2), TPoint2D(4.5, 3.5), TPoint2D(-3, 9)}) {
    const double d = walls.distance(p);
    EXPECT_NEAR(
        map.squareDistanceToClosestCorrespondence(static_cast<float>(p.x), static_cast<float>(p.y)),
        d * d, 1e-5);
  }
}

}  // namespace
}  // namespace mrpt_polyloc
