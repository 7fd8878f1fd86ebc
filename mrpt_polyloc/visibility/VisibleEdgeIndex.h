#pragma once

#include <mrpt_polyloc/base/BuildProgress.h>
#include <mrpt_polyloc/base/TiledGrid.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/visibility/BoundaryChains.h>
#include <mrpt_polyloc/visibility/SquareExpander.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// For every square of a grid over the free space, the edges that may be seen from some
/// point of it: a superset, so that a depth buffer over the list gives the exact view. Lists are
/// runs of BoundaryChains, held as bytes (packed_runs.h). Built on several threads with one result.
///
/// Walls are seen up to a horizon: from a point in free space, all that a ray meets until it has
/// gone so far past the first open edge by which it left (from a point in unknown space see
/// SquareExpander). This keeps lists local: unknown space is transparent.
class VisibleEdgeIndex {
 public:
  using Run = BoundaryChains::Run;
  /// Runs of walls, and of open edges seen from their free side.
  struct EdgeRuns {
    std::vector<Run> walls, open;

   private:
    friend class VisibleEdgeIndex;
    std::uint64_t index_ = 0;  ///< whose they are; 0: of none
    std::int64_t square_ = 0;
  };

  /// The default horizon [m]: nothing is lost by it on real maps with their many holes, where one
  /// of 10 m loses some poses (doc/localization.md).
  static constexpr double kHorizon = 20.0;

  /// \param square_size side of the squares [m], > 0 \param threads 0: all cores
  /// \param horizon [m], > 0
  /// \throws InvalidParamsError for a horizon that is not positive, a square size that is not, or
  /// gives more than 10^12 squares to the map's box; CancelledError
  VisibleEdgeIndex(const Triangulation& triangulation, double square_size, int threads = 0,
                   double horizon = kHorizon, BuildProgress* progress = nullptr);

  struct SquarePlace {
    std::int32_t column, row;
  };
  /// What takes long to find, to be stored.
  struct Lists {
    double square_size = 0.0;          ///< [m]
    double horizon = 0.0;              ///< [m]
    std::uint64_t layout = 0;          ///< BoundaryChains::hash() of what `runs` refers to
    std::vector<SquarePlace> squares;  ///< that have lists, row by row
    std::vector<std::uint64_t> begin;  ///< into `runs`: walls at 2 i, open edges at 2 i + 1
    std::vector<std::uint8_t> runs;    ///< packed
  };
  /// \throws InvalidMapError unless the lists may be those of the triangulation's map
  VisibleEdgeIndex(const Triangulation& triangulation, Lists lists);
  const Lists& lists() const { return lists_; }

  /// Whether a point lies in a square that is indexed: all squares that touch free space are, and
  /// those next to them.
  bool covers(const TPoint2D& point) const { return squareNumber(point) >= 0; }
  /// The number of the square that holds a point (squares in a row are consecutive), -1 if not
  /// indexed.
  std::int64_t squareNumber(const TPoint2D& point) const;
  /// What is listed for a square; for -1 all edges of the map. Nothing is done where `runs` are
  /// those of the square already.
  void take(std::int64_t number, EdgeRuns& runs) const;
  EdgeRuns edgeRuns(std::int64_t number) const;
  /// Whether open edges are listed for a square.
  bool seesOpen(std::int64_t number) const;
  double horizon() const { return lists_.horizon; }  ///< [m]

  const BoundaryChains& chains() const { return chains_; }
  /// Memory held, that of the chains included.
  std::size_t bytes() const;

 private:
  struct SquareRange {
    int first_column, last_column, first_row, last_row;
  };
  SquareRange rangeOf(const Triangulation& t, const Triangulation::Face& face) const;
  Square square(int column, int row) const;
  /// Numbers the squares to be indexed; returns how many there are.
  std::size_t numberLists(const Triangulation& t);
  /// The runs seen from a square, packed.
  struct SeenRuns {
    std::vector<std::uint8_t> walls, open;
  };
  std::vector<SeenRuns> findRuns(const Triangulation& t, std::size_t lists, int threads,
                                 BuildProgress* progress) const;
  std::vector<std::uint8_t> packedRunsOf(std::vector<std::uint32_t>& numbers) const;
  void layGrid(const BoundingBox& box, double square_size);

  BoundaryChains chains_;
  TPoint2D corner_;  ///< lower left, of square (0, 0)
  TiledGrid grid_;   ///< of the squares, each with the number of its lists
  Lists lists_;
  std::uint64_t id_;  ///< of this index among all of the process
};

}  // namespace mrpt_polyloc
