#include "tests/support/bridge_files.h"
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/map_files.h>
#include <mrpt_polyloc/io/rawlog.h>
#include <mrpt_polyloc/io/scan_files.h>

#include <gmock/gmock.h>

#include <zstd.h>

namespace mrpt_polyloc {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string zstded(const std::string& content) {
  std::string bytes(ZSTD_compressBound(content.size()), '\0');
  bytes.resize(ZSTD_compress(bytes.data(), bytes.size(), content.data(), content.size(), 3));
  return bytes;
}

class Compression : public test::QuietTest {
 protected:
  std::string write(const std::string& name, const std::string& bytes) {
    test::writeFile(dir_.file(name), bytes);
    return dir_.file(name);
  }
};

TEST_F(Compression, IsToldByTheFirstBytesWhateverTheName) {
  std::mt19937 random(5);
  const std::string rawlog = test::serialised(test::randomObservation(random, 20));
  const std::string wkt = "POLYGON ((0 0, 4 0, 4 3, 0 3))";
  const std::string pgm = std::string("P5 100 100 255\n") + std::string(10000, '\xfe');
  const std::string yaml = "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n";
  for (const auto& pack : {test::gzipped, zstded}) {
    EXPECT_EQ(loadScans(write("a.rawlog", pack(rawlog))).size(), 1U);
    EXPECT_EQ(loadScans(write("a.rawlog.zst", pack(rawlog))).size(), 1U);
    EXPECT_DOUBLE_EQ(loadMap(write("a.wkt", pack(wkt))).map.area(), 12.0);
    EXPECT_DOUBLE_EQ(loadMap(write("a.wkt.zst", pack(wkt))).map.area(), 12.0);
    EXPECT_DOUBLE_EQ(loadMap(write("a.wkt.gz", pack(wkt))).map.area(), 12.0);
    write("map.pgm", pack(pgm));
    EXPECT_NEAR(loadMap(write("a.yaml", pack(yaml))).map.area(), 25.0, 0.5);
  }
}

TEST_F(Compression, EveryTruncationIsLocated) {
  std::mt19937 random(6);
  std::string content;
  for (int i = 0; i < 4; ++i) content += test::serialised(test::randomObservation(random, 5));
  const std::string whole = zstded(content);
  ScanFileOptions strict;
  strict.strict = true;
  for (std::size_t size = 4; size < whole.size(); ++size) {
    const std::string path = write("cut.rawlog", whole.substr(0, size));
    EXPECT_THAT(test::formatErrorOf([&] { loadRawlog(path, strict); }),
                AllOf(HasSubstr("byte "), HasSubstr("truncated")))
        << size;
  }
  EXPECT_EQ(loadRawlog(write("whole.rawlog", whole), strict).size(), 4U);
  EXPECT_EQ(loadRawlog(write("twice.rawlog", whole + whole), strict).size(), 8U);
}

TEST_F(Compression, DamageIsRefused) {
  const std::string whole = zstded(std::string(100000, 'x') + "y");
  std::string bad_header = whole;
  bad_header[4] = '\xff';
  EXPECT_THAT(test::formatErrorOf([&] { GzInputStream(write("a", bad_header)); }),
              AllOf(HasSubstr("byte "), HasSubstr("damaged")));
  EXPECT_THAT(test::formatErrorOf([&] { GzInputStream(write("a", whole + "garbage")); }),
              HasSubstr("damaged"));
  EXPECT_THAT(test::formatErrorOf([&] { GzInputStream(write("a", zstded(""))); }),
              HasSubstr("empty file"));
}

TEST_F(Compression, LargeContentIsReadWhole) {
  std::string content;
  std::mt19937 random(8);
  while (content.size() < 1000000) content += std::to_string(random());
  EXPECT_EQ(GzInputStream(write("a", zstded(content))).readAll(), content);
}

}  // namespace
}  // namespace mrpt_polyloc
