// Every public floor plan and polygon loads, is repaired, or is refused with located defects.

#include "tests/support/data_dir.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/geojson.h>
#include <mrpt_polyloc/io/polygon_files.h>
#include <mrpt_polyloc/io/wkt.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>

namespace mrpt_polyloc::test {
namespace {

struct InspectionTally {
  int valid = 0, repaired = 0, refused = 0;
};

std::ostream& operator<<(std::ostream& out, const InspectionTally& tally) {
  return out << tally.valid << " valid, " << tally.repaired << " repaired, " << tally.refused
             << " refused";
}

/// Checks a map that was read and counts what became of it.
void inspect(const std::string& name, const RawMap& raw, InspectionTally& tally) {
  SCOPED_TRACE(name);
  const MapInspection inspection = inspectMap(raw);
  if (!inspection.map) {
    ++tally.refused;
    ASSERT_FALSE(inspection.unrepaired.empty());
    std::cout << "refused " << name << ": " << inspection.unrepaired.size() << " defects, "
              << toString(inspection.unrepaired.front()) << "\n";
    return;
  }
  inspection.defects.empty() ? ++tally.valid : ++tally.repaired;
  EXPECT_EQ(inspection.defects.size(), inspection.repairs.size());
  const RepairedMap again = repairMap(parseGeoJson(toGeoJson(*inspection.map), name));
  EXPECT_TRUE(again.defects.empty()) << toString(again.defects.front());
  EXPECT_EQ(again.map.hash(), inspection.map->hash());
}

std::vector<std::filesystem::path> filesOf(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(PolygonData, EveryPlanLoadsOrIsRefusedWithPlaces) {
  POLYLOC_DATA_OR_SKIP(data);
  for (const auto& path : filesOf(data + "/plans")) {
    mrpt::io::CFileGZInputStream file;
    ASSERT_TRUE(file.open(path.string()));
    InspectionTally tally;
    std::string text(1 << 20, '\0');
    std::string all;
    while (const std::size_t size = file.Read(text.data(), text.size())) all.append(text, 0, size);
    for (std::size_t start = 0; start < all.size();) {
      const std::size_t end = std::min(all.find('\n', start), all.size());
      const std::string line = all.substr(start, end - start);
      const std::size_t tab = line.find('\t');
      ASSERT_NE(tab, std::string::npos);
      inspect(line.substr(0, tab), parseWkt(line.substr(tab + 1), line.substr(0, tab)), tally);
      start = end + 1;
    }
    std::cout << path.filename().string() << ": " << tally << "\n";
    EXPECT_GT(tally.valid + tally.repaired, 20 * tally.refused);
  }
}

TEST(PolygonData, EveryPolygonLoadsOrIsRefusedWithPlaces) {
  POLYLOC_DATA_OR_SKIP(data);
  InspectionTally tally;
  for (const auto& path : filesOf(data + "/polygons")) {
    inspect(path.filename().string(), readRawMap(path.string()), tally);
  }
  std::cout << tally << "\n";
  EXPECT_GT(tally.valid + tally.repaired, 0);
}

TEST(PolygonData, FilesOfOtherKindsAreRefusedByName) {
  POLYLOC_DATA_OR_SKIP(data);
  for (const auto& path : filesOf(data + "/polygons/raw")) {
    EXPECT_THAT(
        messageOf<FormatError>([&] { loadPolygonMap(path.string()); }),
        testing::HasSubstr(path.string() + ": unknown extension " + path.extension().string()));
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
