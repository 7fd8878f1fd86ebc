#include "map_scenes.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/io/geojson.h>
#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>
#include <mrpt_polyloc/mrpt_bridge/registration.h>

#include <gmock/gmock.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/serialization/CArchive.h>

#include <memory>
#include <thread>

#ifdef __SANITIZE_ADDRESS__
/// MRPT 2.5.8 does not free a map definition whose ini is refused with an exception.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:mrpt::maps::TSetOfMetricMapInitializers::loadFromConfigFile\n";
}
#endif

namespace mrpt_polyloc {
namespace {

using test::castScan;
using test::partlyOpenRoom;
using test::room;

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

TEST(PolygonMap2D, IsMadeByAnIniCopiedBySerializationAndKeptByClear) {
  const test::TempFile file(".geojson", toGeoJson(room()));
  mrpt::maps::CMultiMetricMap maps(
      fromIni(iniFor(file.path(), "sigma = 0.25  // m\ndecimation=3 ; beams\ntau_none=")));
  mrpt::maps::CMultiMetricMap copy(maps);
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
  EXPECT_NO_THROW(make(iniFor(good.path())));
  // The messages name the option or the file.
  const auto complaint = [&](const std::string& ini) {
    return test::messageOf<std::exception>([&] { make(ini); });
  };
  EXPECT_NE(complaint(iniFor("")).find("no 'file' is given"), std::string::npos);
  EXPECT_NE(complaint(iniFor("/nowhere/map.geojson")).find("/nowhere/map.geojson"),
            std::string::npos);
  EXPECT_NE(complaint(iniFor(broken.path())).find(broken.path()), std::string::npos);
  EXPECT_NE(complaint(iniFor(good.path(), "sigmma=0.2")).find("sigmma"), std::string::npos);
  EXPECT_NE(complaint(iniFor(good.path(), "sigma=-1")).find("sigma"), std::string::npos);
  for (const char* bad : {"metric=best", "sigma=wide", "sigma=nan", "independent_beams=0",
                          "decimation=0", "decimation=none", "tau_short=no", "tau_short=-0.1",
                          "tau_long=-1", "tau_open=-1", "tau_none=0.1m", "none_share=-0.5"}) {
    const std::string name(bad, std::string(bad).find('='));
    EXPECT_THAT(complaint(iniFor(good.path(), bad)),
                testing::AllOf(testing::HasSubstr("_likelihoodOpts"), testing::HasSubstr(name)))
        << bad;
  }
  const std::string section = "[M_polygonMap2D_00_creationOpts]\n";
  const auto created = [&](const std::string& line) {
    return "[M]\npolygonMap2D_count=1\n" + section + "file=" + good.path() + "\n" + line + "\n";
  };
  EXPECT_THAT(complaint(created("max_gap=1")), testing::HasSubstr("'max_gap'"));
  EXPECT_THAT(
      complaint(created("tolerance_cells=-1")),
      testing::AllOf(testing::HasSubstr("_creationOpts'"), testing::HasSubstr("tolerance_cells")));
  EXPECT_THAT(complaint("[M]\npolygonMap2D_count=1\n"), testing::HasSubstr("'file'"));
}

/// The map as it comes back from an archive; `damage` may change the bytes in between.
template <class Damage>
mrpt::serialization::CSerializable::Ptr storedAndLoaded(const CPolygonMap2D& map, Damage damage) {
  registerClasses();
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << map;
  std::string bytes(static_cast<const char*>(stream.getRawBufferData()),
                    stream.getTotalBytesCount());
  damage(bytes);
  mrpt::io::CMemoryStream damaged(bytes.data(), bytes.size());
  return mrpt::serialization::archiveFrom(damaged).ReadObject();
}

CPolygonMap2D::Ptr storedAndLoaded(const CPolygonMap2D& map) {
  return std::dynamic_pointer_cast<CPolygonMap2D>(storedAndLoaded(map, [](std::string&) {}));
}

TEST(PolygonMap2D, StoringAndLoadingWithinAProcessSharesTheMap) {
  auto map = std::make_shared<CPolygonMap2D>(partlyOpenRoom());
  const auto copy = storedAndLoaded(*map);
  ASSERT_TRUE(copy);
  EXPECT_EQ(copy->map(), map->map());                    // the same object, not an equal one
  EXPECT_EQ(storedAndLoaded(*copy)->map(), map->map());  // of a copy, too
  const CPolygonMap2D other(room());
  EXPECT_EQ(storedAndLoaded(other)->map(), other.map());
  EXPECT_NE(storedAndLoaded(other)->map(), map->map());
  EXPECT_TRUE(storedAndLoaded(CPolygonMap2D())->isEmpty());
}

TEST(PolygonMap2D, OneLoadedAnewWeighsAsTheOneStored) {
  const PolygonMap polygons = partlyOpenRoom();
  const auto scan = castScan(polygons, 2, 1, 0.3);
  std::vector<mrpt::math::TPose2D> poses;
  for (int i = 0; i < 50; ++i) poses.emplace_back(0.2 * i, 1.0 + 0.05 * i, 0.1 * i);
  auto map = std::make_unique<CPolygonMap2D>(polygons);
  const std::vector<double> expected = map->computeLikelihoods(scan, poses);
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << *map;
  map.reset();  // none is left to share with: as in another process
  stream.Seek(0);
  CPolygonMap2D loaded;
  mrpt::serialization::archiveFrom(stream) >> loaded;
  ASSERT_FALSE(loaded.isEmpty());
  EXPECT_EQ(loaded.map()->hash(), polygons.hash());
  // Its index is not there yet: several threads ask for it at once.
  std::vector<std::vector<double>> found(4);
  std::vector<std::thread> threads;
  for (auto& weights : found) {
    threads.emplace_back([&] { weights = loaded.computeLikelihoods(scan, poses); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& weights : found) EXPECT_EQ(weights, expected);
}

TEST(PolygonMap2D, RefusesADamagedStoredMap) {
  const CPolygonMap2D map(room());
  const auto complaint = [&](const std::string& from, const std::string& to) {
    return test::messageOf<std::exception>([&] {
      storedAndLoaded(map, [&](std::string& bytes) {
        const auto at = bytes.find(from);
        ASSERT_NE(at, std::string::npos);
        bytes.replace(at, from.size(), to);
      });
    });
  };
  // Another type; a walk that crosses itself; an unknown metric; cut short.
  EXPECT_THAT(complaint("MultiPolygon", "MultiPolygoX"),
              testing::HasSubstr("stored CPolygonMap2D"));
  EXPECT_THAT(complaint("robust", "robusX"), testing::HasSubstr("metric"));
  EXPECT_ANY_THROW(
      storedAndLoaded(map, [](std::string& bytes) { bytes.resize(bytes.size() / 2); }));
  // A map that refuses what it is given stays as it was.
  CPolygonMap2D kept(room());
  const double sigma = kept.likelihoodOptions.sigma = 0.3;
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  CPolygonMap2D bad(partlyOpenRoom());
  bad.likelihoodOptions.metric = "none";
  archive << bad;
  stream.Seek(0);
  EXPECT_ANY_THROW(archive >> kept);
  EXPECT_EQ(kept.map()->hash(), room().hash());
  EXPECT_EQ(kept.likelihoodOptions.sigma, sigma);
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

}  // namespace
}  // namespace mrpt_polyloc
