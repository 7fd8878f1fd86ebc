#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// What a triangulation edge is to a beam: nothing, a border of free space that can be passed, or
/// a wall.
enum class Passage : std::uint8_t { clear, open, wall };

/// Constrained Delaunay triangulation of the map's bounding box (with a margin), all walls, open
/// edges and walls beyond as constraints; every face is free or unknown space.
///
/// Serves views, beams and point location alike: a beam passes clear and open edges and stops at
/// walls; a position lies in a free or an unknown face. Immutable, all queries const and
/// thread-safe. Predicates are exact (double filter, exact fallback).
class POLYLOC_EXPORT Triangulation {
 public:
  static constexpr int kNone = -1;

  /// Edge i of a face lies opposite its vertex i, from vertex i + 1 to vertex i + 2 (mod 3).
  struct Face {
    std::array<std::int32_t, 3> vertex;    ///< counterclockwise
    std::array<std::int32_t, 3> neighbor;  ///< across edge i; kNone beyond the box
    std::array<Passage, 3> passage;        ///< of edge i
    bool is_free;                          ///< else unknown space
  };

  explicit Triangulation(const PolygonMap& map);

  const std::vector<TPoint2D>& vertices() const { return vertices_; }
  const std::vector<Face>& faces() const { return faces_; }
  /// What edge i of a face is to a beam that leaves the face: open only where it leads out of free
  /// space into unknown space.
  Passage passageOutwards(std::size_t face, std::size_t i) const {
    const Face& f = faces_[face];
    if (f.passage[i] != Passage::open) return f.passage[i];
    const bool leads_out = f.is_free && f.neighbor[i] != kNone &&
                           !faces_[static_cast<std::size_t>(f.neighbor[i])].is_free;
    return leads_out ? Passage::open : Passage::clear;
  }
  /// The triangulated box: the map's with a margin of 1 m.
  const BoundingBox& box() const { return box_; }

  /// The face that holds a point (any one of them on an edge or vertex), kNone outside the box.
  int locate(const TPoint2D& point) const;

  /// Whether a point lies in a free face; border points may go either way.
  bool isFree(const TPoint2D& point) const;

  /// Whether a point lies in free space or beside it: free space is reached from there through
  /// edges that are no walls, each of them nearer to the point than a distance [m]. O(faces met).
  bool isFreeOrBeside(const TPoint2D& point, double distance) const;

  std::size_t bytes() const;  ///< memory held

 private:
  void buildBuckets();
  int walk(int face, const TPoint2D& point) const;

  std::vector<TPoint2D> vertices_;
  std::vector<Face> faces_;
  BoundingBox box_;
  // Point location starts its walk from a face near the point: one face per square of a grid.
  double bucket_size_ = 1.0;
  int bucket_columns_ = 0;
  int bucket_rows_ = 0;
  std::vector<std::int32_t> buckets_;
};

}  // namespace mrpt_polyloc
