#include <mrpt_polyloc/geometry/BoundingBox.h>
#include <mrpt_polyloc/geometry/noding.h>
#include <mrpt_polyloc/geometry/validation.h>

#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace mrpt_polyloc {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Rounds of cutting: the second mostly finds nothing left to cut, each further one repairs what
/// rounding has bent.
constexpr int kMaxRounds = 20;
/// Cuts in one round: beyond it lies only input made to be quadratic.
constexpr std::size_t kMaxCuts = 1000000;

/// Thrown through CGAL's sweep to end it early.
struct TooMuch {};

bool isLess(const TPoint2D& a, const TPoint2D& b) {
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}

CGAL::Orientation orientation(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c) {
  return CGAL::orientation(Kernel::Point_2(a.x, a.y), Kernel::Point_2(b.x, b.y),
                           Kernel::Point_2(c.x, c.y));
}

bool inBox(const TPoint2D& a, const TPoint2D& b, const TPoint2D& p) {
  return BoundingBox::of(std::array{a, b}).contains(p);
}

/// The crossing point of ab and cd, exact but for one rounding, and inside both boxes.
TPoint2D crossingPoint(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c, const TPoint2D& d) {
  using Rational = CGAL::Exact_rational;
  const Rational ax(a.x), ay(a.y), cx(c.x), cy(c.y);
  const Rational ux = Rational(b.x) - ax, uy = Rational(b.y) - ay;
  const Rational vx = Rational(d.x) - cx, vy = Rational(d.y) - cy;
  const Rational t = ((cx - ax) * vy - (cy - ay) * vx) / (ux * vy - uy * vx);
  const auto clamped = [](double value, double a1, double b1, double c1, double d1) {
    const double low = std::max(std::min(a1, b1), std::min(c1, d1));
    const double high = std::min(std::max(a1, b1), std::max(c1, d1));
    return std::min(std::max(value, low), high) + 0.0;
  };
  return {clamped(CGAL::to_double(Rational(ax + t * ux)), a.x, b.x, c.x, d.x),
          clamped(CGAL::to_double(Rational(ay + t * uy)), a.y, b.y, c.y, d.y)};
}

