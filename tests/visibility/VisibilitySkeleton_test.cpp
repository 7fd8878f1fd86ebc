#include "tests/support/map_factories.h"
#include "tests/support/polygon_width.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/wkt.h>
#include <mrpt_polyloc/visibility/VisibilitySkeleton.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace mrpt_polyloc {
namespace {

using test::widthOf;
using Gap = VisibilitySkeleton::Gap;

constexpr double kFlat = 2e-6;
constexpr double kSame = 1e-7;

/// The skeleton turned by `angle`, moved, and started at another gap.
VisibilitySkeleton moved(const VisibilitySkeleton& skeleton, double angle, const TPoint2D& by,
                         std::size_t start) {
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<Gap> gaps = skeleton.gaps();
  for (Gap& gap : gaps) {
    for (TPoint2D* p : {&gap.vertex, &gap.a, &gap.b}) {
      *p = TPoint2D(c * p->x - s * p->y + by.x, s * p->x + c * p->y + by.y);
    }
  }
  std::rotate(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(start % gaps.size()),
              gaps.end());
  return VisibilitySkeleton(std::move(gaps));
}

/// Whether some translation alone carries one to the other.
bool equalUpToTranslation(const VisibilitySkeleton& a, const VisibilitySkeleton& b,
                          double tolerance) {
  const auto found = alignments(a, b, tolerance);
  return std::any_of(found.begin(), found.end(), [&](const auto& motion) {
    return std::abs(motion.phi) * b.ringLength() <= 2.0 * tolerance * static_cast<double>(b.size());
  });
}

VisibilitySkeleton mirrored(const VisibilitySkeleton& skeleton) {
  std::vector<Gap> gaps;
  const std::size_t q = skeleton.size();
  const auto flip = [](const TPoint2D& p) { return TPoint2D(-p.x, p.y); };
  for (std::size_t i = 0; i < q; ++i) {
    const Gap& gap = skeleton.gaps()[q - 1 - i];
    const Gap& next = skeleton.gaps()[(q - i) % q];
    gaps.push_back({flip(next.vertex), flip(gap.b), flip(gap.a), gap.ends, gap.begins});
  }
  return VisibilitySkeleton(std::move(gaps));
}

class Skeletons {
 public:
  explicit Skeletons(const PolygonMap& map) : cells(map), expander_(cells.triangulation(), true) {}
  VisibilitySkeleton of(std::size_t cell) { return skeletonOf(cells, cell, expander_, kFlat); }
  VisibilitySkeleton at(const TPoint2D& p) {
    return skeletonOf(cells.triangulation(), expander_.expand(p), kFlat);
  }
  VisibilityCells cells;

 private:
  ViewExpander expander_;
};

std::vector<std::pair<std::string, PolygonMap>> skeletonMaps() {
  std::vector<std::pair<std::string, PolygonMap>> all;
  for (auto& [name, map] : test::namedMaps()) all.emplace_back(name, map);
  all.emplace_back("open edges", test::withOpenEdges(test::pillarMap(), 0.3, 5));
  return all;
}

TEST(VisibilitySkeleton, IsOneThroughoutACell) {
  std::mt19937 random(81);
  std::uniform_real_distribution<double> weight(0.1, 1.0);
  for (const auto& [name, map] : skeletonMaps()) {
    SCOPED_TRACE(name);
    Skeletons skeletons(map);
    for (int k = 0; k < 200; ++k) {
      const std::size_t cell = random() % skeletons.cells.size();
      const std::vector<TPoint2D> polygon = skeletons.cells.polygon(cell);
      if (widthOf(polygon) < 1e-6) continue;
      TPoint2D inside(0, 0);
      double total = 0.0;
      for (const TPoint2D& p : polygon) {
        const double w = weight(random);
        inside = inside + p * w;
        total += w;
      }
      const VisibilitySkeleton here = skeletons.at(inside * (1.0 / total));
      EXPECT_TRUE(equalUpToTranslation(skeletons.of(cell), here, kSame)) << "cell " << cell;
    }
  }
}

/// Vertices of the map on straight walls: nobody sees them.
std::set<std::pair<double, double>> flatVertices(const PolygonMap& map) {
  std::set<std::pair<double, double>> flat;
  for (const Ring* ring : map.rings()) {
    const auto& v = ring->vertices;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const TPoint2D &a = v[(i + v.size() - 1) % v.size()], &b = v[i], &c = v[(i + 1) % v.size()];
      const TPoint2D ac = c - a, ab = b - a;
      if (std::abs(ac.x * ab.y - ac.y * ab.x) <= kFlat * ac.norm()) flat.insert({b.x, b.y});
    }
  }
  return flat;
}

