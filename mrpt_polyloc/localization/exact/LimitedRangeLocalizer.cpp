#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/localization/exact/LimitedRangeLocalizer.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;
using Piece = LimitedPolygon::Piece;

double angleOf(const TPoint2D& d) {
  return std::atan2(d.y, d.x);
}
TPoint2D unit(const TPoint2D& d) {
  return d * (1.0 / d.norm());
}
double lengthOf(const Piece& piece) {
  return (piece.to - piece.from).norm();
}
double headingOf(const BorderEdge& edge, const Piece& piece) {
  return std::remainder(angleOf(edge.to - edge.from) - angleOf(piece.to - piece.from), kTwoPi);
}

/// Of two walls how far from parallel they are, 0 to 1.
double angleBetweenLines(const Piece& a, const Piece& b) {
  return std::abs(cross(a.normal, b.normal));
}

/// Directions of walls are known to some tolerances over their length.
double slackOf(const Piece& piece, double tolerance) {
  return 2.0 * tolerance / lengthOf(piece);
}

}  // namespace

/// One query: what it allows, and what was found.
struct LimitedRangeLocalizer::Query {
  std::optional<PosePrior::Compass> compass;
  ViewExpander expander;
  LimitedAnswers answers;

  bool allows(double heading, double slack) const {
    return !compass || angleBetween(heading, compass->heading) <= compass->tolerance + slack;
  }
};

LimitedRangeLocalizer::LimitedRangeLocalizer(const PolygonMap& map, ExactLocalizerParams params)
    : tolerance_(params.tolerance),
      triangulation_(PolygonMap(map.components())),
      box_(map.boundingBox()) {
  params.check();
  const auto& vertices = triangulation_.vertices();
  for (const Triangulation::Face& face : triangulation_.faces()) {
    for (std::size_t i = 0; face.is_free && i < 3; ++i) {
      if (face.passage[i] == Passage::clear) continue;
      edges_.push_back({vertices[static_cast<std::size_t>(face.vertex[(i + 1) % 3])],
                        vertices[static_cast<std::size_t>(face.vertex[(i + 2) % 3])]});
    }
  }
}

std::size_t LimitedRangeLocalizer::bytes() const {
  return triangulation_.bytes() + edges_.capacity() * sizeof(edges_.front());
}

LimitedAnswers LimitedRangeLocalizer::localize(
    const LimitedView& view, const std::optional<PosePrior::Compass>& compass) const {
  PosePrior prior;
  prior.compass = compass;
  prior.check();
  const LimitedPolygon limited(view, tolerance_);
  Query query{compass, ViewExpander(triangulation_, true), {}};
  const std::vector<Piece>& pieces = limited.pieces();
  const std::vector<Piece> walls = limited.walls();
  bool has_vertex = false, has_corner = false;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    has_vertex = has_vertex || limited.beginsAtVertex(i) || limited.endsAtVertex(i);
  }
  for (const Piece& wall : walls) {
    const double slack = slackOf(wall, tolerance_) + slackOf(walls.front(), tolerance_);
    has_corner = has_corner || angleBetweenLines(wall, walls.front()) > 2.0 * slack;
  }
  if (walls.empty()) {
    query.answers.region = clearRegion(limited.range());
  } else if (has_vertex) {
    layAnchor(limited, query);
  } else if (has_corner) {
    layPairs(limited, query);
  } else {
    laySegments(limited, query);
  }
  auto& points = query.answers.points;
  std::sort(points.begin(), points.end(), [](const TPose2D& a, const TPose2D& b) {
    return std::tie(a.x, a.y, a.phi) < std::tie(b.x, b.y, b.phi);
  });
  auto& segments = query.answers.segments;
  std::sort(segments.begin(), segments.end(), [](const auto& a, const auto& b) {
    return std::tie(a.from.x, a.from.y, a.heading) < std::tie(b.from.x, b.from.y, b.heading);
  });
  return query.answers;
}