class Noder {
 public:
  explicit Noder(const std::vector<Ring>& rings) {
    std::vector<TPoint2D>& nodes = result_.nodes;
    for (const Ring& ring : rings) {
      nodes.insert(nodes.end(), ring.vertices.begin(), ring.vertices.end());
    }
    std::sort(nodes.begin(), nodes.end(), isLess);
    nodes.erase(
        std::unique(nodes.begin(), nodes.end(),
                    [](const TPoint2D& a, const TPoint2D& b) { return a.x == b.x && a.y == b.y; }),
        nodes.end());
    given_nodes_ = nodes.size();
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const std::size_t n = rings[r].size();
      for (std::size_t i = 0; i < n; ++i) {
        result_.pieces.push_back({nodeAt(rings[r].vertices[i]),
                                  nodeAt(rings[r].vertices[(i + 1) % n]), static_cast<int>(r),
                                  rings[r].kinds[i]});
      }
    }
  }

  NodedRings run() {
    for (round_ = 0; round_ < kMaxRounds && !result_.is_complete; ++round_) {
      cuts_.clear();
      try {
        findCuts();
      } catch (const TooMuch&) {
        break;
      }
      result_.is_complete = cuts_.empty();
      cut();
    }
    std::sort(result_.contacts.begin(), result_.contacts.end(),
              [](const Contact& a, const Contact& b) { return key(a) < key(b); });
    if (result_.nodes.size() > given_nodes_) sortNodes();
    return std::move(result_);
  }

 private:
  struct Cut {
    std::size_t piece;
    int node;
  };

  static std::tuple<double, double, int, int, int> key(const Contact& c) {
    return {c.where.x, c.where.y, c.ring_a, c.ring_b, static_cast<int>(c.kind)};
  }

  const TPoint2D& point(int node) const { return result_.nodes[static_cast<std::size_t>(node)]; }

  /// The node at a point, made if need be.
  int nodeAt(const TPoint2D& p) {
    const auto given_end = result_.nodes.begin() + static_cast<std::ptrdiff_t>(given_nodes_);
    const auto given = std::lower_bound(result_.nodes.begin(), given_end, p, isLess);
    if (given != given_end && given->x == p.x && given->y == p.y) {
      return static_cast<int>(given - result_.nodes.begin());
    }
    const auto [made, is_new] =
        made_nodes_.emplace(std::make_pair(p.x, p.y), static_cast<int>(result_.nodes.size()));
    if (is_new) result_.nodes.push_back(p);
    return made->second;
  }

  void findCuts() {
    using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 2, const EdgePiece*>;
    std::vector<Box> boxes;
    boxes.reserve(result_.pieces.size());
    for (const EdgePiece& piece : result_.pieces) {
      const TPoint2D& a = point(piece.from);
      const TPoint2D& b = point(piece.to);
      boxes.emplace_back(CGAL::Bbox_2(std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x),
                                      std::max(a.y, b.y)),
                         &piece);
    }
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [this](const Box& s, const Box& t) {
      examine(*s.handle(), *t.handle());
    });
  }

  /// Notes where two pieces whose boxes meet have to be cut.
  void examine(const EdgePiece& s, const EdgePiece& t) {
    const TPoint2D a = point(s.from), b = point(s.to), c = point(t.from), d = point(t.to);
    const CGAL::Orientation side_c = orientation(a, b, c);
    const CGAL::Orientation side_d = orientation(a, b, d);
    if (side_c == side_d && side_c != CGAL::COLLINEAR) return;
    const CGAL::Orientation side_a = orientation(c, d, a);
    const CGAL::Orientation side_b = orientation(c, d, b);
    if (side_a == side_b && side_a != CGAL::COLLINEAR) return;
    const std::array<CGAL::Orientation, 4> sides{side_a, side_b, side_c, side_d};
    if (std::count(sides.begin(), sides.end(), CGAL::COLLINEAR) == 0) {
      const TPoint2D crossing = crossingPoint(a, b, c, d);
      note(Contact::Kind::crossing, s, t, crossing);
      const int node = nodeAt(crossing);
      addCut(s, node);
      addCut(t, node);
      return;
    }
    bool is_cut = false;
    if (side_c == CGAL::COLLINEAR) is_cut |= addCut(s, t.from);
    if (side_d == CGAL::COLLINEAR) is_cut |= addCut(s, t.to);
    if (side_a == CGAL::COLLINEAR) is_cut |= addCut(t, s.from);
    if (side_b == CGAL::COLLINEAR) is_cut |= addCut(t, s.to);
    const bool is_same = std::minmax(s.from, s.to) == std::minmax(t.from, t.to);
    if (side_c == CGAL::COLLINEAR && side_d == CGAL::COLLINEAR && (is_cut || is_same)) {
      std::array<TPoint2D, 4> ends{a, b, c, d};  // the middle two bound the common part
      std::sort(ends.begin(), ends.end(), isLess);
      note(Contact::Kind::overlap, s, t,
           {0.5 * (ends[1].x + ends[2].x), 0.5 * (ends[1].y + ends[2].y)});
    }
  }

  /// Cuts a piece at a node collinear with it if that lies between its ends.
  bool addCut(const EdgePiece& piece, int node) {
    if (node == piece.from || node == piece.to) return false;
    if (!inBox(point(piece.from), point(piece.to), point(node))) return false;
    cuts_.push_back({static_cast<std::size_t>(&piece - result_.pieces.data()), node});
    if (cuts_.size() > kMaxCuts) throw TooMuch{};
    return true;
  }

  void note(Contact::Kind kind, const EdgePiece& s, const EdgePiece& t, const TPoint2D& where) {
    if (round_ > 0) return;  // of our own making, by rounding
    const auto [ring_a, ring_b] = std::minmax(s.ring, t.ring);
    result_.contacts.push_back({kind, ring_a, ring_b, where});
    if (result_.contacts.size() > kMaxContacts) throw TooMuch{};
  }

  /// Replaces the pieces that have cuts by their parts, in order along the piece.
  void cut() {
    if (cuts_.empty()) return;
    const auto place = [this](const Cut& c) {
      const EdgePiece& piece = result_.pieces[c.piece];
      const TPoint2D& from = point(piece.from);
      const TPoint2D& to = point(piece.to);
      const double along_x = std::copysign(point(c.node).x - from.x, 1.0);
      const double along_y = std::copysign(point(c.node).y - from.y, 1.0);
      const bool steep = std::abs(to.y - from.y) > std::abs(to.x - from.x);
      return std::make_tuple(c.piece, steep ? along_y : along_x, steep ? along_x : along_y, c.node);
    };
    std::sort(cuts_.begin(), cuts_.end(),
              [&](const Cut& a, const Cut& b) { return place(a) < place(b); });
    std::vector<EdgePiece> pieces;
    pieces.reserve(result_.pieces.size() + cuts_.size());
    auto next_cut = cuts_.begin();
    for (std::size_t i = 0; i < result_.pieces.size(); ++i) {
      EdgePiece rest = result_.pieces[i];
      for (; next_cut != cuts_.end() && next_cut->piece == i; ++next_cut) {
        if (next_cut->node == rest.from) continue;  // the same cut once more
        pieces.push_back({rest.from, next_cut->node, rest.ring, rest.kind});
        rest.from = next_cut->node;
      }
      pieces.push_back(rest);
    }
    result_.pieces = std::move(pieces);
  }

  /// Puts all nodes into lexicographic order: the order in which they were made is CGAL's.
  void sortNodes() {
    std::vector<int> order(result_.nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [this](int a, int b) { return isLess(point(a), point(b)); });
    std::vector<int> new_index(order.size());
    std::vector<TPoint2D> nodes;
    for (std::size_t i = 0; i < order.size(); ++i) {
      new_index[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
      nodes.push_back(point(order[i]));
    }
    for (EdgePiece& piece : result_.pieces) {
      piece.from = new_index[static_cast<std::size_t>(piece.from)];
      piece.to = new_index[static_cast<std::size_t>(piece.to)];
    }
    result_.nodes = std::move(nodes);
  }

  NodedRings result_;
  std::size_t given_nodes_ = 0;
  std::map<std::pair<double, double>, int> made_nodes_;
  std::vector<Cut> cuts_;
  int round_ = 0;
};

}  // namespace

NodedRings nodeRings(const std::vector<Ring>& rings) {
  return Noder(rings).run();
}

}  // namespace mrpt_polyloc
