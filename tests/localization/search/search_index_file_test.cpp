#include "tests/support/simulated_scans.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/base/Checksum.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/search/search_index_file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <sstream>
#include <string>
#include <utility>

namespace mrpt_polyloc::test {
namespace {

using ::testing::HasSubstr;

class SearchIndexFile : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    content_ = new std::string(saved(*MapIndex::build(asymmetricRoom())));
  }
  static void TearDownTestSuite() { delete content_; }

  static std::string saved(const MapIndex& index) {
    std::ostringstream out;
    index.save(out);
    return out.str();
  }
  static MapIndex::Ptr loaded(const std::string& content, PolygonMap map = asymmetricRoom()) {
    std::istringstream in(content);
    return MapIndex::load(in, std::move(map), "room.index");
  }
  /// What reading a content as the room's index says; empty: nothing.
  static std::string complaint(const std::string& content) {
    return messageOf<FormatError>([&] { loaded(content); });
  }

  static const std::string& content() { return *content_; }

 private:
  static std::string* content_;
};
std::string* SearchIndexFile::content_ = nullptr;

TEST_F(SearchIndexFile, GivesTheSameAnswers) {
  const GlobalLocalizer built(asymmetricRoom()), read(loaded(content()));
  const RangeScan scan = simulatedScan(asymmetricRoom(), {1.5, 1.0, 0.4});
  const LocalizationResult a = built.localize(scan), b = read.localize(scan);
  ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size());
  for (std::size_t i = 0; i < a.hypotheses.size(); ++i) {
    EXPECT_EQ(a.hypotheses[i].pose_map_robot, b.hypotheses[i].pose_map_robot);
  }
  EXPECT_EQ(a.statistics.evaluated, b.statistics.evaluated);
  EXPECT_EQ(a.certificate->cost, b.certificate->cost);
  EXPECT_EQ(saved(read.index()), content());
}

TEST_F(SearchIndexFile, RefusesWhatIsNoIndex) {
  EXPECT_THAT(complaint(""), HasSubstr("room.index: byte 0: not a search index"));
  EXPECT_THAT(complaint("POLYGON ((0 0, 1 0, 1 1))"), HasSubstr("not a search index"));
  EXPECT_THAT(complaint(content().substr(0, 20)), HasSubstr("the file ends too early"));
}

TEST_F(SearchIndexFile, RefusesAnotherVersion) {
  std::string other = content();
  other[8] = 9;
  EXPECT_THAT(complaint(other), HasSubstr("version 9 of the index"));
}

TEST_F(SearchIndexFile, RefusesTheIndexOfAnotherMap) {
  EXPECT_THAT(messageOf<FormatError>([&] { loaded(content(), squareMap(3.0)); }),
              HasSubstr("the index of another map"));
}

TEST_F(SearchIndexFile, RefusesNumbersOfAnotherLayoutWithARightChecksum) {
  // As another version of the triangulation might have written it: the map is the same, the
  // vertices of its walls are numbered otherwise.
  std::istringstream in(content());
  SearchIndex index = readIndex(in, "room.index", asymmetricRoom().hash());
  for (std::uint8_t& byte : index.edges.runs) byte = byte > 1 ? byte - 1 : byte;
  index.edges.layout ^= 1;
  std::ostringstream out;
  writeIndex(out, index.edges, index.tree, asymmetricRoom().hash());
  EXPECT_THAT(complaint(out.str()), HasSubstr("laid out otherwise"));
}

TEST_F(SearchIndexFile, TakesNoMoreMemoryThanTheFileFills) {
  std::string other = content();
  const std::uint64_t huge = std::uint64_t{1} << 60;  // the first array's size
  other.replace(8 + 4 + 4 + 5 * 8, sizeof(huge), reinterpret_cast<const char*>(&huge),
                sizeof(huge));
  EXPECT_THAT(complaint(other), HasSubstr("the file ends too early"));
}

TEST_F(SearchIndexFile, RefusesAnyCut) {
  for (std::size_t size = 0; size < content().size(); size += 1 + content().size() / 211) {
    EXPECT_NE(complaint(content().substr(0, size)), "") << size;
  }
  EXPECT_NE(complaint(content().substr(0, content().size() - 1)), "");
}

TEST_F(SearchIndexFile, RefusesWhatFollows) {
  EXPECT_NE(complaint(content() + "x"), "");
  EXPECT_NE(complaint(content() + content()), "");
}

TEST_F(SearchIndexFile, RefusesAnyDamage) {
  for (std::size_t at = 0; at < content().size(); at += 1 + content().size() / 307) {
    std::string damaged = content();
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    EXPECT_NE(complaint(damaged), "") << at;
  }
}

/// The index with its last number, the checksum, made anew.
std::string sealed(std::string bytes) {
  Checksum checksum;
  checksum.add(bytes.data(), bytes.size() - sizeof(std::uint64_t));
  const std::uint64_t value = checksum.value();
  std::memcpy(bytes.data() + bytes.size() - sizeof(value), &value, sizeof(value));
  return bytes;
}

// Who means harm writes the right checksum, too.
TEST_F(SearchIndexFile, WithARightChecksumDamageIsRefusedOrDoesNoHarm) {
  ASSERT_EQ(sealed(content()), content());
  const RangeScan scan = simulatedScan(asymmetricRoom(), {1.5, 1.0, 0.4});
  std::size_t refused = 0, taken = 0;
  for (const char value : {'\0', '\x7f', '\xff'}) {
    for (std::size_t at = 16; at + 8 < content().size(); at += 1 + content().size() / 101) {
      std::string damaged = content();
      damaged[at] = value;
      try {
        const LocalizationResult result = GlobalLocalizer(loaded(sealed(damaged))).localize(scan);
        for (const Hypothesis& hypothesis : result.hypotheses) {
          EXPECT_TRUE(std::isfinite(hypothesis.cost)) << at;
        }
        ++taken;
      } catch (const FormatError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 10U);
  EXPECT_GT(taken, 10U);
}

TEST_F(SearchIndexFile, RefusesLeavesElsewhereAndOfNoSize) {
  const auto complaintAbout = [](const auto& spoil) {
    std::istringstream in(content());
    SearchIndex index = readIndex(in, "room.index", asymmetricRoom().hash());
    spoil(index);
    std::ostringstream out;
    writeIndex(out, index.edges, index.tree, asymmetricRoom().hash());
    return complaint(out.str());
  };
  EXPECT_THAT(complaintAbout([](SearchIndex& index) {
                for (TPoint2D& p : index.tree.vertices) p.x += 1e12;
                for (SearchTree::Level& level : index.tree.levels) {
                  for (BoundingBox& box : level.boxes) {
                    box.min.x += 1e12;
                    box.max.x += 1e12;
                  }
                }
              }),
              HasSubstr("leaves outside the map"));
  // A grid of ten billion squares.
  EXPECT_THAT(complaintAbout([](SearchIndex& index) {
                index.tree.leaf_size = 1e-5;
                index.edges.square_size = 4e-5;
              }),
              HasSubstr("leaf_size is 0.00001"));
}

}  // namespace
}  // namespace mrpt_polyloc::test
