#include <mrpt_polyloc/localization/nearest_cells/MetricTree.h>
#include <mrpt_polyloc/polar/PolarMetric.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <tests/support/polar_oracle.h>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPoint2D;

struct Euclidean {
  double operator()(const TPoint2D& a, const TPoint2D& b) const {
    return std::hypot(a.x - b.x, a.y - b.y);
  }
};
struct WithCompass {
  double operator()(const SampledPolarFunction& a, const SampledPolarFunction& b) const {
    return distance(a, b);
  }
};
struct OverRotations {
  double operator()(const SampledPolarFunction& a, const SampledPolarFunction& b) const {
    return distanceOverRotations(a, b).distance;
  }
};

constexpr double kError = 1e-9;  // of the metrics' rounding

std::vector<TPoint2D> randomPoints(std::mt19937& random, std::size_t n) {
  std::uniform_real_distribution<double> uniform(0, 10);
  std::vector<TPoint2D> points;
  for (std::size_t i = 0; i < n; ++i) points.emplace_back(uniform(random), uniform(random));
  return points;
}

/// All objects by distance, by trying each.
template <class Tree, class Object, class Metric>
std::vector<typename Tree::Neighbor> allByDistance(const Tree& tree, const Object& query,
                                                   Metric metric,
                                                   const std::vector<double>& radii) {
  std::vector<typename Tree::Neighbor> all;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const double radius = radii.empty() ? 0.0 : radii[i];
    all.push_back({i, std::max(0.0, metric(query, tree.objects()[i]) - radius)});
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.index < b.index);
  });
  return all;
}

template <class Neighbors>
void expectSame(const Neighbors& found, const Neighbors& all, std::size_t count) {
  ASSERT_EQ(found.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(found[i].index, all[i].index) << i;
    EXPECT_EQ(found[i].distance, all[i].distance) << i;
  }
}

template <class Object, class Metric>
void expectAgreesWithTryingAll(const MetricTree<Object, Metric>& tree, const Object& query,
                               const std::vector<double>& radii = {}) {
  const auto all = allByDistance(tree, query, Metric(), radii);
  for (const std::size_t count : {std::size_t{1}, std::size_t{5}, std::size_t{40}, tree.size() + 3})
    expectSame(tree.nearest(query, count).neighbors, all, std::min(count, tree.size()));
  for (const std::size_t rank : {std::size_t{0}, tree.size() / 10, tree.size() - 1}) {
    const double reach = all[rank].distance;
    const auto inside = static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [&](const auto& n) { return n.distance <= reach; }));
    expectSame(tree.within(query, reach).neighbors, all, inside);
  }
}

/// That the radii are right, never grow on the way down, and every object is there once.
template <class Object, class Metric>
void expectMonotonous(const MetricTree<Object, Metric>& tree) {
  const auto& nodes = tree.nodes();
  EXPECT_EQ(nodes.size() + 1, tree.size());
  std::multiset<std::size_t> pivots;
  pivots.insert(nodes.empty() ? 0 : nodes[0].home);
  for (const auto& node : nodes) {
    pivots.insert(node.away);
    const auto check = [&](std::int32_t child, std::size_t pivot, double radius) {
      if (child < 0) return;
      const auto& below = nodes[static_cast<std::size_t>(child)];
      EXPECT_EQ(below.home, pivot);
      EXPECT_LE(below.home_radius, radius);
      EXPECT_EQ(below.depth, node.depth + 1);
      EXPECT_LE(Metric()(tree.objects()[below.away], tree.objects()[pivot]), radius + kError);
    };
    check(node.home_child, node.home, node.home_radius);
    check(node.away_child, node.away, node.away_radius);
  }
  EXPECT_EQ(pivots.size(), tree.size());
  EXPECT_EQ(std::set<std::size_t>(pivots.begin(), pivots.end()).size(), tree.size());
}

TEST(MetricTreeTest, PointsAgreeWithTryingAll) {
  std::mt19937 random(1);
  for (const std::size_t n : {1U, 2U, 3U, 10U, 100U, 1000U}) {
    const MetricTree<TPoint2D, Euclidean> tree(randomPoints(random, n), {}, {}, 7, kError);
    expectMonotonous(tree);
    for (const TPoint2D& query : randomPoints(random, 50)) expectAgreesWithTryingAll(tree, query);
    for (std::size_t i = 0; i < std::min<std::size_t>(n, 20); ++i)
      EXPECT_EQ(tree.nearest(tree.objects()[i], 1).neighbors[0].index, i);
  }
}

TEST(MetricTreeTest, BallsAgreeWithTryingAll) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> radii(500);
  for (double& radius : radii) radius = std::pow(uniform(random), 8);
  const MetricTree<TPoint2D, Euclidean> tree(randomPoints(random, 500), {}, radii, 7, kError);
  for (const TPoint2D& query : randomPoints(random, 100))
    expectAgreesWithTryingAll(tree, query, radii);
}

