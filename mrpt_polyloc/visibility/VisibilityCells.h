#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/visibility/critical_segments.h>
#include <mrpt_polyloc/visibility/segment_arrangement.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace mrpt_polyloc {

/// What a decomposition would take, found without building it.
struct POLYLOC_EXPORT CellEstimate {
  std::size_t windows = 0;    ///< critical segments
  std::size_t dividers = 0;   ///< edges of the triangulation, where the range is limited
  std::size_t crossings = 0;  ///< between all of them, counted pair by pair in floating point
  /// Upper bound of the cells: fewer where several segments cross in one point. A crossing that
  /// rounding takes for a touch is not counted.
  std::size_t cells() const { return crossings + windows + dividers + 1; }
  double megabytes() const;  ///< while it is built, from kBytesPerCell
};

/// A map with more visibility cells than the budget allows: `what()` gives the count, the memory
/// and the ways out.
class POLYLOC_EXPORT CellBudgetError : public std::runtime_error {
 public:
  explicit CellBudgetError(const CellEstimate& estimate, std::size_t budget);
  CellEstimate estimate;
};

struct POLYLOC_EXPORT VisibilityCellsParams {
  /// Cells at most; more are refused before anything is built.
  std::size_t max_cells = 1'000'000;
  /// Vertices farther away than this [m] are not told apart by cells. See VisibilityCells.
  double range = kUnlimitedRange;
};

/// The free space of a map cut into convex cells inside of which the same vertices are seen, in the
/// same cyclic order, with the same edge behind each gap between two neighbours (R. Karch, H.
/// Noltemeier, M. Schwark, T. Wahl, "Robot localization using polygon distances", 1999; L. Guibas,
/// R. Motwani, P. Raghavan, "The robot localization problem", 1997): the faces of the arrangement
/// of the boundary and all critical segments. Sight ends at walls and at open edges alike.
///
/// With a limited range R, for any two points p, q of a cell and a vertex u within R of both: u is
/// seen from both or from neither. The cells stay convex: edges of the triangulation divide too.
///
/// Computed exactly, kept rounded to double: a cell narrower than some 1e-12 of the map's
/// coordinates may have a polygon without area. Immutable, all queries const and thread-safe.
class POLYLOC_EXPORT VisibilityCells {
 public:
  static constexpr std::int32_t kNone = Triangulation::kNone;

  /// \throws CellBudgetError, InvalidMapError, InvalidParamsError
  explicit VisibilityCells(const PolygonMap& map, const VisibilityCellsParams& params = {});

  /// The count alone.
  static CellEstimate estimate(const PolygonMap& map, double range = kUnlimitedRange);

  /// The greatest of the ranges 0.0625 m times powers of 2^(1/2) and unlimited (from the map's
  /// diagonal on) in which there are at most `max_cells` cells by estimate. \throws CellBudgetError
  /// if there are more in any of them, InvalidMapError
  static double greatestRange(const PolygonMap& map, std::size_t max_cells);

  /// A vertex that comes into sight or is lost when an edge of a cell is crossed.
  struct Change {
    std::int32_t vertex;  ///< of triangulation()
    bool appears;         ///< on the way out of the cell; else it disappears
  };

  /// Of the free space and its boundary alone (no walls beyond): its vertices are the map's.
  const Triangulation& triangulation() const { return triangulation_; }
  const CriticalSegments& criticalSegments() const { return critical_; }
  double range() const { return range_; }

  std::size_t size() const { return faces_.first.size() - 1; }
  std::size_t edgeCount(std::size_t cell) const {
    return faces_.first[cell + 1] - faces_.first[cell];
  }
  /// Counterclockwise [m]; edge i of a cell runs from vertex i to vertex i + 1. Collinear vertices
  /// stand where neighbours change.
  std::vector<TPoint2D> polygon(std::size_t cell) const;
  /// The cell across an edge, kNone across the boundary of free space.
  std::int32_t neighbor(std::size_t cell, std::size_t edge) const {
    return faces_.edges[faces_.first[cell] + edge].neighbor;
  }
  /// What changes across an edge, outwards; empty for edges of the boundary, and for dividing edges
  /// where the range is limited.
  std::vector<Change> changesAcross(std::size_t cell, std::size_t edge) const;
  double area(std::size_t cell) const;  ///< [m2]
  /// The centre of gravity [m], where the representative view is taken.
  TPoint2D representative(std::size_t cell) const;

  /// The cell that holds a point (any one of them on an edge), kNone outside free space. Takes the
  /// rounded polygons: within some 1e-12 of an edge the neighbour may be given.
  std::int32_t locate(const TPoint2D& point) const;

  /// How far a point lies beyond the line of an edge of a cell, at most over its edges [m]; 0
  /// inside and on the border.
  double distanceOutside(std::size_t cell, const TPoint2D& point) const;

  /// Points from which the view may be that of none of the cells around, once each, as vertices are
  /// hidden that are seen from one cell around or another: inner points where three critical lines
  /// or more meet; of edges across which vertices appear and others disappear the middle, and the
  /// ends that are inner points; and, for lines that meet or coincide but for rounding, the
  /// representatives of cells narrower than `width` [m].
  std::vector<TPoint2D> tiedPoints(double width) const;

  /// Memory of what is kept [bytes], without the triangulation.
  std::size_t memory() const;

 private:
  const TPoint2D& vertex(std::size_t edge) const {
    return faces_.vertices[static_cast<std::size_t>(faces_.edges[edge].from)];
  }
  template <class Visitor>
  void forEachBucket(std::size_t cell, Visitor&& visit) const;
  void buildBuckets();
  /// How far a point is outside of a cell at most over its edges (0 inside) [m2, twice the area].
  double violation(std::size_t cell, const TPoint2D& point) const;

  double range_;
  Triangulation triangulation_;
  CriticalSegments critical_;
  ArrangedFaces faces_;
  // Point location: for each square of a grid the cells whose box meets it.
  double bucket_size_ = 1.0;
  std::size_t bucket_columns_ = 1, bucket_rows_ = 1;
  std::vector<std::uint32_t> first_in_bucket_;
  std::vector<std::uint32_t> bucket_cells_;
};

}  // namespace mrpt_polyloc
