#pragma once

#include <mrpt_polyloc/evaluation/baselines/BaselineAnswer.h>
#include <mrpt_polyloc/geometry/OccupancyBitmap.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

struct CorrelativeMatcherParams {
  /// Standard deviation of the probability that a hit lies beside a wall [m]: what a grid made from
  /// many noisy scans shows, and about the greatest error of the walls.
  double sigma = 0.15;
  double least_probability = 0.1;  ///< of a hit far from all walls: clutter
  int levels = 6;                  ///< of the pyramid above the cells: blocks of up to 2^6 cells
  /// Hits further away than this take no part in the choice of the angular step [m].
  double far_range = 10.0;
  /// Scans of more hits are thinned in space, by voxels, to about so many that are scored.
  std::size_t most_hits = 100;
  /// The sensor is looked for in free cells and so far beside them [m]; infinity: anywhere.
  double beyond_free = 0.3;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// A baseline: real-time loop closure's scan matcher (Hess, Kohler, Rapp and Andor, "Real-time loop
/// closure in 2D LIDAR SLAM", ICRA 2016), over the whole map, written from the paper.
///
/// The score of a pose is the mean, over the hits, of the probability of the cell that a hit falls
/// into. Headings are sampled so finely that the farthest hit moves by at most a cell (eq. 7),
/// positions are those of cells. Branch and bound, depth first, over blocks of 2^h x 2^h positions
/// of one heading, the better child first; the bound of a block is the same sum over the greatest
/// probability within 2^h cells of each hit (eqs. 14 to 16), from precomputed grids. It finds a
/// pose of the greatest score that there is on this lattice. A first good score, to prune by, comes
/// from greedy descents.
///
/// What it does not have: the Ceres refinement that Cartographer runs afterwards (answers are on
/// the lattice), no-returns, a rule for walls between the sensor and its hits, and a list: it has
/// one answer.
class CorrelativeMatcher {
 public:
  /// \throws InvalidParamsError; InvalidMapError if nothing is occupied, or no cell is searched
  explicit CorrelativeMatcher(const OccupancyBitmap& bitmap,
                              const CorrelativeMatcherParams& params = {});

  /// The best pose whose sensor cell is searched; none for a scan without hits.
  /// Const, thread-safe, deterministic.
  std::optional<BaselineAnswer> localize(const RangeScan& scan) const;

  std::size_t bytes() const;  ///< of the pyramid

  /// A hit's cell, seen from the sensor's cell, at some heading.
  struct Offset {
    int column, row;
  };
  /// The hits that are scored [m, in the beam frame], and the angular step for them: parts of
  /// localize(), for tests.
  std::vector<mrpt::math::TPoint2D> scoredHits(const RangeScan& scan) const;
  double angularStep(const std::vector<mrpt::math::TPoint2D>& hits) const;
  std::vector<Offset> offsets(const std::vector<mrpt::math::TPoint2D>& hits, double heading) const;
  /// Sum over the hits of the bytes of level h at a position: the score (h = 0, times 255 hits) or
  /// a bound of it for positions up to 2^h - 1 cells right of and above it.
  std::uint32_t sum(int level, const std::vector<Offset>& hits, int column, int row) const;
  /// Whether the sensor is looked for in any cell of the aligned block of 2^level x 2^level cells
  /// that begins at a cell.
  bool isSearched(int level, int column, int row) const;

 private:
  struct Block;
  struct Heading;
  struct Children;
  std::vector<std::uint8_t> addLevel(int level, const std::vector<std::uint8_t>& below);
  void addSearched(int level);
  Heading headingOf(const std::vector<mrpt::math::TPoint2D>& hits, double angle) const;
  std::array<std::uint32_t, 4> sumsOfParts(const Heading& heading, const Block& block,
                                           std::uint32_t least) const;
  Children childrenOf(const Heading& heading, const Block& block, std::uint32_t least) const;
  void dive(const Heading& heading, Block block, Block& best) const;
  void descend(const Heading& heading, const Block& block, Block& best) const;

  int width_, height_;
  double resolution_;
  mrpt::math::TPose2D pose_map_bitmap_;
  CorrelativeMatcherParams params_;
  std::uint8_t outside_;  ///< probability beyond the grid
  int stride_ = 0;        ///< of all levels: entries from row to row
  /// Of level h, from 1 on at index h - 1: in an entry the bytes of the four blocks of level h - 1
  /// that a block of level h is made of, so that one look-up bounds all four. The last entry is
  /// that of blocks outside.
  std::vector<std::vector<std::uint32_t>> levels_;
  std::vector<std::vector<bool>> searched_;  ///< by level: aligned blocks with a cell to look in
};

}  // namespace mrpt_polyloc
