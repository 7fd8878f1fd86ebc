#include "apps/common/SvgCanvas.h"

#include "apps/common/map_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mrpt_polyloc::apps {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

PolygonMap halfOpenRoom() {
  const Ring outer{{{0, 0}, {4, 0}, {4, 3}, {0, 3}},
                   {EdgeKind::wall, EdgeKind::open, EdgeKind::wall, EdgeKind::wall}};
  return PolygonMap({{outer, {}}}, {{{6, 0}, {6, 3}}});
}

TEST(SvgCanvas, KeepsMapCoordinatesWithYUp) {
  SvgCanvas canvas({{0, 0}, {12, 3}});
  canvas.lines({{{1, 2}, {3, 2.5}}}, "wall");
  // 12 m and 3 % of them on both sides are 1200 pixels; y is turned by the group's matrix.
  EXPECT_THAT(canvas.text(),
              AllOf(HasSubstr("<path class=\"wall\" d=\"M1 2L3 2.5\"/>"),
                    HasSubstr("matrix(94.339623 0 0 -94.339623 "), HasSubstr("width=\"1200\"")));
}

TEST(SvgCanvas, ScaleBarIsARoundLength) {
  EXPECT_THAT(SvgCanvas({{0, 0}, {12, 3}}).text(), HasSubstr(">1 m<"));
  EXPECT_THAT(SvgCanvas({{0, 0}, {75, 31}}).text(), HasSubstr(">5 m<"));
  EXPECT_THAT(SvgCanvas({{0, 0}, {300, 31}}).text(), HasSubstr(">20 m<"));
}

TEST(SvgCanvas, EscapesText) {
  SvgCanvas canvas({{0, 0}, {1, 1}});
  canvas.label({0, 0}, 0, 0, "a<b&c", "note");
  EXPECT_THAT(canvas.text(), HasSubstr(">a&lt;b&amp;c</text>"));
}

TEST(MapPicture, DrawsEveryKindOfEdgeApart) {
  SvgCanvas canvas({{0, 0}, {6, 3}});
  drawMap(canvas, halfOpenRoom());
  EXPECT_THAT(canvas.text(),
              AllOf(HasSubstr("class=\"free\" fill-rule=\"evenodd\" d=\"M0 0L4 0 4 3 0 3Z\""),
                    HasSubstr("class=\"open\" d=\"M4 0L4 3\""),
                    HasSubstr("class=\"wall\" d=\"M0 0L4 0M4 3L0 3 0 0\""),
                    HasSubstr("class=\"beyond\" d=\"M6 0L6 3\""), HasSubstr(">open edge<"),
                    HasSubstr(">wall beyond<")));
}

TEST(MapPicture, LegendNamesOnlyWhatIsThere) {
  SvgCanvas canvas({{0, 0}, {1, 1}});
  drawMap(canvas, PolygonMap({{wallRing({{0, 0}, {1, 0}, {0, 1}}), {}}}));
  EXPECT_THAT(canvas.text(), AllOf(HasSubstr(">wall<"), Not(HasSubstr(">open edge<")),
                                   Not(HasSubstr(">wall beyond<"))));
}

TEST(MapPicture, HitsLieWhereTheSensorSawThem) {
  // Robot at (1, 1) facing up, sensor 0.5 m ahead: at (1, 1.5); a hit 2 m to its left.
  const RangeScan scan({{1.5707963267948966, 2.0, BeamKind::hit}, {0.0, 5.0, BeamKind::no_return}},
                       {0.5, 0.0});
  const std::vector<TPoint2D> hits = hitPoints(scan, {1, 1, 1.5707963267948966});
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_NEAR(hits[0].x, -1.0, 1e-12);
  EXPECT_NEAR(hits[0].y, 1.5, 1e-12);
}

TEST(MapPicture, HypothesesShowRankAndWeight) {
  Hypothesis best, rival;
  best.weight = 0.93;
  rival.weight = 0.07;
  best.covariance.setIdentity();
  rival.covariance.setIdentity();
  rival.pose_map_robot = {1, 1, 0};
  SvgCanvas canvas({{0, 0}, {6, 3}});
  drawHypotheses(canvas, {best, rival});
  EXPECT_THAT(canvas.text(), AllOf(HasSubstr(">1: 93 %<"), HasSubstr(">2: 7.0 %<")));
}

}  // namespace
}  // namespace mrpt_polyloc::apps
