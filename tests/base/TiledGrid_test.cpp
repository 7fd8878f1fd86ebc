#include <mrpt_polyloc/base/TiledGrid.h>

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>

namespace mrpt_polyloc {
namespace {

TEST(TiledGrid, HoldsWhatAMapHolds) {
  std::mt19937 random(5);
  for (const auto& [columns, rows] : {std::pair{1, 1}, {64, 64}, {65, 63}, {700, 300}}) {
    TiledGrid grid(columns, rows);
    std::map<std::pair<int, int>, std::int32_t> expected;  // by row, column
    std::uniform_int_distribution<int> column(0, columns - 1), row(0, rows - 1);
    for (int i = 0; i < 400; ++i) {
      const int c = column(random), r = row(random);
      grid.put(c, r, i);
      expected[{r, c}] = i;
    }
    for (int i = 0; i < 1000; ++i) {
      const int c = column(random), r = row(random);
      const auto found = expected.find({r, c});
      EXPECT_EQ(grid.at(c, r), found == expected.end() ? TiledGrid::kNone : found->second);
    }
    auto next = expected.begin();
    grid.forEach([&](int c, int r, std::int32_t value) {
      ASSERT_NE(next, expected.end());
      EXPECT_EQ(next->first, std::make_pair(r, c));
      EXPECT_EQ(next->second, value);
      ++next;
    });
    EXPECT_EQ(next, expected.end());
    const int left = column(random) / 2, low = row(random) / 2;
    std::size_t visited = 0, within = 0;
    grid.forEachIn(left, columns - 1, low, rows - 1, [&](int, int, std::int32_t) { ++visited; });
    for (const auto& [place, value] : expected)
      within += place.first >= low && place.second >= left;
    EXPECT_EQ(visited, within);
  }
}

TEST(TiledGrid, OfALargeBoxTakesLittle) {
  TiledGrid grid(100'000, 100'000);
  grid.put(0, 0, 1);
  grid.put(99'999, 99'999, 2);
  EXPECT_LT(grid.bytes(), 12'000'000U);
}

}  // namespace
}  // namespace mrpt_polyloc
