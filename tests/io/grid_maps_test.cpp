#include "tests/support/bridge_files.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/grid_maps.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFile.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <filesystem>

namespace mrpt_polyloc {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::maps::CSimpleMap;
using test::formatErrorOf;
using testing::AllOf;
using testing::HasSubstr;

CellState expectedState(double free) {
  if (1.0 - free > 0.65) return CellState::occupied;
  return 1.0 - free < 0.196 ? CellState::free : CellState::unknown;
}

class GridMaps : public test::QuietTest {
 protected:
  std::string gridErrorOf(const std::string& bytes) {
    test::writeFile(grid_path_, bytes);
    return formatErrorOf([&] { loadGridMap(grid_path_); });
  }
  std::string simpleErrorOf(const std::string& bytes) {
    test::writeFile(simple_path_, bytes);
    return formatErrorOf([&] { loadSimpleMap(simple_path_); });
  }
  /// A scan of a square room taken at each of these poses.
  static CSimpleMap roomMap(const std::vector<mrpt::poses::CPose3D>& poses) {
    CSimpleMap map;
    for (const auto& pose : poses) {
      mrpt::obs::CObservation2DRangeScan scan;
      scan.aperture = 3.0F;
      scan.maxRange = 80.0F;
      scan.resizeScanAndAssign(181, 3.0F, true);
      for (std::size_t i = 0; i < 40; ++i) {
        scan.setScanRange(i, 79.0F);
        scan.setScanRangeValidity(i, false);
      }
      const auto frame = mrpt::obs::CSensoryFrame::Create();
      frame->insert(mrpt::obs::CObservation2DRangeScan::Create(scan));
      frame->insert(mrpt::obs::CObservationOdometry::Create());
      map.insert(mrpt::poses::CPose3DPDFGaussian::Create(pose), frame);
    }
    return map;
  }

