#include "map_scenes.h"
#include "tests/support/bridge_files.h"
#include "tests/support/comma_locale.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/calibration_files.h>
#include <mrpt_polyloc/evaluation/summary_json.h>
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/io/carmen.h>
#include <mrpt_polyloc/io/geojson.h>
#include <mrpt_polyloc/io/map_files.h>
#include <mrpt_polyloc/io/wkt.h>
#include <mrpt_polyloc/localization/ranking/Calibration.h>
#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

/// A viewer with a window sets its user's locale; what the library reads and writes must not
/// follow.
namespace mrpt_polyloc {
namespace {

PolygonMap fractions() {
  return PolygonMap({{wallRing({{0.25, 0.5}, {1234.5678, 0.5}, {1234.5678, 80.125}}), {}}});
}

std::string textOf(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) appendNumber(text += ' ', number);
  return text + "\n";
}

std::string textOf(const PolygonMap& map) {
  std::string text;
  for (const Ring* ring : map.rings()) {
    for (const TPoint2D& p : ring->vertices) text += textOf({p.x, p.y});
  }
  return text;
}

std::string maps(const test::TempDir& dir) {
  std::string text = toGeoJson(fractions()) + toWkt(fractions());
  test::writeFile(dir.file("a.geojson"), toGeoJson(fractions()));
  test::writeFile(dir.file("a.wkt"), "POLYGON((0.25 0.5, 10.75 0.5, 10.75 8.125))\n");
  test::writeFile(dir.file("a.json"), R"({"verts": [[0.25, 0.5], [10.75, 0.5], [10.75, 8.125]]})");
  test::writeFile(dir.file("a.pgm"), "P2\n4 3\n255\n0 0 0 0\n0 254 254 0\n0 0 0 0\n");
  test::writeFile(dir.file("a.yaml"),
                  "image: a.pgm\nresolution: 0.75\norigin: [1.5, -2.25, 0.1]\nnegate: 0\n"
                  "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  for (const char* name : {"a.geojson", "a.wkt", "a.json", "a.yaml"}) {
    text += name + ("\n" + textOf(loadMap(dir.file(name)).map));
  }
  return text;
}

std::string logs(const test::TempDir& dir) {
  std::string line = "FLASER 180";
  for (int i = 0; i < 180; ++i) line += formatted(" %.2f", 1.25 + 0.01 * i);
  test::writeFile(dir.file("a.log"), line + " 1.5 2.5 0.25 1.5 2.5 0.25 12.5 host 13.5\n");
  std::string text;
  const std::vector<RangeScan> scans = loadCarmen(dir.file("a.log"), {});
  for (const Beam& beam : scans.at(0).beams()) {
    text += textOf({beam.bearing, beam.range});
  }
  return text;
}

std::string figures(const test::TempDir& dir) {
  const std::string tum = toTum({{1.5, {2.25, -1234.5, 0.75}}});
  test::writeFile(dir.file("a.tum"), tum);
  const StampedPose pose = loadTum(dir.file("a.tum")).at(0);
  test::writeFile(dir.file("a.calibration"), calibrationJson(Calibration()).dump());
  ScanRecord record;
  record.truth = {1.25, 2.5, 0.5};
  return tum + textOf({pose.stamp, pose.pose_map_robot.x, pose.pose_map_robot.y}) +
         calibrationJson(loadCalibration(dir.file("a.calibration"))).dump() +
         calibrationHeader(Calibration(), {}) + scansCsv({record}) +
         mapStatistics(fractions()).dump();
}

std::string bridge(const test::TempDir& dir) {
  TLikelihoodOptions options;
  options.loadFromConfigFile(mrpt::config::CConfigFileMemory("[L]\nsigma=0.25\ntau_long=1.5\n"),
                             "L");
  std::ostringstream dumped;
  options.dumpToTextStream(dumped);
  CPolygonMap2D(fractions()).saveMetricMapRepresentationToFile(dir.file("saved"));
  options.sigma = -0.5;
  return dumped.str() + test::readFile(dir.file("saved.geojson")) +
         test::messageOf<InvalidParamsError>([&] { options.check(); }) +
         test::messageOf<InvalidMapError>([] {
           PolygonMap({{wallRing({{0, 0}, {1e9, NAN}, {1, 1}}), {}}});
         });
}

std::string everything() {
  const test::TempDir dir;
  return maps(dir) + logs(dir) + figures(dir) + bridge(dir);
}

TEST(HostLocale, ChangesNothingThatIsReadOrWritten) {
  const std::string plain = everything();
  const test::CommaLocale commas;
  std::ostringstream host;
  host << 1234.5;
  ASSERT_EQ(host.str(), "1.234,5");
  EXPECT_EQ(everything(), plain);
  if (!commas.isSet()) GTEST_SKIP() << "no localedef: C's functions were not looked at";
  char text[20];
  std::snprintf(text, sizeof text, "%.1f", 0.5);
  EXPECT_STREQ(text, "0,5");
}

}  // namespace
}  // namespace mrpt_polyloc
