#pragma once

#include <mrpt_polyloc/mrpt_bridge/TLikelihoodOptions.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <vector>

namespace mrpt_polyloc {

/// No scan's log-likelihood is below this: MRPT's filters refuse what is not finite.
constexpr double kLogLikelihoodFloor = -1e9;

/// Log-likelihood (not normalised, at most 0) of a scan from a pose of the ROBOT; 0 if no beam says
/// anything. A pose away from free space costs as much as a scan can. What the scan gives is
/// prepared once per thread and kept while the contents of the scan, not its address, are the same.
/// \throws std::invalid_argument as toRangeScan()
double scanLogLikelihood(const RangePredictor& predictor,
                         const mrpt::obs::CObservation2DRangeScan& scan,
                         const mrpt::math::TPose2D& pose_map_robot,
                         const TLikelihoodOptions& options);

/// The same for many poses of the ROBOT, in their order; taken cell by cell, so that what is seen
/// from a cell stays in the processor's cache.
std::vector<double> scanLogLikelihoods(const RangePredictor& predictor,
                                       const mrpt::obs::CObservation2DRangeScan& scan,
                                       const std::vector<mrpt::math::TPose2D>& poses_map_robot,
                                       const TLikelihoodOptions& options);

}  // namespace mrpt_polyloc