  std::string grid_path_ = dir_.file("test.gridmap");
  std::string simple_path_ = dir_.file("test.simplemap");
};

TEST_F(GridMaps, ReadsTheCellsOfAGridmap) {
  std::mt19937 random(41);
  COccupancyGridMap2D grid(-2.0F, 3.0F, 1.0F, 2.5F, 0.05F);
  std::uniform_real_distribution<float> free(0.01F, 0.99F);
  for (int x = 0; x < static_cast<int>(grid.getSizeX()); ++x) {
    for (int y = 0; y < static_cast<int>(grid.getSizeY()); ++y) grid.setCell(x, y, free(random));
  }
  for (const std::string& bytes : {test::serialised(grid), test::gzipped(test::serialised(grid))}) {
    ASSERT_EQ(gridErrorOf(bytes), "");
    const auto bitmap = loadGridMap(grid_path_);
    ASSERT_EQ(bitmap.width, static_cast<int>(grid.getSizeX()));
    ASSERT_EQ(bitmap.height, static_cast<int>(grid.getSizeY()));
    EXPECT_NEAR(bitmap.resolution, 0.05, 1e-8);
    EXPECT_EQ(bitmap.pose_map_bitmap.x, static_cast<double>(grid.getXMin()));
    EXPECT_EQ(bitmap.pose_map_bitmap.y, static_cast<double>(grid.getYMin()));
    EXPECT_EQ(bitmap.pose_map_bitmap.phi, 0.0);
    for (int x = 0; x < bitmap.width; ++x) {
      for (int y = 0; y < bitmap.height; ++y) {
        ASSERT_EQ(bitmap.at(x, y), expectedState(static_cast<double>(grid.getCell(x, y))));
      }
    }
  }
}

// The demo's ini of the Debian package mrpt-common is the oracle for the insertion options.
TEST_F(GridMaps, InsertsASimplemapAsTheDemoOfPfLocalization) {
  const std::string ini = "/usr/share/mrpt/config_files/pf-localization/localization_demo.ini";
  if (!std::filesystem::exists(ini)) GTEST_SKIP() << "mrpt-common is not installed";
  std::vector<mrpt::poses::CPose3D> poses;
  for (int repeat = 0; repeat < 5; ++repeat) {  // one scan alone makes no cell sure
    poses.insert(poses.end(), {{0, 0, 0, 0.3, 0, 0}, {1, 2, 0, 2, 0, 0}, {14, 3, 0, 4, 0, 0}});
  }
  const auto map = roomMap(poses);
  ASSERT_EQ(simpleErrorOf(test::gzipped(test::serialised(map))), "");
  const auto bitmap = loadSimpleMap(simple_path_);

  COccupancyGridMap2D grid(-10.0F, 10.0F, -10.0F, 10.0F, 0.05F);
  grid.insertionOptions.loadFromConfigFile(mrpt::config::CConfigFile(ini),
                                           "MetricMap_occupancyGrid_00_insertOpts");
  grid.loadFromSimpleMap(map);
  ASSERT_EQ(bitmap.width, static_cast<int>(grid.getSizeX()));
  ASSERT_EQ(bitmap.height, static_cast<int>(grid.getSizeY()));
  int counts[3] = {0, 0, 0};
  for (int x = 0; x < bitmap.width; ++x) {
    for (int y = 0; y < bitmap.height; ++y) {
      ASSERT_EQ(bitmap.at(x, y), expectedState(static_cast<double>(grid.getCell(x, y))));
      ++counts[static_cast<int>(bitmap.at(x, y))];
    }
  }
  for (const int count : counts) EXPECT_GT(count, 100);
  EXPECT_EQ(bitmap.at(static_cast<int>((1.0 - bitmap.pose_map_bitmap.x) / 0.05),
                      static_cast<int>((2.0 - bitmap.pose_map_bitmap.y) / 0.05)),
            CellState::free);
}

TEST_F(GridMaps, RefusesAnotherClassAndWhatFollows) {
  const std::string grid = test::serialised(COccupancyGridMap2D(0, 1, 0, 1, 0.1F));
  const std::string simple = test::serialised(roomMap({{0, 0, 0, 0, 0, 0}}));
  EXPECT_THAT(gridErrorOf(simple),
              AllOf(HasSubstr("test.gridmap: object 0"), HasSubstr("CSimpleMap"),
                    HasSubstr("COccupancyGridMap2D is expected")));
  EXPECT_THAT(simpleErrorOf(grid),
              AllOf(HasSubstr("test.simplemap: object 0"), HasSubstr("CSimpleMap is expected")));
  EXPECT_THAT(gridErrorOf(grid + grid), HasSubstr("follows"));
  EXPECT_THAT(gridErrorOf("P5 1 1 255\nx"), HasSubstr("object 0"));
  EXPECT_THAT(simpleErrorOf(""), HasSubstr("empty file"));
}

TEST_F(GridMaps, RefusesEveryTruncation) {
  const std::string grid = test::serialised(COccupancyGridMap2D(0, 1, 0, 1, 0.1F));
  const std::string simple = test::serialised(roomMap({{0, 0, 0, 0, 0, 0}}));
  for (const std::string& whole : {grid, test::gzipped(grid)}) {
    for (std::size_t size = 0; size < whole.size(); size += 1 + size / 50) {
      ASSERT_THAT(gridErrorOf(whole.substr(0, size)), HasSubstr("test.gridmap: ")) << size;
    }
    EXPECT_EQ(gridErrorOf(whole), "");
  }
  for (const std::string& whole : {simple, test::gzipped(simple)}) {
    for (std::size_t size = 0; size < whole.size(); size += 1 + size / 50) {
      ASSERT_THAT(simpleErrorOf(whole.substr(0, size)), HasSubstr("test.simplemap: ")) << size;
    }
    EXPECT_EQ(simpleErrorOf(whole), "");
  }
}

TEST_F(GridMaps, RefusesSimplemapsThatGiveNoGrid) {
  const auto errorOf = [&](const CSimpleMap& map) { return simpleErrorOf(test::serialised(map)); };
  EXPECT_THAT(errorOf(CSimpleMap()), HasSubstr("without observations"));
  EXPECT_THAT(errorOf(roomMap({{0, 0, 0, 0, 0, 0}, {1e6, 1e6, 0, 0, 0, 0}})),
              HasSubstr("too far apart"));
  EXPECT_THAT(errorOf(roomMap({{0, 0, 0, 0, 0, 0}, {std::nan(""), 0, 0, 0, 0, 0}})),
              HasSubstr("pose 1: is not finite"));
  EXPECT_THAT(errorOf(roomMap({{1e8, 1e8, 0, 0, 0, 0}})), HasSubstr("too far apart"));

  mrpt::obs::CObservation2DRangeScan scan;
  scan.aperture = 3.0F;
  scan.maxRange = 80.0F;
  scan.resizeScanAndAssign(181, 3.0F, true);
  const auto errorOfScan = [&](const auto& spoil) {
    const auto spoilt = mrpt::obs::CObservation2DRangeScan::Create(scan);
    spoil(*spoilt);
    const auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(spoilt);
    CSimpleMap map;
    map.insert(mrpt::poses::CPose3DPDFGaussian::Create(), frame);
    return errorOf(map);
  };
  EXPECT_EQ(errorOfScan([](auto& /*scan*/) {}), "");
  EXPECT_THAT(errorOfScan([](auto& one) { one.setScanRange(7, -1e20F); }),
              HasSubstr("pose 0: holds readings that are no ranges"));
  EXPECT_THAT(errorOfScan([](auto& one) { one.setScanRange(7, std::nanf("")); }),
              HasSubstr("no ranges"));
  EXPECT_EQ(errorOfScan([](auto& one) {
              one.setScanRange(7, -1.0F);
              one.setScanRangeValidity(7, false);
            }),
            "");
  EXPECT_THAT(errorOfScan([](auto& one) { one.maxRange = -1e20F; }), HasSubstr("no ranges"));
  EXPECT_THAT(errorOfScan([](auto& one) { one.sensorPose.x(std::nan("")); }),
              HasSubstr("pose 0: is not finite"));
  EXPECT_THAT(errorOfScan([](auto& one) { one.sensorPose.x(1e9); }), HasSubstr("too far apart"));

  CSimpleMap odometry;
  const auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(mrpt::obs::CObservationOdometry::Create());
  odometry.insert(mrpt::poses::CPose3DPDFGaussian::Create(), frame);
  EXPECT_THAT(errorOf(odometry), HasSubstr("no laser scan"));
}

}  // namespace
}  // namespace mrpt_polyloc
