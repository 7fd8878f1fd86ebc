#pragma once

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/scan/Motion.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>
#include <mrpt_polyloc/travel/HypothesisTracker.h>

#include <mrpt/math/TPose2D.h>

#include <optional>

namespace mrpt_polyloc::apps {

/// Within it, two hypotheses are the same place to a robot that plans where to look.
inline constexpr Tolerance kSamePlace{0.5, 10.0 * kDegree};

/// What the localizer of a robot that drives to be sure is made with: where scans of a drive are
/// judged together, each that may be searched is, or the right place might be missing from the
/// list.
GlobalLocalizerParams surerSearch();

/// What a robot makes of its scans on a drive: where it may be, and when it is sure. A tracker,
/// begun with a list that is whole, and confirmed by searches of the last metres.
class DriveBelief {
 public:
  /// Keeps the reference. \param prior what is known of the pose of the first scan
  DriveBelief(const GlobalLocalizer& localizer, const MotionNoise& odometry,
              const PosePrior& prior);

  /// \param turned by all turns on the way together [rad]
  void move(const Motion& measured, double turned);
  void look(const RangeScan& scan);

  const TrackingState& state() const { return tracker_.state(); }
  /// Whether the hypotheses are worth to be planned for: the list is whole, and one may be right.
  bool isKnowing() const { return is_anchored_ && !isLost(); }
  /// The pose that the robot is sure of, by the last scan.
  const std::optional<mrpt::math::TPose2D>& answer() const { return answer_; }

 private:
  PosePrior priorNow() const;
  void follow(const ScanSet& drive);
  void search(const ScanSet& drive);
  std::optional<mrpt::math::TPose2D> conclude(const ScanSet& drive);
  bool isLost() const;

  const GlobalLocalizer& localizer_;
  MotionNoise odometry_noise_;
  PosePrior prior_;
  HypothesisTracker tracker_;
  ScanAccumulator last_metres_;
  Motion since_scan_;
  std::optional<mrpt::math::TPose2D> answer_;
  LocalizationResult searched_;            ///< the last search of the last metres
  bool is_searched_now_ = false;           ///< ... up to the last scan
  bool is_anchored_ = false;               ///< the tracker began with a whole list
  mrpt::math::TPose2D odometry_{0, 0, 0};  ///< from the first scan
  double driven_ = 0.0, turned_ = 0.0;     ///< [m], [rad]
};

}  // namespace mrpt_polyloc::apps
