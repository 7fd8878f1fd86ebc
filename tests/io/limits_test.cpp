// What files may ask for at most, each limit passed by one.

#include "tests/support/bridge_files.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/geometry/map_limits.h>
#include <mrpt_polyloc/geometry/validation.h>
#include <mrpt_polyloc/io/GuardedStream.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/ScanLog.h>
#include <mrpt_polyloc/io/drive_log.h>
#include <mrpt_polyloc/io/gray_image.h>
#include <mrpt_polyloc/io/grid_maps.h>
#include <mrpt_polyloc/io/limits.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/io/replay_log.h>
#include <mrpt_polyloc/io/scan_files.h>

#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include <filesystem>
#include <random>
#include <zstd.h>

namespace mrpt_polyloc::test {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using Limits = QuietTest;
using namespace std::string_literals;

std::string carmenLine(std::size_t beams) {
  std::string line = "FLASER " + std::to_string(beams);
  for (std::size_t i = 0; i < beams; ++i) line += " 1";
  return line + " 0 0 0 0 0 0 1.0 host 1.0\n";
}

TEST_F(Limits, Pixels) {
  EXPECT_NE(formatErrorOf([] { decodePgm("x", "P5 20001 20000 255\n"); }).find("400000000 pixels"),
            std::string::npos);
  std::string png = pngFile(1, 1, 8, 0, "a");
  png.replace(16, 8, std::string("\x00\x00\x4e\x21\x00\x00\x4e\x20", 8));  // 20001 x 20000
  EXPECT_NE(formatErrorOf([&] { decodePng("x", png); }).find("400000000 pixels"),
            std::string::npos);
}

TEST_F(Limits, WholeFiles) {
  const std::string plain = dir_.file("large.wkt");
  writeFile(plain, "POLYGON");
  std::filesystem::resize_file(plain, kMaxWholeFile + 1);  // sparse
  EXPECT_NE(formatErrorOf([&] { GzInputStream(plain).readAll(); }).find("1024 MiB"),
            std::string::npos);

  // The same, compressed to a 20,000th.
  const std::vector<char> zeros(std::size_t{1} << 20U);
  std::vector<char> packed(ZSTD_compressBound(zeros.size()));
  packed.resize(ZSTD_compress(packed.data(), packed.size(), zeros.data(), zeros.size(), 1));
  std::string bomb;
  for (int i = 0; i < 1025; ++i) bomb.append(packed.data(), packed.size());
  const std::string compressed = dir_.file("bomb.wkt");
  writeFile(compressed, bomb);
  EXPECT_NE(formatErrorOf([&] { GzInputStream(compressed).readAll(); }).find("1024 MiB"),
            std::string::npos);
}

TEST_F(Limits, Vertices) {
  RawMap raw;
  raw.polygons.emplace_back();
  raw.polygons.front().outer = wallRing(std::vector<TPoint2D>(kMaxMapVertices + 1, {0.0, 0.0}));
  try {
    repairMap(raw);
    ADD_FAILURE() << "taken";
  } catch (const InvalidMapError& error) {
    EXPECT_NE(std::string(error.what()).find("more than 5000000 vertices"), std::string::npos);
  }
}

TEST_F(Limits, BeamsOfCarmen) {
  ScanFileOptions options;
  options.laser_fov = 3.0;
  const std::string path = dir_.file("a.log");
  writeFile(path, carmenLine(kMaxBeams));
  EXPECT_EQ(loadScans(path, options).front().beams().size(), kMaxBeams);
  writeFile(path, carmenLine(kMaxBeams + 1));
  EXPECT_NE(formatErrorOf([&] { loadScans(path, options); }).find("line 1: more than 100000"),
            std::string::npos);
}

TEST_F(Limits, BeamsOfRawlogs) {
  std::mt19937 random(1);
  const std::string path = dir_.file("a.rawlog");
  writeFile(path, serialised(randomObservation(random, kMaxBeams + 1)));
  EXPECT_EQ(formatErrorOf([&] { loadScans(path); }),
            path + ": object 0: a scan of more than 100000 beams");
  EXPECT_THROW(toLoggedScan(randomObservation(random, kMaxBeams + 1)), std::invalid_argument);
}

/// A stored object with the first number `from` in it replaced.
std::string restated(std::string bytes, const std::string& from, const std::string& to) {
  const std::size_t at = bytes.find(from);
  EXPECT_NE(at, std::string::npos);
  return bytes.replace(at, from.size(), to);
}

TEST_F(Limits, StatedSizesOfStoredScans) {
  std::mt19937 random(1);
  const std::string count("\x39\x30\0\0", 4);  // 12345
  const std::string one = serialised(randomObservation(random, 5));
  const std::string hostile =
      restated(serialised(randomObservation(random, 12345)), count, "\xf0\xff\xff\xff");
  mrpt::obs::CSensoryFrame frame;
  frame.insert(std::make_shared<CObservation2DRangeScan>(randomObservation(random, 5)));
  frame.insert(std::make_shared<CObservation2DRangeScan>(randomObservation(random, 12345)));
  const std::string path = dir_.file("a.rawlog");
  // MRPT takes a name up to a zero byte.
  const std::string disguised = restated(hostile, "\xa2mrpt::obs::CObservation2DRangeScan",
                                         "\xa4mrpt::obs::CObservation2DRangeScan" + "\0x"s);
  for (const std::string& second :
       {hostile, disguised, restated(serialised(frame), count, "\xff\xff\xff\x7f")}) {
    writeFile(path, one + second);
    EXPECT_EQ(formatErrorOf([&] { loadScans(path); }),
              path + ": object 1: a scan of more than 100000 beams");
  }
}

TEST_F(Limits, StatedLimitsOfGrids) {
  const mrpt::maps::COccupancyGridMap2D grid(-1, 1, -1, 3, 0.5F);
  const std::string bytes = serialised(grid), three("\0\0\x40\x40", 4);
  const std::string path = dir_.file("a.gridmap");
  writeFile(path, bytes);
  EXPECT_EQ(loadGridMap(path).height, 8);
  writeFile(path, restated(bytes, three, std::string("\0\0\x40\x7f", 4)));  // 2.6e38 m
  EXPECT_EQ(formatErrorOf([&] { loadGridMap(path); }),
            path + ": object 0: the grid's resolution or limits are out of range");
  writeFile(path, restated(bytes, three, std::string("\0\0\x40\x4c", 4)));  // 5e7 m
  EXPECT_EQ(formatErrorOf([&] { loadGridMap(path); }),
            path + ": object 0: a grid of more than 400000000 cells");
}

TEST_F(Limits, StatedPosesOfSimplemaps) {
  mrpt::maps::CSimpleMap map;
  for (int i = 0; i < 300; ++i) {
    map.insert(mrpt::poses::CPose3DPDFGaussian::Create(), mrpt::obs::CSensoryFrame::Create());
  }
  const std::string path = dir_.file("a.simplemap");
  writeFile(path, restated(serialised(map), std::string("\x2c\x01\0\0", 4), "\xff\xff\xff\x7f"));
  EXPECT_EQ(formatErrorOf([&] { loadSimpleMap(path); }),
            path + ": object 0: a simplemap of more than 1000000 poses");
}

mrpt::obs::CActionRobotMovement2D movementOf(unsigned poses) {
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions options;
  options.modelSelection = mrpt::obs::CActionRobotMovement2D::mmThrun;
  options.thrunModel.nParticlesCount = poses;
  mrpt::obs::CActionRobotMovement2D movement;
  movement.computeFromOdometry({0.1, 0, 0.01}, options);
  return movement;
}

TEST_F(Limits, StatedPosesOfMovements) {
  std::mt19937 random(1);
  const std::string scan = serialised(randomObservation(random, 5));
  const std::string path = dir_.file("a.rawlog");
  mrpt::obs::CActionCollection actions;
  actions.insert(movementOf(100));
  actions.insert(movementOf(12345));
  writeFile(path, serialised(actions) + scan);
  EXPECT_EQ(loadScans(path).size(), 1U);
  const std::string count("\x39\x30\0\0", 4);  // 12345
  for (const char* const stated : {"\xff\xff\xff\x7f", "\xff\xff\xff\xff"}) {
    writeFile(path, restated(serialised(actions), count, stated) + scan);
    EXPECT_EQ(formatErrorOf([&] { loadScans(path); }),
              path + ": object 0: a movement of more than 100000 poses");
  }
}

// MRPT would go on with none.
TEST_F(Limits, ObjectsThatCannotBeMade) {
  std::mt19937 random(1);
  mrpt::obs::CSensoryFrame frame;
  frame.insert(std::make_shared<CObservation2DRangeScan>(randomObservation(random, 5)));
  const std::string path = dir_.file("a.rawlog");
  writeFile(path, restated(serialised(frame), "\xa2mrpt::obs::CObservation2DRangeScan",
                           "\x97mrpt::obs::CObservation"));
  EXPECT_EQ(formatErrorOf([&] { loadScans(path); }),
            path + ": object 0: an object of the abstract class mrpt::obs::CObservation");

  mrpt::obs::CActionRobotMovement2D movement = movementOf(100);
  movement.estimationMethod = mrpt::obs::CActionRobotMovement2D::emScan2DMatching;
  movement.poseChange = mrpt::poses::CPosePDFGaussian::Create();
  const std::string scan = serialised(randomObservation(random, 5));
  writeFile(path, serialised(movement) + scan);
  EXPECT_EQ(loadScans(path).size(), 1U);
  writeFile(path, restated(serialised(movement), "\x9dmrpt::poses::CPosePDFGaussian",
                           "\x94mrpt::poses::CPose2D") +
                      scan);
  EXPECT_EQ(formatErrorOf([&] { loadScans(path); }),
            path + ": object 0: a movement that is no distribution of poses");
}

TEST_F(Limits, TheEndOfTheContentEndsReading) {
  const std::string path = dir_.file("a.rawlog");
  writeFile(path, "12345");
  GzInputStream file(path);
  GuardedStream stream(file);
  char bytes[4] = {};
  EXPECT_EQ(stream.Read(bytes, 3), 3U);
  EXPECT_THROW(stream.Read(bytes, 3), std::runtime_error);  // not two bytes, and one of before
}

TEST_F(Limits, Scans) {
  std::mt19937 random(1);
  const std::string scan = serialised(randomObservation(random, 5));
  const std::string rawlog = dir_.file("a.rawlog"), carmen = dir_.file("a.log");
  writeFile(rawlog, scan + scan + scan);
  writeFile(carmen, carmenLine(181) + carmenLine(181) + carmenLine(181));
  ScanFileOptions options;
  options.max_scans = 3;
  for (const std::string& path : {rawlog, carmen}) EXPECT_EQ(loadScans(path, options).size(), 3U);
  options.max_scans = 2;
  for (const std::string& path : {rawlog, carmen}) {
    const std::string wanted = path + (path == rawlog ? ": object 2" : ": line 3") +
                               ": more than 2 scans: cut the log to pieces";
    EXPECT_EQ(formatErrorOf([&] { loadScans(path, options); }), wanted);
    EXPECT_EQ(formatErrorOf([&] { ScanLog log(path, options); }), wanted);
    EXPECT_EQ(formatErrorOf([&] { loadDrive(path, options); }), wanted);
  }
  EXPECT_EQ(formatErrorOf([&] { loadReplayLog(rawlog, options); }),
            rawlog + ": object 2: more than 2 scans: cut the log to pieces");
}

}  // namespace
}  // namespace mrpt_polyloc::test
