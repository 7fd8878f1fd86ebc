#include <mrpt_polyloc/base/Budget.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <set>
#include <thread>
#include <vector>

namespace mrpt_polyloc {
namespace {

/// More threads than the machine may have cores.
class OnFourThreads : public ::testing::Test {
 protected:
  tbb::task_arena arena_{4};

 private:
  tbb::global_control threads_{tbb::global_control::max_allowed_parallelism, 4};
};

TEST_F(OnFourThreads, BudgetCallsForEachOnce) {
  for (const auto threads : {Budget::Threads::callers, Budget::Threads::arenas}) {
    const Budget budget(0.0, nullptr, threads);
    for (const std::size_t count : {0U, 1U, 7U, 1000U}) {
      for (const std::size_t least : {1U, 64U}) {
        std::vector<std::atomic<int>> calls(count);
        arena_.execute([&] { budget.forEach(count, least, [&](std::size_t i) { ++calls[i]; }); });
        for (const std::atomic<int>& of_one : calls) EXPECT_EQ(of_one, 1);
      }
    }
  }
}

TEST_F(OnFourThreads, BudgetKeepsToTheCallersUnlessAsked) {
  const Budget budget;
  EXPECT_EQ(budget.threads(), 1U);
  std::set<std::thread::id> threads;
  budget.forEach(1000, 1, [&](std::size_t) { threads.insert(std::this_thread::get_id()); });
  EXPECT_EQ(threads, std::set<std::thread::id>{std::this_thread::get_id()});
  arena_.execute([] { EXPECT_EQ(Budget(0.0, nullptr, Budget::Threads::arenas).threads(), 4U); });
}

/// A thread that waits for its own loop must not take another answer of a loop around it: what the
/// first has in its workspaces would be lost.
TEST_F(OnFourThreads, BudgetHasNoThreadBeginAnythingElseWhileItWaits) {
  const Budget budget(0.0, nullptr, Budget::Threads::arenas);
  std::atomic<int> nested{0};
  arena_.execute([&] {
    tbb::parallel_for(0, 150, [&](int) {
      thread_local int depth = 0;
      if (++depth > 1) ++nested;
      // The one that is done first waits for the other, which somebody else may have taken.
      budget.forEach(2, 1, [](std::size_t i) {
        std::this_thread::sleep_for(std::chrono::microseconds(100 + 400 * i));
      });
      --depth;
    });
  });
  EXPECT_EQ(nested, 0);
}

}  // namespace
}  // namespace mrpt_polyloc