TEST(MetricTreeTest, EvaluatesFewDistances) {
  std::mt19937 random(3);
  const std::size_t n = 20000;
  const MetricTree<TPoint2D, Euclidean> tree(randomPoints(random, n));
  EXPECT_LT(tree.buildEvaluations(), 40 * n);
  std::size_t evaluations = 0;
  for (const TPoint2D& query : randomPoints(random, 100))
    evaluations += tree.nearest(query, 1).evaluations;
  EXPECT_LT(evaluations, 100 * n / 50);
  EXPECT_GE(evaluations, 100U);
}

TEST(MetricTreeTest, ViewsAgreeWithTryingAll) {
  std::mt19937 random(4);
  std::vector<SampledPolarFunction> views, queries;
  for (int i = 0; i < 300; ++i) views.emplace_back(test::randomPolarFunction(random), 60);
  for (int i = 0; i < 20; ++i) {
    auto samples = views[static_cast<std::size_t>(13 * i)].samples();
    std::normal_distribution<float> noise(0.0F, 0.05F);
    for (float& sample : samples) sample = std::max(0.0F, sample + noise(random));
    std::rotate(samples.begin(), samples.begin() + i, samples.end());
    queries.emplace_back(samples);
  }
  const MetricTree<SampledPolarFunction, WithCompass> compass(views, {}, {}, 1, kError);
  const MetricTree<SampledPolarFunction, OverRotations> free(views, {}, {}, 1, kError);
  expectMonotonous(compass);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const auto all = allByDistance(compass, queries[i], WithCompass(), {});
    expectSame(compass.nearest(queries[i], 10).neighbors, all, 10);
    const auto turned = free.nearest(queries[i], 3);
    EXPECT_EQ(turned.neighbors[0].index, 13 * i);
    const auto turned_all = allByDistance(free, queries[i], OverRotations(), {});
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_NEAR(turned.neighbors[j].distance, turned_all[j].distance, 1e-9);
  }
}

TEST(MetricTreeTest, EqualObjectsAreNoTrap) {
  const MetricTree<TPoint2D, Euclidean> tree(std::vector<TPoint2D>(5000, {1, 2}));
  std::size_t depth = 0;
  for (const auto& node : tree.nodes()) depth = std::max(depth, node.depth);
  EXPECT_LT(depth, 20U);
  const auto result = tree.nearest(TPoint2D(1, 3), 3);
  EXPECT_EQ(result.neighbors[0].index, 0U);
  EXPECT_EQ(result.neighbors[2].index, 2U);
  EXPECT_EQ(result.neighbors[2].distance, 1.0);
  EXPECT_EQ(tree.within(TPoint2D(1, 2), 0.0).neighbors.size(), 5000U);
}

TEST(MetricTreeTest, AnUnluckyMetricIsDeepButRight) {
  // Each point is farther than all that follow are from each other: every split takes one off.
  std::vector<TPoint2D> points;
  for (int i = 0; i < 800; ++i) points.emplace_back(std::pow(0.5, i), 0.0);
  const MetricTree<TPoint2D, Euclidean> tree(points);
  const auto result = tree.nearest(TPoint2D(0.26, 0.0), 2);
  EXPECT_EQ(result.neighbors[0].index, 2U);
  EXPECT_EQ(result.neighbors[1].index, 3U);
}

TEST(MetricTreeTest, TheSeedChoosesTheTreeAndNotTheAnswer) {
  std::mt19937 random(5);
  const auto points = randomPoints(random, 400);
  const MetricTree<TPoint2D, Euclidean> a(points, {}, {}, 1), b(points, {}, {}, 1),
      c(points, {}, {}, 2);
  EXPECT_EQ(a.nodes()[0].home, b.nodes()[0].home);
  EXPECT_EQ(a.buildEvaluations(), b.buildEvaluations());
  EXPECT_NE(a.nodes()[0].home, c.nodes()[0].home);
  for (const TPoint2D& query : randomPoints(random, 20))
    EXPECT_EQ(a.nearest(query, 1).neighbors[0].index, c.nearest(query, 1).neighbors[0].index);
}

TEST(MetricTreeTest, NothingToFind) {
  const MetricTree<TPoint2D, Euclidean> empty(std::vector<TPoint2D>{});
  EXPECT_TRUE(empty.nearest(TPoint2D(0, 0), 3).neighbors.empty());
  EXPECT_TRUE(empty.within(TPoint2D(0, 0), 3).neighbors.empty());
  const MetricTree<TPoint2D, Euclidean> one({{1, 1}});
  EXPECT_TRUE(one.nearest(TPoint2D(0, 0), 0).neighbors.empty());
  EXPECT_EQ(one.nearest(TPoint2D(0, 0), 3).neighbors.size(), 1U);
  EXPECT_TRUE(one.within(TPoint2D(0, 0), 1.0).neighbors.empty());
}

TEST(MetricTreeTest, RefusesWrongRadii) {
  using Tree = MetricTree<TPoint2D, Euclidean>;
  const std::vector<TPoint2D> two{{0, 0}, {1, 1}};
  EXPECT_THROW(Tree(two, {}, {1.0}), InvalidParamsError);
  EXPECT_THROW(Tree(two, {}, {1.0, -1.0}), InvalidParamsError);
  EXPECT_THROW(Tree(two, {}, {std::nan(""), 1.0}), InvalidParamsError);
  EXPECT_THROW(Tree(two, {}, {}, 0, -1.0), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
