#pragma once

#include <mrpt_polyloc/evaluation/baselines/BaselineAnswer.h>
#include <mrpt_polyloc/geometry/OccupancyBitmap.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace mrpt_polyloc {

struct LikelihoodLatticeParams {
  double step = 0.3;             ///< between positions [m]: within reach of sigma and of the ICP
  std::size_t headings = 48;     ///< of the circle: 7.5 degrees apart
  double sigma = 0.15;           ///< LF_stdHit of the field [m]: half a step
  std::size_t first_hits = 20;   ///< hits that weigh all lattice poses, spread evenly
  std::size_t weighed = 3000;    ///< the best lattice poses, which are weighed again ...
  std::size_t coarse_hits = 60;  ///< ... by so many hits
  std::size_t fine_hits = 180;   ///< hits that are aligned, and rank what comes out
  std::size_t refined = 30;      ///< lattice poses that are aligned
  double icp_distance = 0.6;     ///< thresholdDist of the alignment [m]: above a step's diagonal

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// A baseline: what a user of MRPT gets by putting its own classes together, and what MOLA's
/// relocalization does. Every pose of a lattice over the free cells of an occupancy grid is weighed
/// by the likelihood field (COccupancyGridMap2D::computeLikelihoodField_Thrun), by few hits and, if
/// it is among the better ones, by more; the best ones, no two of them neighbours, are aligned to
/// the occupied cells by mrpt::slam::CICP, and ranked by the field again.
///
/// Const calls are thread-safe: each thread has a grid of its own, for MRPT's keeps a cache.
class LikelihoodLattice {
 public:
  /// \throws InvalidParamsError; InvalidMapError if there is no free or no occupied cell
  explicit LikelihoodLattice(const OccupancyBitmap& bitmap,
                             const LikelihoodLatticeParams& params = {});
  ~LikelihoodLattice();
  LikelihoodLattice(const LikelihoodLattice&) = delete;
  LikelihoodLattice& operator=(const LikelihoodLattice&) = delete;

  /// The aligned poses, best first, none twice (0.2 m and 4 degrees); none without hits.
  /// Scores: the geometric mean of the hits' likelihoods, over the greatest possible.
  std::vector<BaselineAnswer> localize(const RangeScan& scan) const;

  std::size_t bytes() const;             ///< of one grid with its cache
  std::size_t latticePositions() const;  ///< free ones

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace mrpt_polyloc
