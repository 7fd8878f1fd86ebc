#pragma once

#include "SvgCanvas.h"
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <mrpt/math/TPose2D.h>

#include <vector>

namespace mrpt_polyloc::apps {

/// Free space, walls, open edges and walls beyond.
void drawMap(SvgCanvas& canvas, const PolygonMap& map);

/// Where the hits of a scan lie in the map.
std::vector<TPoint2D> hitPoints(const RangeScan& scan, const mrpt::math::TPose2D& pose_map_robot);

/// The beams of a scan taken from a robot pose: thin lines, hits as dots.
void drawScan(SvgCanvas& canvas, const RangeScan& scan, const mrpt::math::TPose2D& pose_map_robot);

/// Hits of further scans, faint, below everything that is drawn later.
void drawFaintHits(SvgCanvas& canvas, const std::vector<TPoint2D>& hits);

/// Arrows with rank and weight, and the ellipses of three standard deviations; the first stands
/// out. Only the first few are labelled.
void drawHypotheses(SvgCanvas& canvas, const std::vector<Hypothesis>& hypotheses);

/// The way through the best poses of several scans.
void drawPath(SvgCanvas& canvas, const std::vector<mrpt::math::TPose2D>& poses);

}  // namespace mrpt_polyloc::apps
