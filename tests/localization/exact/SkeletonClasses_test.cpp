#include "exact_views.h"
#include "tests/support/map_factories.h"
#include "tests/support/polygon_width.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/localization/exact/ObservedPolygon.h>
#include <mrpt_polyloc/localization/exact/SkeletonClasses.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;
using test::kExactTolerance;
using test::widthOf;

TPoint2D moved(const TPose2D& motion, const TPoint2D& p) {
  const double c = std::cos(motion.phi), s = std::sin(motion.phi);
  return {motion.x + c * p.x - s * p.y, motion.y + s * p.x + c * p.y};
}

std::vector<SkeletonClasses::Embedding> embeddingsOf(const SkeletonClasses& classes,
                                                     std::size_t index) {
  std::vector<SkeletonClasses::Embedding> all;
  classes.forEachEmbedding(index, [&](const auto& embedding) { all.push_back(embedding); });
  return all;
}

TEST(SkeletonClasses, HoldEveryCellOnce) {
  for (const auto& [name, map] : test::namedMaps()) {
    SCOPED_TRACE(name);
    const VisibilityCells cells(map);
    const SkeletonClasses classes(cells, kExactTolerance);
    std::multiset<std::int32_t> held;
    for (std::size_t k = 0; k < classes.size(); ++k) {
      EXPECT_FALSE(embeddingsOf(classes, k).empty());
      for (const auto& embedding : embeddingsOf(classes, k)) held.insert(embedding.cell);
    }
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (widthOf(cells.polygon(c)) < kExactTolerance) continue;
      EXPECT_EQ(held.count(static_cast<std::int32_t>(c)), 1U) << "cell " << c;
    }
  }
}

TEST(SkeletonClasses, CarryTheirSkeletonToEachOfTheirCells) {
  for (const auto& [name, map] : test::namedMaps()) {
    SCOPED_TRACE(name);
    const VisibilityCells cells(map);
    const SkeletonClasses classes(cells, kExactTolerance);
    ViewExpander expander(cells.triangulation(), true);
    for (std::size_t k = 0; k < classes.size(); ++k) {
      const VisibilitySkeleton skeleton = classes.skeleton(k, expander);
      for (const auto& embedding : embeddingsOf(classes, k)) {
        if (embedding.cell == VisibilityCells::kNone) continue;
        const auto cell = static_cast<std::size_t>(embedding.cell);
        const VisibilitySkeleton there = skeletonOf(cells, cell, expander, 2 * kExactTolerance);
        for (const auto& gap : skeleton.gaps()) {
          const TPoint2D p = moved(embedding.pose_map_skeleton, gap.vertex);
          double nearest = 1.0;
          for (const auto& other : there.gaps())
            nearest = std::min(nearest, (other.vertex - p).norm());
          EXPECT_LT(nearest, 1e-6) << "cell " << cell;
        }
      }
    }
  }
}

/// Whether some place of the first cell, carried along, lies in the second one.
bool findCommonPlace(const VisibilityCells& cells, std::size_t a, std::size_t b,
                     const TPose2D& motion, std::mt19937& random, TPoint2D& place) {
  const std::vector<TPoint2D> polygon = cells.polygon(a);
  std::uniform_real_distribution<double> weight(0.05, 1.0);
  for (int k = 0; k < 20; ++k) {
    TPoint2D sum(0, 0);
    double total = 0.0;
    for (const TPoint2D& p : polygon) {
      const double w = weight(random);
      sum = sum + p * w;
      total += w;
    }
    place = sum * (1.0 / total);
    if (cells.distanceOutside(b, moved(motion, place)) == 0.0) return true;
  }
  return false;
}

