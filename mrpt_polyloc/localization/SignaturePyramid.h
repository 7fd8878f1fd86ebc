#pragma once

#include <mrpt_polyloc/localization/SignatureQuery.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// What is predicted in one bin for a block of positions and a window of headings: least and
/// greatest code of `near`, the first thing a beam meets (wall or open edge), and of `wall`, the
/// first wall.
struct SignatureBand {
  const std::uint8_t* near_low;
  const std::uint8_t* near_high;
  const std::uint8_t* wall_low;
  const std::uint8_t* wall_high;
};

/// The index of the search: the predicted signature (codes of the ranges in kBins directions) at
/// every position of a lattice over the space to be searched, and above it a pyramid of blocks,
/// each twice as wide as those below, with the least and greatest code in each bin over all its
/// positions and over a window of headings that doubles as well.
///
/// Level 0 holds the positions themselves, with windows of one heading; a block of level l covers
/// up to 4^l positions and 2^l headings.
class SignaturePyramid {
 public:
  static constexpr std::size_t kLevels = 5;

  struct Block {
    std::int32_t column, row;   ///< in units of this level's block size
    std::uint32_t first_child;  ///< in the level below; unused on level 0
    std::uint32_t child_count;
  };

  /// \param positions lattice points (column, row), each once; \param spacing of the lattice [m]
  /// \param corner map position of lattice point (0, 0); \param threads 0: all cores
  SignaturePyramid(const RangePredictor& predictor,
                   std::vector<std::pair<std::int32_t, std::int32_t>> positions,
                   const mrpt::math::TPoint2D& corner, double spacing, int threads = 0);

  double spacing() const { return spacing_; }
  const std::vector<Block>& blocks(std::size_t level) const { return levels_[level].blocks; }
  SignatureBand band(std::size_t level, std::size_t block) const;

  /// The middle of a block, and how far its positions are from it at most [m].
  mrpt::math::TPoint2D center(std::size_t level, std::size_t block) const;
  double radius(std::size_t level) const;

  std::size_t bytes() const;

 private:
  struct Level {
    std::vector<Block> blocks;
    std::vector<std::uint8_t> codes;  ///< per block the arrays of SignatureBand, kBins each
  };
  void predictPositions(const RangePredictor& predictor, int threads);
  void buildLevel(std::size_t level);

  mrpt::math::TPoint2D corner_;
  double spacing_;
  std::vector<Level> levels_;
};

}  // namespace mrpt_polyloc