void LimitedRangeLocalizer::consider(const LimitedPolygon& view, const TPose2D& pose, double limit,
                                     Query& query) const {
  const TPoint2D point(pose.x, pose.y);
  const double slack = limit / view.range();
  if (!query.allows(pose.phi, slack) || !triangulation_.isFree(point)) return;
  for (const TPose2D& known : query.answers.points) {
    if (std::hypot(known.x - pose.x, known.y - pose.y) <= 2.0 * limit &&
        angleBetween(known.phi, pose.phi) <= 2.0 * slack) {
      return;
    }
  }
  std::vector<TPoint2D> seen = visibilityPolygon(triangulation_, query.expander.expand(point));
  for (TPoint2D& vertex : seen) vertex = turned(vertex - point, -pose.phi);
  try {
    if (!agree(view.pieces(), ObservedPolygon(seen, tolerance_).walls(), limit)) return;
  } catch (const InvalidParamsError&) {
    return;  // on a wall
  }
  query.answers.points.push_back(pose);
}

void LimitedRangeLocalizer::layAnchor(const LimitedPolygon& view, Query& query) const {
  const Piece* anchor = nullptr;
  bool at_begin = false;
  for (std::size_t i = 0; i < view.pieces().size(); ++i) {
    const Piece& piece = view.pieces()[i];
    const bool begins = view.beginsAtVertex(i);
    if (!begins && !view.endsAtVertex(i)) continue;
    if (anchor != nullptr && lengthOf(piece) <= lengthOf(*anchor)) continue;
    anchor = &piece;
    at_begin = begins;
  }
  const double limit = 2.0 * tolerance_ + 2.0 * slackOf(*anchor, tolerance_) * view.range();
  for (const BorderEdge& edge : edges_) {
    const double heading = headingOf(edge, *anchor);
    const TPoint2D point =
        (at_begin ? edge.from : edge.to) - turned(at_begin ? anchor->from : anchor->to, heading);
    consider(view, {point.x, point.y, heading}, limit, query);
  }
}

void LimitedRangeLocalizer::layPairs(const LimitedPolygon& view, Query& query) const {
  const std::vector<Piece> walls = view.walls();
  const Piece *a = nullptr, *b = nullptr;
  double best = 0.0;  // the pair that fixes the robot best
  for (const Piece& wall : walls) {
    for (const Piece& other : walls) {
      const double fixes =
          angleBetweenLines(wall, other) * std::min(lengthOf(wall), lengthOf(other));
      if (fixes <= best) continue;
      best = fixes;
      a = &wall;
      b = &other;
    }
  }
  const double slack = slackOf(*a, tolerance_) + slackOf(*b, tolerance_);
  const double limit = 2.0 * tolerance_ + 4.0 * slack * view.range() / angleBetweenLines(*a, *b);
  for (const BorderEdge& first : edges_) {
    const double heading = headingOf(first, *a);
    if (!query.allows(heading, slack)) continue;
    const TPoint2D along = unit(first.to - first.from);
    for (const BorderEdge& second : edges_) {
      if (angleBetween(headingOf(second, *b), heading) > slack) continue;
      // left of both lines by the distances of the walls
      const TPoint2D other = unit(second.to - second.from);
      const double sine = cross(along, other);
      const double c = cross(along, first.from) + a->distance;
      const double d = cross(other, second.from) + b->distance;
      const TPoint2D point = (other * c - along * d) * (1.0 / sine);
      consider(view, {point.x, point.y, heading}, limit, query);
    }
  }
}