TEST(SkeletonClasses, AreEqualWhereViewsAreAndOnlyThere) {
  // All pairs of cells: in one class the views from common places are the same, by rays; of two
  // classes no pair of representatives sees the same at the same heading.
  std::mt19937 random(95);
  std::size_t common = 0;
  for (const auto& [name, map] :
       std::vector<std::pair<std::string, PolygonMap>>{{"L", test::lRoomMap()},
                                                       {"comb", test::combMap(4)},
                                                       {"pillars", test::pillarMap(2, 2)},
                                                       {"windmill", test::windmillMap()}}) {
    SCOPED_TRACE(name);
    const VisibilityCells cells(map);
    const SkeletonClasses classes(cells, kExactTolerance);
    const test::RayMap rays(map);
    for (std::size_t k = 0; k < classes.size(); ++k) {
      const auto members = embeddingsOf(classes, k);
      for (const auto& a : members) {
        for (const auto& b : members) {
          if (a.cell < 0 || b.cell < 0 || a.cell >= b.cell) continue;
          const TPose2D& from = a.pose_map_skeleton;
          const TPose2D& to = b.pose_map_skeleton;
          const double turn = to.phi - from.phi;
          const TPoint2D shift = moved(to, {0, 0}) - moved({0, 0, turn}, moved(from, {0, 0}));
          const TPose2D motion(shift.x, shift.y, turn);
          TPoint2D p;
          const auto cell_a = static_cast<std::size_t>(a.cell);
          const auto cell_b = static_cast<std::size_t>(b.cell);
          if (!findCommonPlace(cells, cell_a, cell_b, motion, random, p)) continue;
          ++common;
          const test::RayMap seen(test::seenFrom(map, {p.x, p.y, 0}));
          const TPoint2D q = moved(motion, p);
          EXPECT_TRUE(test::looksAlike(rays, {q.x, q.y, turn}, seen))
              << "cells " << a.cell << " " << b.cell;
        }
      }
    }
    std::vector<std::size_t> representatives;
    for (std::size_t k = 0; k < classes.size(); ++k) {
      const std::int32_t cell = embeddingsOf(classes, k).front().cell;
      if (cell >= 0 && widthOf(cells.polygon(static_cast<std::size_t>(cell))) > 1e-2)
        representatives.push_back(static_cast<std::size_t>(cell));
    }
    for (int k = 0; k < 60; ++k) {
      const std::size_t a = representatives[random() % representatives.size()];
      const std::size_t b = representatives[random() % representatives.size()];
      if (a == b) continue;
      const TPoint2D p = cells.representative(a), q = cells.representative(b);
      const test::RayMap seen(test::seenFrom(map, {p.x, p.y, 0}));
      EXPECT_FALSE(test::looksAlike(rays, {q.x, q.y, 0}, seen)) << "cells " << a << " " << b;
    }
  }
  EXPECT_GT(common, 50U);
}

TEST(SkeletonClasses, FindTheCellThatAPolygonWasSeenFrom) {
  std::mt19937 random(96);
  for (const auto& [name, map] : test::namedMaps()) {
    SCOPED_TRACE(name);
    const VisibilityCells cells(map);
    const SkeletonClasses classes(cells, kExactTolerance);
    ViewExpander expander(cells.triangulation(), true);
    for (const TPoint2D& p : test::randomFreePoints(map, 40, random)) {
      const TPose2D pose(p.x, p.y, 0.7);
      const ObservedPolygon seen(test::seenFrom(map, pose), kExactTolerance);
      if (!seen.isClear()) continue;  // where the query does not ask the classes
      const std::int32_t cell = cells.locate(p);
      bool is_found = false;
      for (const auto& match : classes.find(seen.skeleton(), expander)) {
        for (const auto& embedding : embeddingsOf(classes, match.index)) {
          is_found = is_found || embedding.cell == cell;
        }
      }
      EXPECT_TRUE(is_found) << "cell " << cell << " from " << p.x << " " << p.y;
    }
  }
}

TEST(SkeletonClasses, MissNothingAtTheBordersOfLookUp) {
  // Vertices moved by up to the tolerance, again and again: the look-up finds the class each time.
  const PolygonMap map = test::pillarMap();
  const VisibilityCells cells(map);
  const SkeletonClasses classes(cells, kExactTolerance);
  ViewExpander expander(cells.triangulation(), true);
  std::mt19937 random(97);
  std::uniform_real_distribution<double> noise(-0.7 * kExactTolerance, 0.7 * kExactTolerance);
  for (int k = 0; k < 500; ++k) {
    const std::size_t cell = random() % cells.size();
    std::vector<VisibilitySkeleton::Gap> gaps =
        skeletonOf(cells, cell, expander, 2 * kExactTolerance).gaps();
    for (auto& gap : gaps) {
      gap.vertex = gap.vertex + TPoint2D(noise(random), noise(random));
      gap.a = gap.a + TPoint2D(noise(random), noise(random));
      gap.b = gap.b + TPoint2D(noise(random), noise(random));
    }
    bool is_found = false;
    for (const auto& match : classes.find(VisibilitySkeleton(gaps), expander)) {
      for (const auto& embedding : embeddingsOf(classes, match.index)) {
        is_found = is_found || embedding.cell == static_cast<std::int32_t>(cell);
      }
    }
    EXPECT_TRUE(is_found) << "cell " << cell;
  }
}

}  // namespace
}  // namespace mrpt_polyloc
