#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/base/notes.h>
#include <mrpt_polyloc/io/readings.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mrpt_polyloc {

/// What the readings of one sensor over a whole log tell of it.
struct POLYLOC_EXPORT SensorFacts {
  ReadingLimits limits;
  std::vector<bool> robot_beams;  ///< by index: sees the robot itself; empty if none does
};

/// Looks once at all scans of one sensor, which state one maximum range, for what no single scan
/// can tell.
///
/// *Maximum range.* The stated one stands, unless there is none, or the readings contradict it:
/// many valid ones (20 and 0.2 %) lie spread above it, or one value well below it is the greatest
/// of all and stands out as only "nothing came back" does. A value stands out if it is that of most
/// readings in the upper 2 % (half; 70 % against a stated maximum), to 0.15 % of the range, and
/// occurs in many scans (3 and 2 %; 10 and 10 % against a stated maximum), at least as densely as
/// the ranges below it; a thousandth of greater readings is passed over as stray. Where nothing is
/// stated and no value stands out, there is no maximum, and only hits; but if readings are
/// infinite, then they say that nothing was within the greatest range that was ever read.
///
/// *The robot itself.* A beam that reads the same to 2 cm, within 0.5 m, in 9 of 10 scans, while
/// most of the others do not read the same (the robot moved), says nothing. Looked for in logs of
/// 20 scans or more with one number of beams, on 200 scans spread over the log.
///
/// Cost: two passes over the readings.
/// \param notes gets a sentence for all that was assumed; may be null
POLYLOC_EXPORT SensorFacts surveySensor(const std::vector<const LoggedScan*>& scans,
                                        const ReadingOptions& options, Notes* notes);

/// The survey of all sensors of a log, those that change their stated maximum range apart.
class POLYLOC_EXPORT LogSurvey {
 public:
  /// \throws InvalidParamsError as ReadingOptions::check()
  LogSurvey(const std::vector<LoggedScan>& scans, const ReadingOptions& options, Notes* notes);

  /// What is known of the sensor of one of the scans.
  const SensorFacts& of(const LoggedScan& scan) const;

 private:
  std::map<std::pair<std::string, double>, SensorFacts> facts_;  ///< by label and stated maximum
};

/// The scans of a log, surveyed.
/// \param path of the file, for messages
/// \throws FormatError naming the file and the place of a scan whose sensor's tilt is refused;
/// InvalidParamsError as ReadingOptions::check()
POLYLOC_EXPORT std::vector<RangeScan> toRangeScans(const std::string& path,
                                                   std::vector<LoggedScan> scans,
                                                   const ReadingOptions& options, Notes* notes);

}  // namespace mrpt_polyloc
