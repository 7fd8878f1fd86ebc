#include "search_fixture.h"
#include <mrpt_polyloc/localization/search/ForestDescent.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <tuple>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

using Leaves = std::vector<TreeDescent::Node>;

constexpr double kLimits[] = {0.1, 0.25, 0.5};  // [m]

struct Descended {
  std::vector<Leaves> leaves;  ///< after each limit
  std::vector<std::size_t> evaluated, below;
  bool is_done = false;
};

bool operator==(const Descended& a, const Descended& b) {
  const auto same = [](const Leaves& x, const Leaves& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const auto& m, const auto& n) {
      return std::tie(m.index, m.heading, m.bound) == std::tie(n.index, n.heading, n.bound);
    });
  };
  return std::equal(a.leaves.begin(), a.leaves.end(), b.leaves.begin(), b.leaves.end(), same) &&
         a.evaluated == b.evaluated && a.below == b.below && a.is_done == b.is_done;
}

/// A descent of any kind through the limits.
template <class Descent, class Expand>
Descended runThrough(const Descent& descent, const BandQuery& query, const Expand& expand) {
  Descended run;
  Leaves leaves;
  for (const double limit : kLimits) {
    EXPECT_TRUE(expand(query.units(limit), leaves));
    run.leaves.push_back(leaves);
    run.evaluated.push_back(descent.evaluated());
    run.below.push_back(descent.countBelow(query.units(2.0 * limit)));
  }
  run.is_done = descent.isDone();
  return run;
}

TEST(ForestDescent, GivesTheLeavesOfOneDescentInItsOrderAtAnyNumberOfThreads) {
  std::mt19937 random(1);
  const SearchedMap built(smallBuilding(2));
  ASSERT_GT(allBlocks(built.tree).size(), 24U);  // several blocks to a part
  const PosePrior anywhere;
  PosePrior near;
  for (const TPoint2D& p : randomFreePoints(built.map, 3, random)) {
    near.near = PosePrior::Disk{p.x, p.y, 2.0};
    const RangeScan scan = simulatedScan(built.map, {p.x, p.y, 0.4});
    const BandQuery query(scan, GlobalLocalizerParams{}.search_cost);
    for (const PosePrior& prior : {anywhere, near}) {
      TreeDescent::Workspace one;
      TreeDescent descent(built.tree, allBlocks(built.tree), query, prior, {0, 0}, one);
      const Descended expected = runThrough(descent, query, [&](unsigned limit, Leaves& leaves) {
        return descent.expandUpTo(
            limit, [] { return false; }, leaves);
      });
      EXPECT_FALSE(expected.leaves.back().empty());
      ForestDescent::Workspace workspace;
      const tbb::global_control three(tbb::global_control::max_allowed_parallelism, 3);
      for (const int threads : {1, 2, 3}) {
        tbb::task_arena arena(threads);
        const Descended found = arena.execute([&] {
          const Budget budget(0.0, nullptr, Budget::Threads::arenas);
          ForestDescent forest(built.tree, query, prior, {0, 0}, budget, 0, workspace);
          return runThrough(forest, query, [&](unsigned limit, Leaves& leaves) {
            return forest.expandUpTo(limit, leaves);
          });
        });
        EXPECT_TRUE(found == expected) << threads << " threads";
      }
    }
  }
}

TEST(ForestDescent, EndsAtTheSameNodeAtAnyNumberOfThreads) {
  const SearchedMap built(smallBuilding(2));
  std::mt19937 random(2);
  const TPoint2D p = randomFreePoints(built.map, 1, random).front();
  const BandQuery query(simulatedScan(built.map, {p.x, p.y, 0.4}),
                        GlobalLocalizerParams{}.search_cost);
  std::size_t evaluated = 0;
  for (const int threads : {1, 2}) {
    tbb::task_arena(threads).execute([&] {
      const Budget budget(0.0, nullptr, Budget::Threads::arenas);
      ForestDescent::Workspace workspace;
      const PosePrior prior;
      constexpr std::size_t kMost = 3000;
      ForestDescent forest(built.tree, query, prior, {0, 0}, budget, kMost, workspace);
      Leaves leaves;
      EXPECT_FALSE(forest.expandUpTo(query.units(2.0), leaves));
      EXPECT_GE(forest.evaluated(), kMost);
      if (evaluated == 0) evaluated = forest.evaluated();
      EXPECT_EQ(forest.evaluated(), evaluated);
    });
  }
}

TEST(ForestDescent, WithoutAnyTimeGoesDownGreedily) {
  const SearchedMap built(smallBuilding(2));
  std::mt19937 random(3);
  const TPoint2D p = randomFreePoints(built.map, 1, random).front();
  const BandQuery query(simulatedScan(built.map, {p.x, p.y, 0.4}),
                        GlobalLocalizerParams{}.search_cost);
  tbb::task_arena(2).execute([&] {
    const std::atomic<bool> is_cancelled{true};
    const Budget budget(0.0, &is_cancelled, Budget::Threads::arenas);
    ForestDescent::Workspace workspace;
    const PosePrior prior;
    ForestDescent forest(built.tree, query, prior, {0, 0}, budget, 0, workspace);
    Leaves leaves;
    EXPECT_FALSE(forest.expandUpTo(query.units(0.5), leaves));
    EXPECT_TRUE(leaves.empty());
    EXPECT_GT(forest.countBelow(query.units(0.5)), 0U);
    forest.greedyDescent(64, leaves);
    EXPECT_FALSE(leaves.empty());
  });
}

}  // namespace
}  // namespace mrpt_polyloc::test
