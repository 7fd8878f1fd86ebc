#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/ranking/Hypothesis.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// A laser as the planner needs it: where its beams go and how far they reach.
struct POLYLOC_EXPORT LaserModel {
  std::vector<double> bearings;       ///< in the robot frame, the sensor's yaw included [rad]
  mrpt::math::TPoint2D sensor{0, 0};  ///< of the beams' origin in the robot frame [m]
  double max_range = 20.0;            ///< [m]

  /// The laser of a scan, with at most so many of its beams, evenly chosen; beams that say nothing
  /// count, for they may say something elsewhere. \param max_range 0: that of the scan's
  /// no-returns, or, if it has none, of its farthest hit [m]
  static LaserModel of(const RangeScan& scan, std::size_t most_beams, double max_range = 0.0);

  /// The widest part of the circle without a beam taken off the whole [rad].
  double fieldOfView() const;
};

/// Between which ranges a laser would read, beam by beam, if a hypothesis were true: bands that
/// hold the reading for all poses near the hypothesis's that its covariance allows [m].
///
/// `low` is where the view may end first: at the nearest wall or open edge; `high` where it ends at
/// last, infinite where it need not. A beam through an open edge may end anywhere behind it.
struct POLYLOC_EXPORT ExpectedReadings {
  std::vector<float> low, high;
};

struct POLYLOC_EXPORT ExpectedReadingsParams {
  /// Bands are so much wider than what is predicted, on either side [m]: a lidar's noise and the
  /// map's own error.
  double tolerance = 0.05;
  /// Bands cover so many standard deviations of the position, along its widest direction ...
  double deviations = 2.0;
  double most_deviation = 0.6;  ///< ... up to here [m]

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// Predicts such bands. Keeps a reference to the predictor. Const and thread-safe.
class POLYLOC_EXPORT ReadingExpectation {
 public:
  /// \throws InvalidParamsError
  ReadingExpectation(const RangePredictor& predictor, const LaserModel& laser,
                     const ExpectedReadingsParams& params = {});

  /// What would be read if the robot moved from where it is now to another pose.
  /// \param hypothesis where it is now \param moved there, in the robot's frame of now
  ExpectedReadings at(const Hypothesis& hypothesis, const mrpt::math::TPose2D& moved) const;

 private:
  const RangePredictor* predictor_;
  LaserModel laser_;
  ExpectedReadingsParams params_;
  BeamPattern pattern_;
  std::vector<std::size_t> next_, previous_;  ///< neighbours of each beam, itself at a gap
};

}  // namespace mrpt_polyloc
