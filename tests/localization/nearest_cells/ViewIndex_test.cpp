#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/nearest_cells/ViewIndex.h>
#include <mrpt_polyloc/polar/PolarMetric.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <tests/support/polar_oracle.h>

namespace mrpt_polyloc {
namespace {

constexpr std::size_t kSamples = 60;

/// Views of which many are near others, as those of neighbouring cells.
std::vector<SampledPolarFunction> randomViews(std::mt19937& random, std::size_t n) {
  std::normal_distribution<float> noise(0.0F, 0.05F);
  std::vector<SampledPolarFunction> views;
  while (views.size() < n) {
    const SampledPolarFunction view(test::randomPolarFunction(random), kSamples);
    views.push_back(view);
    for (std::size_t i = random() % 5; i > 0 && views.size() < n; --i) {
      std::vector<float> samples = view.samples();
      for (float& sample : samples) sample = std::max(0.0F, sample + noise(random));
      views.emplace_back(std::move(samples));
    }
  }
  return views;
}

SampledPolarFunction turnedNoisily(const SampledPolarFunction& view, std::size_t turn,
                                   std::mt19937& random) {
  std::normal_distribution<float> noise(0.0F, 0.2F);
  std::vector<float> samples = view.samples();
  for (float& sample : samples) sample = std::max(0.0F, sample + noise(random));
  std::rotate(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(turn), samples.end());
  return SampledPolarFunction(std::move(samples));
}

SampledPolarFunction halfOf(const SampledPolarFunction& view) {
  std::vector<float> samples = view.samples();
  std::fill(samples.begin(), samples.begin() + kSamples / 2,
            std::numeric_limits<float>::quiet_NaN());
  return SampledPolarFunction(std::move(samples));
}

/// All views by distance, by comparing with each.
std::vector<ViewIndex::Neighbor> allByDistance(const ViewIndex& index,
                                               const ViewIndex::Query& query) {
  std::vector<ViewIndex::Neighbor> all;
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (query.accepts && !query.accepts(i)) continue;
    std::vector<float> samples = index.views()[i].samples();
    for (float& sample : samples) sample = std::min(sample, static_cast<float>(query.reach));
    const auto match =
        distanceOverRotations(query.scan, SampledPolarFunction(samples), query.rotations);
    all.push_back({i, match.distance, match.finer_rotation});
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.view < b.view);
  });
  return all;
}

void expectAgrees(const ViewIndex& index, const ViewIndex::Query& query) {
  const auto all = allByDistance(index, query);
  for (const std::size_t count : {std::size_t{1}, std::size_t{7}, index.size() + 3}) {
    const auto found = index.nearest(query, count);
    ASSERT_EQ(found.size(), std::min(count, all.size()));
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].view, all[i].view) << i;
      EXPECT_EQ(found[i].distance, all[i].distance) << i;
      EXPECT_EQ(found[i].rotation, all[i].rotation) << i;
    }
  }
}

TEST(ViewIndexTest, AgreesWithComparingAll) {
  std::mt19937 random(41);
  for (const std::size_t n : {1U, 2U, 16U, 17U, 500U}) {
    const ViewIndex index(randomViews(random, n));
    for (int round = 0; round < 8; ++round) {
      const SampledPolarFunction scan =
          turnedNoisily(index.views()[random() % n], random() % kSamples, random);
      expectAgrees(index, {scan, {}, std::numeric_limits<double>::infinity(), {}});
      expectAgrees(index, {scan, {1.0 * round, 0.3}, std::numeric_limits<double>::infinity(), {}});
      expectAgrees(index, {scan, {}, 4.0, {}});
      const SampledPolarFunction half = halfOf(scan);
      expectAgrees(index, {half, {}, std::numeric_limits<double>::infinity(), {}});
      expectAgrees(index, {half, {0.5, 0.0}, 3.0, {}});
      expectAgrees(index, {scan, {}, std::numeric_limits<double>::infinity(), [](std::size_t view) {
                             return view % 3 == 1;
                           }});
    }
  }
}

TEST(ViewIndexTest, ComparesWithFew) {
  std::mt19937 random(42);
  const ViewIndex index(randomViews(random, 3000));
  std::size_t evaluations = 0, partial_evaluations = 0;
  constexpr std::size_t kQueries = 20;
  for (std::size_t i = 0; i < kQueries; ++i) {
    const std::size_t view = 137 * i;
    // A clean one, as a scan taken at a representative.
    std::vector<float> samples = index.views()[view].samples();
    std::rotate(samples.begin(), samples.begin() + 11, samples.end());
    const SampledPolarFunction scan(samples);
    const auto first = [&](const ViewIndex::Neighbor& neighbor) {
      EXPECT_EQ(neighbor.view, view);
      return false;
    };
    const double infinity = std::numeric_limits<double>::infinity();
    evaluations += index.visitNearest({scan, {}, infinity, {}}, first);
    const SampledPolarFunction half = halfOf(scan);
    partial_evaluations += index.visitNearest({half, {}, infinity, {}}, first);
  }
  EXPECT_LT(evaluations, 3000 * kQueries / 20);
  EXPECT_LT(partial_evaluations, 3000 * kQueries / 4);
}

TEST(ViewIndexTest, OfEqualViewsTheFirst) {
  const std::vector<float> circle(kSamples, 2.0F);
  const ViewIndex index(std::vector<SampledPolarFunction>(40, SampledPolarFunction(circle)));
  const SampledPolarFunction scan(circle);
  const auto found = index.nearest({scan, {}, std::numeric_limits<double>::infinity(), {}}, 3);
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(found[i].view, i);
}

TEST(ViewIndexTest, NothingToFind) {
  const SampledPolarFunction scan(std::vector<float>(kSamples, 1.0F));
  const ViewIndex empty({});
  EXPECT_TRUE(empty.nearest({scan, {}, 5.0, {}}, 3).empty());
  const ViewIndex one({scan});
  EXPECT_TRUE(one.nearest({scan, {}, 5.0, {}}, 0).empty());
  EXPECT_TRUE(one.nearest({scan, {}, 5.0, [](std::size_t) { return false; }}, 3).empty());
}

TEST(ViewIndexTest, RefusesViewsThatCannotBeCompared) {
  const SampledPolarFunction view(std::vector<float>(kSamples, 1.0F));
  EXPECT_THROW(ViewIndex({view, SampledPolarFunction(std::vector<float>(72, 1.0F))}),
               InvalidParamsError);
  EXPECT_THROW(ViewIndex({halfOf(view)}), InvalidParamsError);
  EXPECT_THROW(ViewIndex({SampledPolarFunction(std::vector<float>(20, 1.0F))}), InvalidParamsError);
  const ViewIndex index({view});
  const SampledPolarFunction other(std::vector<float>(72, 1.0F));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(index.nearest({other, {}, infinity, {}}, 1), InvalidParamsError);
  EXPECT_THROW(index.nearest({view, {0.0, -1.0}, infinity, {}}, 1), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
