#include "tests/support/simulated_scans.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/search/search_index_file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace mrpt_polyloc::test {
namespace {

using ::testing::HasSubstr;

class SearchIndexFile : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    content_ = new std::string(GlobalLocalizer(asymmetricRoom()).serializedIndex());
  }
  static void TearDownTestSuite() { delete content_; }

  /// What reading a content as the room's index says; empty: nothing.
  static std::string complaint(const std::string& content) {
    return messageOf<FormatError>(
        [&] { GlobalLocalizer(asymmetricRoom(), content, "room.index"); });
  }

  static const std::string& content() { return *content_; }

 private:
  static std::string* content_;
};
std::string* SearchIndexFile::content_ = nullptr;

TEST_F(SearchIndexFile, GivesTheSameAnswers) {
  const GlobalLocalizer built(asymmetricRoom()), read(asymmetricRoom(), content(), "room.index");
  const RangeScan scan = simulatedScan(asymmetricRoom(), {1.5, 1.0, 0.4});
  const LocalizationResult a = built.localize(scan), b = read.localize(scan);
  ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size());
  for (std::size_t i = 0; i < a.hypotheses.size(); ++i) {
    EXPECT_EQ(a.hypotheses[i].pose_map_robot, b.hypotheses[i].pose_map_robot);
  }
  EXPECT_EQ(a.statistics.evaluated, b.statistics.evaluated);
  EXPECT_EQ(a.certificate->cost, b.certificate->cost);
  EXPECT_EQ(read.serializedIndex(), content());
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
  EXPECT_THAT(
      messageOf<FormatError>([&] { GlobalLocalizer(squareMap(3.0), content(), "room.index"); }),
      HasSubstr("the index of another map"));
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

}  // namespace
}  // namespace mrpt_polyloc::test
