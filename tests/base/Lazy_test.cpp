#include <mrpt_polyloc/base/Lazy.h>

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace mrpt_polyloc {
namespace {

TEST(Lazy, IsMadeOnceWhoeverAsks) {
  const Lazy<int> lazy;
  std::atomic<int> made{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] { EXPECT_EQ(lazy.get([&] { return ++made, 7; }), 7); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(made, 1);
  EXPECT_TRUE(lazy.isMade());
}

TEST(Lazy, IsTriedAgainAfterAnException) {
  const Lazy<int> lazy;
  EXPECT_THROW(lazy.get([]() -> int { throw std::runtime_error("no"); }), std::runtime_error);
  EXPECT_FALSE(lazy.isMade());
  EXPECT_EQ(lazy.get([] { return 3; }), 3);
}

}  // namespace
}  // namespace mrpt_polyloc