TEST(VisibilitySkeleton, DiffersAcrossCriticalSegments) {
  std::mt19937 random(82);
  for (const auto& [name, map] : skeletonMaps()) {
    if (name == "touching holes") continue;  // walls that touch walls hide where rings bend
    SCOPED_TRACE(name);
    Skeletons skeletons(map);
    const auto flat = flatVertices(map);
    for (int k = 0; k < 200; ++k) {
      const std::size_t cell = random() % skeletons.cells.size();
      if (widthOf(skeletons.cells.polygon(cell)) < 1e-6) continue;
      const VisibilitySkeleton here = skeletons.of(cell);
      for (std::size_t e = 0; e < skeletons.cells.edgeCount(cell); ++e) {
        const std::int32_t next = skeletons.cells.neighbor(cell, e);
        if (next == VisibilityCells::kNone) continue;
        const auto other = static_cast<std::size_t>(next);
        if (widthOf(skeletons.cells.polygon(other)) < 1e-6) continue;
        const auto changes = skeletons.cells.changesAcross(cell, e);
        const auto isCorner = [&](const VisibilityCells::Change& change) {
          const TPoint2D& p =
              skeletons.cells.triangulation().vertices()[static_cast<std::size_t>(change.vertex)];
          return flat.count({p.x, p.y}) == 0;
        };
        if (std::none_of(changes.begin(), changes.end(), isCorner)) continue;
        EXPECT_FALSE(equalUpToTranslation(here, skeletons.of(other), kSame))
            << "cells " << cell << " " << other;
      }
    }
  }
}

TEST(VisibilitySkeleton, IsFoundAgainAfterAnyMotionAndAnyStart) {
  std::mt19937 random(83);
  std::uniform_real_distribution<double> angle(-3.0, 3.0), shift(-20.0, 20.0);
  for (const auto& [name, map] : test::namedMaps()) {
    if (std::string(name) == "pillars at 1e6") continue;  // turned about a far origin
    SCOPED_TRACE(name);
    Skeletons skeletons(map);
    for (int k = 0; k < 30; ++k) {
      const VisibilitySkeleton skeleton = skeletons.of(random() % skeletons.cells.size());
      const double turn = angle(random);
      const TPoint2D by(shift(random), shift(random));
      const VisibilitySkeleton other = moved(skeleton, turn, by, random());
      EXPECT_EQ(other.key(), skeleton.key());
      EXPECT_NEAR(other.ringLength(), skeleton.ringLength(), 1e-9);
      const auto found = alignments(skeleton, other, kSame);
      EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const auto& motion) {
        return angleBetween(motion.phi, turn) < 1e-7 && std::abs(motion.x - by.x) < 1e-6 &&
               std::abs(motion.y - by.y) < 1e-6;
      }));
      EXPECT_TRUE(equalUpToTranslation(skeleton, moved(skeleton, 0, by, random()), kSame));
      if (std::abs(turn) > 0.01 && found.size() == 1) {
        EXPECT_FALSE(equalUpToTranslation(skeleton, other, kSame));
      }
    }
  }
}

TEST(VisibilitySkeleton, OfASquareAlignsFourTimesWithItself) {
  Skeletons skeletons(test::squareMap());
  const VisibilitySkeleton square = skeletons.of(0);
  EXPECT_EQ(square.size(), 4U);
  EXPECT_EQ(square.period(), 1U);
  EXPECT_EQ(alignments(square, square, kSame).size(), 4U);
  EXPECT_TRUE(alignments(square, moved(square, 0, {0, 0}, 1), kSame).size() == 4U);
}

TEST(VisibilitySkeleton, OfAWindmillNeedsNoEdgeInFull) {
  // datasets/windmill.wkt: from the middle parts of three edges are seen and none in full.
  const RawMap raw =
      parseWkt("POLYGON ((0 1, -3.86 -4.6, -0.87 -0.5, 5.91 -1.04, 0.87 -0.5, -2.05 5.64, 0 1))",
               "windmill");
  std::vector<TPoint2D> outer = raw.polygons.front().outer.vertices;
  if (outer.front() == outer.back()) outer.pop_back();
  Skeletons skeletons(test::mapOf(outer));
  const VisibilitySkeleton middle = skeletons.at({0, 0});
  EXPECT_EQ(middle.size(), 3U);
  for (const Gap& gap : middle.gaps()) EXPECT_FALSE(gap.begins && gap.ends);
  EXPECT_EQ(alignments(middle, moved(middle, 1.0, {3, 4}, 2), kSame).size(), 1U);
  EXPECT_TRUE(alignments(middle, mirrored(middle), kSame).empty());
}

TEST(VisibilitySkeleton, TellsAMovedVertexAndATurnedLine) {
  Skeletons skeletons(test::lRoomMap());
  const VisibilitySkeleton skeleton = skeletons.at({3, 1});
  for (std::size_t i = 0; i < skeleton.size(); ++i) {
    std::vector<Gap> gaps = skeleton.gaps();
    gaps[i].vertex.x += 1e-3;
    EXPECT_TRUE(alignments(skeleton, VisibilitySkeleton(gaps), kSame).empty());
    gaps = skeleton.gaps();
    if (gaps[i].begins && gaps[i].ends) continue;  // the line is that of the vertices
    const TPoint2D along = gaps[i].b - gaps[i].a;
    gaps[i].b = gaps[i].b + TPoint2D(-along.y, along.x) * 1e-3;
    EXPECT_TRUE(alignments(skeleton, VisibilitySkeleton(gaps), kSame).empty());
  }
  EXPECT_TRUE(alignments(skeleton, skeletons.at({1, 3}), kSame).empty());
  EXPECT_THROW(VisibilitySkeleton({}), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
