#pragma once

#include <mrpt_polyloc/localization/MatchFeatures.h>

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// What the answer means.
enum class LocalizationStatus {
  unique,     ///< the first hypothesis has no rival that explains the scan as well
  ambiguous,  ///< several poses explain the scan about equally well
  /// No pose explains the scan: another building, or too much changed. (Of a search that a budget
  /// ended: none of those found by then.)
  no_match,
  too_few_beams  ///< the scan holds too little information to search for
};

/// "unique", "ambiguous", "no_match" or "too_few_beams".
const char* toString(LocalizationStatus status);

/// One pose that explains the scan.
struct Hypothesis {
  mrpt::math::TPose2D pose_map_robot;      ///< of the ROBOT, not its sensor [m, rad]
  mrpt::math::CMatrixDouble33 covariance;  ///< of (x, y, phi) of the robot [m, rad]
  /// Probability that this is the pose, if one of the hypotheses is; all weights sum to 1.
  double weight = 0.0;
  double cost = 0.0;  ///< mean robust cost per beam [m]
  /// By how many standard errors it explains the scan worse than the first does, sectors of beams
  /// taken as the independent observations; 0 for the first.
  double behind = 0.0;
};

/// What is known of the robot's pose before the search; empty means nothing.
struct PosePrior {
  struct Compass {
    double heading;    ///< of the robot in the map [rad]
    double tolerance;  ///< greatest error of it [rad], in [0, pi]
  };
  struct Disk {
    double x, y;    ///< of the ROBOT in the map [m]
    double radius;  ///< [m]
  };
  std::optional<Compass> compass;
  std::optional<Disk> near;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// What the search did.
struct SearchStatistics {
  std::size_t positions = 0;   ///< candidate positions, or cells, in the index
  std::size_t evaluated = 0;   ///< nodes whose cost was bounded or evaluated
  std::size_t refined = 0;     ///< candidates refined
  double search_ms = 0.0;      ///< wall time of the search
  double refinement_ms = 0.0;  ///< wall time of refinement, ranking and merging
};

/// What the certified search has proven: no pose that the prior allows, its sensor in free space,
/// has a search cost of at most `cost` but those near the hypotheses and in regions that bounds do
/// not exclude (see GlobalLocalizerParams::keep_regions).
struct Certificate {
  double cost = 0.0;        ///< search cost [m]: a mean over the beams searched with
  bool is_complete = true;  ///< false: a budget ended the search before the margin was reached
  std::size_t regions = 0;  ///< not excluded, each a cell and a few degrees of heading
};

/// Poses of the beam frame (see RangeScan) in the map that could not be excluded.
struct PoseRegion {
  std::vector<mrpt::math::TPoint2D> cell;  ///< convex polygon of the sensor's positions [m]
  double first_heading, last_heading;      ///< counterclockwise from the first to the last [rad]
  double bound;                            ///< no pose of it has a lower search cost [m]
};

/// All hypotheses for one scan, best first; empty unless status is unique or ambiguous.
struct LocalizationResult {
  LocalizationStatus status = LocalizationStatus::too_few_beams;
  /// Probability that the scan was taken in this map, as far as its best answer tells (see
  /// MatchFeatures), if as many scans are foreign as are not; 0 where nothing was found.
  double match_probability = 0.0;
  std::optional<MatchFeatures> features;  ///< of the best answer, if there is one
  std::vector<Hypothesis> hypotheses;
  std::optional<Certificate> certificate;  ///< of the certified search alone
  std::vector<PoseRegion> regions;         ///< if asked for
  SearchStatistics statistics;
};

}  // namespace mrpt_polyloc
