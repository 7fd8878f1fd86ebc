#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/scan/Motion.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// What a robot saw at one moment, with one laser or several, and how it came there.
struct POLYLOC_EXPORT Moment {
  std::vector<RangeScan> scans;
  Motion since_before;  ///< since the moment before; of the first moment it is not looked at
  /// Nothing is known of the way here: what was before does not belong to it.
  bool is_after_gap = false;
};

/// Scans that belong together: several lasers of one moment, the last metres of a drive, or both.
/// The robot's pose at each is known from now, the last moment, up to the wheels' errors.
///
/// Never empty. Immutable.
class POLYLOC_EXPORT ScanSet {
 public:
  explicit ScanSet(RangeScan scan);
  /// Several lasers of one moment. \throws InvalidParamsError as below
  explicit ScanSet(std::vector<RangeScan> scans);
  /// A drive, the first moment first, now last.
  /// \throws InvalidParamsError if there is no moment, one has no scan, a movement is not finite, a
  /// moment but the first comes after a gap, or stamps fall from one moment to the next (stamps of
  /// 0 are not known)
  explicit ScanSet(std::vector<Moment> moments);

  const std::vector<Moment>& moments() const { return moments_; }
  const Moment& now() const { return moments_.back(); }
  std::size_t scanCount() const { return scan_count_; }
  std::size_t hitCount() const { return hit_count_; }
  /// The one scan, if there is only one; else null.
  const RangeScan* single() const;

  /// The robot at a moment as seen from the robot now: the way back, with its uncertainty.
  /// \param moment index into moments()
  const Motion& fromNow(std::size_t moment) const { return from_now_[moment]; }

 private:
  std::vector<Moment> moments_;
  std::vector<Motion> from_now_;
  std::size_t scan_count_ = 0;
  std::size_t hit_count_ = 0;
};

/// Scans with time stamps at most so far apart are of one moment [s].
constexpr double kOneMoment = 0.05;

struct POLYLOC_EXPORT LastMetresParams {
  double length = 2.0;  ///< what was seen on the last so many metres is kept [m]; 0: now alone
  /// Of moments nearer together than this [m] ...
  double spacing = 0.2;
  /// ... and turned by less than this [rad] only the later is kept: they see the same.
  double turn = 0.2617993877991494;  // 15 degrees
  std::size_t most_moments = 12;     ///< the latest so many are kept
  /// A movement from one moment to the next that is longer than this [m] is no drive but a jump of
  /// the wheels, or a gap of the log: what was before is not looked at.
  double longest_step = 1.0;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// What was seen on the last metres of a drive before a moment, and at it.
/// \param now index into `drive`
/// \throws InvalidParamsError as ScanSet
POLYLOC_EXPORT ScanSet lastMetres(const std::vector<Moment>& drive, std::size_t now,
                                  const LastMetresParams& params = {});

/// Gathers the last metres of a drive, moment by moment.
class POLYLOC_EXPORT ScanAccumulator {
 public:
  /// \throws InvalidParamsError
  explicit ScanAccumulator(const LastMetresParams& params = {});

  /// What is seen now. \param since_before the movement since the last call; of the first call it
  /// is not looked at
  /// \returns the set of now and what is kept of before
  /// \throws InvalidParamsError as ScanSet
  ScanSet add(std::vector<RangeScan> scans, const Motion& since_before);

  /// Forgets what was seen: the robot may have been carried.
  void clear() { drive_.clear(); }

 private:
  LastMetresParams params_;
  std::vector<Moment> drive_;
};

}  // namespace mrpt_polyloc
