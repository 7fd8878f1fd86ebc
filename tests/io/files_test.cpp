// The files that exist: MRPT's own, and the public evaluation data.
#include "tests/support/bridge_files.h"
#include "tests/support/data_dir.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/bitmap_files.h>
#include <mrpt_polyloc/io/scan_files.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace mrpt_polyloc {
namespace {

using test::formatErrorOf;
using testing::AllOf;
using testing::HasSubstr;

const std::string kMrptDatasets = "/usr/share/mrpt/datasets/";  // Debian package mrpt-common

class Files : public test::QuietTest {};

TEST_F(Files, UnknownExtensionsAreRefusedAndTheKnownOnesListed) {
  for (const std::string name : {"scans.bag", "scans", "scans.gz", ".rawlog", "scans.txt.gz"}) {
    test::writeFile(dir_.file(name), "x");
    EXPECT_THAT(formatErrorOf([&] { loadScans(dir_.file(name)); }),
                AllOf(HasSubstr("unknown extension"), HasSubstr(".rawlog, .log and .clf")))
        << name;
    EXPECT_EQ(loadBitmap(dir_.file(name)), std::nullopt) << name;
  }
}

TEST_F(Files, MissingFilesAndFoldersAreRefused) {
  for (const std::string name : {"a.rawlog", "a.log", "a.clf", "a.LOG.GZ", "a.yaml", "a.yml",
                                 "a.gridmap", "a.simplemap.gz"}) {
    const std::string path = dir_.file(name);
    const auto load = [&] {
      if (!loadBitmap(path)) loadScans(path);
    };
    EXPECT_THAT(formatErrorOf(load), HasSubstr(name + ": no such file"));
    std::filesystem::create_directory(path);
    EXPECT_THAT(formatErrorOf(load), HasSubstr(name + ": is a directory"));
  }
}

TEST_F(Files, ExtensionsCountInAnyCase) {
  std::mt19937 random(51);
  const std::string bytes = test::serialised(test::randomObservation(random, 20));
  for (const std::string name : {"a.RAWLOG", "a.rawlog.gz", "a.Rawlog.GZ"}) {
    test::writeFile(dir_.file(name), bytes);
    EXPECT_EQ(loadScans(dir_.file(name)).size(), 1U) << name;
  }
  for (const std::string name : {"a.LOG", "a.Clf", "a.clf.gz"}) {
    test::writeFile(dir_.file(name), "FLASER 1 2.0 0 0 0 0 0 0 1 h 1\n");
    EXPECT_EQ(loadScans(dir_.file(name)).size(), 1U) << name;
  }
}

void expectScans(const std::string& path, std::size_t scans, std::size_t beams) {
  const auto loaded = loadScans(path);
  EXPECT_EQ(loaded.size(), scans) << path;
  for (const RangeScan& scan : loaded) {
    EXPECT_EQ(scan.beams().size(), beams);
    EXPECT_GT(scan.hitCount() + scan.noReturnCount(), beams / 2);
  }
}

TEST_F(Files, ScansOfMrptsDatasets) {
  const std::map<std::string, std::size_t> sets = {
      {"localization_demo.rawlog", 37},
      {"2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog", 225},
      {"uwb_ro-localization_demo.rawlog", 343}};
  if (!std::filesystem::exists(kMrptDatasets + "localization_demo.rawlog")) {
    GTEST_SKIP() << "mrpt-common is not installed";
  }
  for (const auto& [name, scans] : sets) expectScans(kMrptDatasets + name, scans, 361);
  EXPECT_NEAR(loadScans(kMrptDatasets + "localization_demo.rawlog")[0].sensor().x, 0.78, 1e-6);
}

double freeArea(const OccupancyBitmap& bitmap) {
  return bitmap.resolution * bitmap.resolution *
         static_cast<double>(std::count(bitmap.cells.begin(), bitmap.cells.end(), CellState::free));
}

TEST_F(Files, MapsOfMrptsDatasets) {
  const std::map<std::string, std::pair<double, double>> maps = {
      {"localization_demo.simplemap.gz", {120, 220}},
      {"malaga-cs-fac-building.simplemap.gz", {550, 900}},
      {"uwb_ro-localization_demo_map.gridmap.gz", {100, 300}},
      {"2006-MalagaCampus.gridmap.gz", {10000, 11500}}};
  if (!std::filesystem::exists(kMrptDatasets + "localization_demo.simplemap.gz")) {
    GTEST_SKIP() << "mrpt-common is not installed";
  }
  for (const auto& [name, area] : maps) {
    const auto bitmap = loadBitmap(kMrptDatasets + name);
    ASSERT_TRUE(bitmap) << name;
    EXPECT_GT(freeArea(*bitmap), area.first) << name;
    EXPECT_LT(freeArea(*bitmap), area.second) << name;
  }
}

TEST_F(Files, AllEvaluationScansLoad) {
  POLYLOC_DATA_OR_SKIP(data);
  const std::vector<std::tuple<std::string, std::size_t, std::size_t>> sets = {
      {"intel", 454, 180},   {"fr079", 299, 360},     {"csail", 202, 361}, {"aces", 220, 180},
      {"gh25_sim", 68, 626}, {"malaga_fac", 49, 361}, {"locdemo", 37, 361}};
  for (const auto& [name, scans, beams] : sets) {
    expectScans(data + "/scans/" + name + "/scans.rawlog", scans, beams);
    EXPECT_TRUE(loadBitmap(data + "/scans/" + name + "/map.yaml")) << name;
  }
  expectScans(data + "/replay/driving_in_office.rawlog", 1159, 626);
}

TEST_F(Files, AllEvaluationLogsLoad) {
  POLYLOC_DATA_OR_SKIP(data);
  expectScans(data + "/carmen/aces-corrected.log.gz", 440, 180);
  expectScans(data + "/carmen/csail-corrected.log.gz", 406, 361);
  expectScans(data + "/carmen/freiburg-079-corrected.log.gz", 4791, 360);
  expectScans(data + "/carmen/intel-corrected.log.gz", 910, 180);
}

TEST_F(Files, AllEvaluationGridsLoad) {
  POLYLOC_DATA_OR_SKIP(data);
  int grids = 0;
  for (const std::string& path : test::mapFolderFiles(data)) {
    const std::string extension = std::filesystem::path(path).extension();
    if (extension != ".yaml" && extension != ".simplemap") continue;
    const auto bitmap = loadBitmap(path);
    ASSERT_TRUE(bitmap) << path;
    EXPECT_GT(freeArea(*bitmap), 15.0) << path;
    ++grids;
  }
  EXPECT_GE(grids, 17);
}

// The evaluation set was cut from this log by another program: both readers must agree.
TEST_F(Files, TheRawlogOfIntelHoldsScansOfItsCarmenLog) {
  POLYLOC_DATA_OR_SKIP(data);
  std::map<std::vector<int>, const RangeScan*> by_ranges;
  const auto centimetres = [](const RangeScan& scan) {
    std::vector<int> ranges;
    for (const Beam& beam : scan.beams()) {
      ranges.push_back(beam.kind == BeamKind::hit ? static_cast<int>(std::lround(beam.range * 100))
                                                  : -1);
    }
    return ranges;
  };
  const auto log = loadScans(data + "/carmen/intel-corrected.log.gz");
  for (const RangeScan& scan : log) by_ranges[centimetres(scan)] = &scan;
  std::size_t found = 0;
  for (const RangeScan& scan : loadScans(data + "/scans/intel/scans.rawlog")) {
    const auto same = by_ranges.find(centimetres(scan));
    if (same == by_ranges.end()) continue;
    ++found;
    for (std::size_t i = 0; i < scan.beams().size(); ++i) {
      if (scan.beams()[i].kind != BeamKind::hit) continue;
      ASSERT_NEAR(scan.beams()[i].bearing, same->second->beams()[i].bearing, 1e-5);
    }
  }
  EXPECT_EQ(found, 454U);
}

}  // namespace
}  // namespace mrpt_polyloc
