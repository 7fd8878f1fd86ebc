#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <vector>

namespace mrpt_polyloc {

/// A piece of a ring's edge between two nodes, in the direction of the ring.
struct EdgePiece {
  int from = 0;  ///< index of a node
  int to = 0;
  int ring = 0;
  EdgeKind kind = EdgeKind::wall;
};

/// Where two ring edges share more than an endpoint or a vertex.
struct Contact {
  enum class Kind { crossing, overlap };
  Kind kind = Kind::crossing;
  int ring_a = 0;  ///< ring_a <= ring_b
  int ring_b = 0;
  TPoint2D where{0, 0};
};

/// Rings cut wherever they meet: two pieces have at most endpoints in common, or all.
struct NodedRings {
  std::vector<TPoint2D> nodes;  ///< in lexicographic order, no two equal
  std::vector<EdgePiece> pieces;
  std::vector<Contact> contacts;  ///< of the edges as given, sorted by place
  /// False if there were more than kMaxContacts contacts (the ones found are listed), or if the
  /// rounding of crossing points kept making new crossings.
  bool is_complete = false;
};

/// Cuts rings at their crossings and wherever a vertex lies on an edge.
///
/// Crossing points are rounded to doubles and the edges bent through them, and what that bends into
/// something else is cut in turn, so that the pieces as they stand are free of crossings, and so
/// is every ring made of them. Orientations are exact. The rings need finite coordinates and no
/// repeated vertices.
NodedRings nodeRings(const std::vector<Ring>& rings);

}  // namespace mrpt_polyloc