void LimitedRangeLocalizer::laySegments(const LimitedPolygon& view, Query& query) const {
  const std::vector<Piece> walls = view.walls();
  const Piece& wall = walls.front();
  std::optional<double> opposite;
  for (const Piece& other : walls) {
    if (dot(other.normal, wall.normal) < 0.0) opposite = wall.distance + other.distance;
  }
  for (const BorderEdge& edge : edges_) {
    const double heading = headingOf(edge, wall);
    if (!query.allows(heading, slackOf(wall, tolerance_))) continue;
    const TPoint2D along = unit(edge.to - edge.from), left(-along.y, along.x);
    const TPoint2D start = edge.from + left * wall.distance;
    for (const Stretch& stretch :
         clearStretches(edges_, edge, wall.distance, opposite, view.range(), 2.0 * tolerance_)) {
      LimitedAnswers::Segment segment{start + along * stretch.first, start + along * stretch.second,
                                      heading};
      // Edges one after the other in a line give segments one after the other.
      auto& known = query.answers.segments;
      for (std::size_t i = 0; i < known.size(); ++i) {
        if (angleBetween(known[i].heading, heading) > 1e-6) continue;
        if ((known[i].to - segment.from).norm() <= 4.0 * tolerance_) {
          segment.from = known[i].from;
        } else if ((known[i].from - segment.to).norm() <= 4.0 * tolerance_) {
          segment.to = known[i].to;
        } else {
          continue;
        }
        known.erase(known.begin() + static_cast<std::ptrdiff_t>(i--));
      }
      known.push_back(segment);
    }
  }
  // A place as long as what is seen: a point.
  auto& segments = query.answers.segments;
  const auto isPoint = [&](const LimitedAnswers::Segment& s) {
    return (s.to - s.from).norm() <= 4.0 * tolerance_;
  };
  for (const LimitedAnswers::Segment& s : segments) {
    if (isPoint(s)) query.answers.points.emplace_back(s.from.x, s.from.y, s.heading);
  }
  segments.erase(std::remove_if(segments.begin(), segments.end(), isPoint), segments.end());
}

double LimitedRangeLocalizer::clearance(const TPoint2D& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (const BorderEdge& edge : edges_) {
    const TPoint2D d = edge.to - edge.from, p = point - edge.from;
    const double share = std::clamp(dot(p, d) / dot(d, d), 0.0, 1.0);
    least = std::min(least, (p - d * share).norm());
  }
  return triangulation_.isFree(point) ? least : -least;
}

std::optional<LimitedAnswers::Region> LimitedRangeLocalizer::clearRegion(double range) const {
  struct ClearSquare {
    double bound;  ///< of the clearance in it
    TPoint2D center;
    double half;
    bool operator<(const ClearSquare& other) const { return bound < other.bound; }
  };
  constexpr double kSmallest = 0.5e-3;  // half a side [m]
  std::priority_queue<ClearSquare> squares;
  LimitedAnswers::Region best{range, box_.min};
  double most = -std::numeric_limits<double>::infinity();
  const auto add = [&](const TPoint2D& center, double half) {
    const double here = clearance(center);
    if (here > most) {
      most = here;
      best.inside = center;
    }
    // No point of the square is farther off than its centre and half a diagonal.
    squares.push({here + M_SQRT2 * half, center, half});
  };
  const double width = box_.max.x - box_.min.x, height = box_.max.y - box_.min.y;
  add({0.5 * (box_.min.x + box_.max.x), 0.5 * (box_.min.y + box_.max.y)},
      0.5 * std::max(width, height));
  while (!squares.empty() && squares.top().bound > most && most < range) {
    const ClearSquare square = squares.top();
    squares.pop();
    if (square.bound < range - tolerance_) break;
    if (square.half < kSmallest) continue;
    const double half = 0.5 * square.half;
    for (const double dx : {-half, half}) {
      for (const double dy : {-half, half}) add(square.center + TPoint2D(dx, dy), half);
    }
  }
  // Uphill from there, for places in which the robot just fits.
  for (double step = 1e-3; most < range && step > 1e-9; step *= 0.5) {
    bool is_better = true;
    while (is_better) {
      is_better = false;
      for (int i = 0; i < 16; ++i) {
        const TPoint2D p = best.inside + turned({step, 0}, kTwoPi * i / 16);
        if (clearance(p) <= most) continue;
        most = clearance(p);
        best.inside = p;
        is_better = true;
      }
    }
  }
  if (most < range - tolerance_) return std::nullopt;
  return best;
}

}  // namespace mrpt_polyloc
