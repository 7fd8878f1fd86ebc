#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/ScanLog.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <thread>

namespace mrpt_polyloc::test {
namespace {

namespace fs = std::filesystem;

void expectEqual(const RangeScan& a, const RangeScan& b) {
  EXPECT_EQ(a.stamp(), b.stamp());
  EXPECT_EQ(a.label(), b.label());
  EXPECT_EQ(a.sensor(), b.sensor());
  ASSERT_EQ(a.beams().size(), b.beams().size());
  for (std::size_t i = 0; i < a.beams().size(); ++i) {
    EXPECT_EQ(a.beams()[i].bearing, b.beams()[i].bearing);
    EXPECT_EQ(a.beams()[i].range, b.beams()[i].range);
    EXPECT_EQ(a.beams()[i].kind, b.beams()[i].kind);
  }
}

/// Its rows, in any order, are those that are loaded whole.
void expectAsLoadedWhole(const std::string& path) {
  Notes of_log, of_whole;
  const ScanLog log(path, {}, &of_log);
  const std::vector<RangeScan> whole = loadScans(path, {}, &of_whole);
  EXPECT_EQ(of_log, of_whole);
  ASSERT_EQ(log.size(), whole.size());
  for (std::size_t k = 0; k < log.size(); k += 1 + log.size() / 50) {
    const std::size_t row = log.size() - 1 - k;
    EXPECT_EQ(log.stamp(row), whole[row].stamp());
    expectEqual(log.scan(row), whole[row]);
  }
  EXPECT_THROW(log.scan(log.size()), std::out_of_range);
}

TEST(ScanLog, HoldsTheRowsOfARawlog) {
  const std::string path = "/usr/share/mrpt/datasets/localization_demo.rawlog";
  if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
  expectAsLoadedWhole(path);
}

TEST(ScanLog, HoldsTheRowsOfCarmenLogs) {
  const fs::path folder = fs::temp_directory_path() / "polyloc-scanlog-test";
  fs::create_directories(folder);
  const std::string path = (folder / "a.log").string();
  std::ofstream out(path);
  for (int i = 0; i < 30; ++i) {
    out << "FLASER 181";
    for (int k = 0; k < 181; ++k) out << ' ' << 1.0 + 0.01 * k + 0.1 * i;
    out << " 0 0 0 0 0 0 " << 10.5 + i << " host " << 10.5 + i << "\n";
    out << "RAWLASER1 0 -1.5 3 1 80 0 0 3 1 2 3 0 " << 10.6 + i << " host 1\n";
  }
  // What stands behind the scans counts for them all.
  out << "PARAM robot_front_laser_max 5.5\nPARAM robot_frontlaser_offset 0.25\n";
  out.close();
  expectAsLoadedWhole(path);
  EXPECT_EQ(ScanLog(path).size(), 30U);
  EXPECT_EQ(ScanLog(path).scan(3).sensor().x, 0.25);
  ScanFileOptions options;
  options.sensor_label = "RAWLASER1";
  EXPECT_EQ(ScanLog(path, options).scan(7).beams().size(), 3U);
  fs::remove_all(folder);
}

TEST(ScanLog, RefusesWhatIsNoLog) {
  EXPECT_THROW(ScanLog("/nowhere/a.rawlog"), FormatError);
  EXPECT_THROW(ScanLog("/nowhere/a.txt"), FormatError);
  ScanFileOptions options;
  options.sensor_label = "NOBODY";
  const std::string path = "/usr/share/mrpt/datasets/localization_demo.rawlog";
  if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
  EXPECT_THROW(ScanLog(path, options), FormatError);
}

TEST(ScanLog, IsReadByManyAtOnce) {
  const std::string path = "/usr/share/mrpt/datasets/localization_demo.rawlog";
  if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
  const ScanLog log(path);
  const std::vector<RangeScan> whole = loadScans(path);
  std::vector<std::thread> readers;
  for (std::size_t first = 0; first < 4; ++first) {
    readers.emplace_back([&, first] {
      for (std::size_t row = first; row < log.size(); ++row) expectEqual(log.scan(row), whole[row]);
    });
  }
  for (std::thread& reader : readers) reader.join();
}

}  // namespace
}  // namespace mrpt_polyloc::test
