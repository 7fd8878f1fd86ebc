#include <mrpt_polyloc/visibility/packed_runs.h>

#include <gtest/gtest.h>

#include <random>

namespace mrpt_polyloc {
namespace {

using EdgeRun = BoundaryChains::Run;

std::vector<EdgeRun> unpacked(const std::vector<std::uint8_t>& bytes) {
  std::vector<EdgeRun> runs;
  unpackRuns(bytes.data(), bytes.data() + bytes.size(), runs);
  return runs;
}

bool areRuns(const std::vector<std::uint8_t>& bytes, std::size_t vertices) {
  return arePackedRuns(bytes.data(), bytes.data() + bytes.size(), vertices);
}

TEST(PackedRuns, ComeBackAsTheyWere) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<EdgeRun> runs;
    std::uint32_t end = 0;
    for (std::size_t count = random() % 60; runs.size() < count;) {
      // Of all sizes that take another number of bytes, 0 among them.
      const auto gap = static_cast<std::uint32_t>(random() >> (random() % 21 + 11));
      const auto edges = static_cast<std::uint32_t>(random() >> (random() % 21 + 11));
      runs.push_back({end + gap, edges});
      end += gap + edges;
    }
    std::vector<std::uint8_t> bytes;
    packRuns(runs, bytes);
    const std::vector<EdgeRun> back = unpacked(bytes);
    ASSERT_EQ(back.size(), runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
      EXPECT_EQ(back[i].first, runs[i].first);
      EXPECT_EQ(back[i].edges, runs[i].edges);
    }
    EXPECT_TRUE(areRuns(bytes, std::size_t{end} + 1));
    EXPECT_EQ(areRuns(bytes, end), runs.empty());  // the last edge needs a vertex more
  }
}

TEST(PackedRuns, TakeTwoBytesWhereTheyAreShortAndNear) {
  std::vector<std::uint8_t> bytes;
  packRuns({{100, 3}, {120, 27}, {274, 1}}, bytes);
  EXPECT_EQ(bytes.size(), 6U);
}

TEST(PackedRuns, AreToldFromOtherBytes) {
  EXPECT_TRUE(areRuns({}, 0));
  EXPECT_FALSE(areRuns({5}, 100));           // no number of edges
  EXPECT_FALSE(areRuns({5, 0x83}, 100));     // cut short in it
  EXPECT_FALSE(areRuns({5, 3, 200}, 1000));  // and in the next run
  EXPECT_FALSE(areRuns({5, 95}, 100));       // beyond the last vertex
  EXPECT_TRUE(areRuns({5, 94}, 100));
  EXPECT_FALSE(areRuns({0xff, 0xff, 0xff, 0xff, 0x1f, 1}, 1UL << 40));  // more than 32 bits
  EXPECT_FALSE(areRuns({0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0}, 100));  // without an end
}

}  // namespace
}  // namespace mrpt_polyloc
