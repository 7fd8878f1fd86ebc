#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/io/SensorTilt.h>
#include <mrpt_polyloc/io/sensor_survey.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace mrpt_polyloc {

void ReadingOptions::check() const {
  if (max_range) requirePositive("max_range", *max_range);
  if (min_range) requireNotNegative("min_range", *min_range);
  if (max_range && min_range && *min_range >= *max_range) {
    throw InvalidParamsError("min_range is not below max_range");
  }
}

namespace {

using Scans = std::vector<const LoggedScan*>;

constexpr double kStrayShare = 1e-3;      // of all readings, above the spike
constexpr double kSpikeWidth = 0.0015;    // of the range: 81.83 to 81.91 m is one code
constexpr double kDensityBelow = 0.90;    // of the range: down to there the spike is compared
constexpr double kSpreadShare = 2e-3;     // of all readings, above the stated maximum
constexpr std::size_t kLeastSpread = 20;  // readings, the same
constexpr double kSpreadAbove = 1.02;     // of the stated maximum
constexpr std::size_t kSurveyed = 200;    // scans in which the robot is looked for
constexpr std::size_t kLeastScans = 20;   // the same
constexpr double kRobotRange = 0.5;       // [m]
constexpr double kConstant = 0.02;        // [m]
constexpr double kConstantShare = 0.9;

bool isRange(double range) {
  return std::isfinite(range) && range > 0.0;
}

std::string metres(double x) {
  return formatted("%g m", x);
}

std::string percent(double share) {
  return formatted("%.2g %%", 100.0 * share);
}

/// How many readings there are of each range: bins of less than 0.8 %, the upper bits of a float.
class RangeHistogram {
 public:
  explicit RangeHistogram(const Scans& scans) : bins_(1U << 15U) {
    for (const LoggedScan* scan : scans) {
      for (std::size_t i = 0; i < scan->ranges.size(); ++i) add(scan->ranges[i], scan->isValid(i));
    }
  }

  std::size_t count() const { return count_; }
  bool hasInfinity() const { return has_infinity_; }

  /// The greatest range but for so many stray ones; 0 if there is none.
  double greatest(std::size_t stray) const {
    std::size_t above = 0;
    for (std::size_t i = bins_.size(); i-- > 0;) {
      if (bins_[i].count == 0) continue;
      above += bins_[i].count;
      if (above > stray) return bins_[i].greatest;
    }
    return 0.0;
  }

  /// Valid readings between two ranges, to the width of a bin.
  std::size_t validBetween(double low, double high) const {
    std::size_t valid = 0;
    for (std::size_t i = binOf(low) + 1; i < binOf(high); ++i) valid += bins_[i].valid;
    return valid;
  }

 private:
  struct Bin {
    std::size_t count = 0, valid = 0;
    double greatest = 0.0;
  };

  static std::size_t binOf(double range) {
    const auto single = static_cast<float>(range);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &single, sizeof(bits));
    return bits >> 16U;
  }

  void add(double range, bool is_valid) {
    has_infinity_ |= std::isinf(range) && range > 0.0;
    if (!isRange(range) || !std::isfinite(static_cast<float>(range))) return;
    Bin& bin = bins_[binOf(range)];
    ++bin.count;
    bin.valid += is_valid ? 1 : 0;
    bin.greatest = std::max(bin.greatest, range);
    ++count_;
  }

  std::vector<Bin> bins_;
  std::size_t count_ = 0;
  bool has_infinity_ = false;
};

/// What stands at the top of the readings.
struct Top {
  std::size_t readings = 0;   ///< in the upper 2 %
  std::size_t below = 0;      ///< from kDensityBelow to there
  std::size_t scans = 0;      ///< with a reading in the upper 2 %
  double greatest_share = 0;  ///< of these readings: the most within kSpikeWidth
};

Top topOf(const Scans& scans, double greatest) {
  Top top;
  std::vector<double> values;
  for (const LoggedScan* scan : scans) {
    const std::size_t before = values.size();
    for (const double range : scan->ranges) {
      if (!(range >= kDensityBelow * greatest) || range > greatest) continue;
      if (range >= kNoReturnShare * greatest) {
        values.push_back(range);
      } else {
        ++top.below;
      }
    }
    top.scans += values.size() > before ? 1 : 0;
  }
  std::sort(values.begin(), values.end());
  std::size_t most = 0;
  for (std::size_t low = 0, high = 0; high < values.size(); ++high) {
    while (values[low] < values[high] * (1.0 - kSpikeWidth)) ++low;
    most = std::max(most, high - low + 1);
  }
  top.readings = values.size();
  top.greatest_share =
      values.empty() ? 0.0 : static_cast<double>(most) / static_cast<double>(values.size());
  return top;
}

/// Whether readings at the top are of nothing that came back.
bool standsOut(const Top& top, std::size_t scans, bool against_stated) {
  const double share = against_stated ? 0.7 : 0.5;
  const double scan_share = against_stated ? 0.1 : 0.02;
  const std::size_t least = against_stated ? 10 : 3;
  constexpr double kBelowWidth = (kNoReturnShare - kDensityBelow) / (1.0 - kNoReturnShare);
  return top.scans >= least &&
         static_cast<double>(top.scans) >= scan_share * static_cast<double>(scans) &&
         top.greatest_share >= share &&
         static_cast<double>(top.readings) * kBelowWidth >= static_cast<double>(top.below);
}

/// The value that stands out at the top of the readings; 0 if none does.
double spike(const Scans& scans, const RangeHistogram& histogram, bool against_stated) {
  const auto stray = static_cast<std::size_t>(kStrayShare * static_cast<double>(histogram.count()));
  double last = 0.0;
  for (const double greatest : {histogram.greatest(0), histogram.greatest(stray)}) {
    if (greatest == last || greatest <= 0.0) continue;
    if (standsOut(topOf(scans, greatest), scans.size(), against_stated)) return greatest;
    last = greatest;
  }
  return 0.0;
}

constexpr const char* kTellIt = " (--max-range M says it)";

double unsaidMaximum(const Scans& scans, const RangeHistogram& histogram, Notes* notes) {
  const double found = spike(scans, histogram, false);
  const std::string unsaid = "the maximum range is not said";
  if (found > 0.0) {
    addNote(notes, unsaid + ", taken for " + metres(found) +
                       ": many scans have the same reading there, the greatest of all" + kTellIt);
    return found;
  }
  if (histogram.hasInfinity()) {
    const double greatest = histogram.greatest(0);
    addNote(notes, unsaid + ": infinite readings are taken for nothing within " + metres(greatest) +
                       ", the greatest range that was read" + kTellIt);
    return greatest;
  }
  addNote(notes, unsaid + ", and no reading stands out as such: all are taken for hits" + kTellIt);
  return 0.0;
}

double maximumRange(const Scans& scans, double stated, Notes* notes) {
  const RangeHistogram histogram(scans);
  if (!isRange(stated)) return unsaidMaximum(scans, histogram, notes);
  const double greatest = histogram.greatest(0);
  const std::size_t spread =
      histogram.validBetween(kSpreadAbove * stated, kNoReturnShare * greatest);
  const bool above =
      greatest > kSpreadAbove * stated && spread >= kLeastSpread &&
      static_cast<double>(spread) > kSpreadShare * static_cast<double>(histogram.count());
  if (above) {
    const double found = std::max(spike(scans, histogram, false), stated);
    const double taken = found > stated ? found : greatest;
    addNote(notes,
            "the maximum range is said to be " + metres(stated) + ", but " +
                percent(static_cast<double>(spread) / static_cast<double>(histogram.count())) +
                " of the readings are valid and above it, up to " + metres(greatest) +
                ": taken for " + metres(taken) + kTellIt);
    return taken;
  }
  if (greatest >= kNoReturnShare * stated) return stated;
  const double found = spike(scans, histogram, true);
  if (found <= 0.0) return stated;
  addNote(notes, "the maximum range is said to be " + metres(stated) + ", but " + metres(found) +
                     " is the greatest reading of many scans: taken for that" + kTellIt);
  return found;
}

/// Share of the scans in which a beam reads the same, and what it reads.
struct Constancy {
  double share = 0.0;
  double range = 0.0;  ///< median [m]
};

Constancy constancyOf(const Scans& scans, std::size_t beam, std::vector<double>& ranges) {
  ranges.clear();
  for (const LoggedScan* scan : scans) {
    if (isRange(scan->ranges[beam]) && scan->isValid(beam)) ranges.push_back(scan->ranges[beam]);
  }
  if (ranges.empty()) return {};
  const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
  std::nth_element(ranges.begin(), middle, ranges.end());
  const double median = *middle;
  const auto same = std::count_if(ranges.begin(), ranges.end(), [&](double range) {
    return std::abs(range - median) <= kConstant;
  });
  return {static_cast<double>(same) / static_cast<double>(scans.size()), median};
}

std::vector<bool> findRobotBeams(const Scans& scans, Notes* notes) {
  if (scans.size() < kLeastScans) return {};
  const std::size_t beams = scans.front()->ranges.size();
  const bool alike = std::all_of(scans.begin(), scans.end(), [&](const LoggedScan* scan) {
    return scan->ranges.size() == beams;
  });
  if (!alike) return {};
  Scans spread;
  const std::size_t used = std::min(scans.size(), kSurveyed);
  for (std::size_t k = 0; k < used; ++k) spread.push_back(scans[k * scans.size() / used]);

  std::vector<bool> robot(beams, false);
  std::vector<double> ranges;
  std::size_t found = 0, far_beams = 0, far_constant = 0;
  double least = kRobotRange, most = 0.0;
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const Constancy seen = constancyOf(spread, beam, ranges);
    const bool constant = seen.share >= kConstantShare;
    if (seen.range >= kRobotRange) {
      ++far_beams;
      far_constant += constant ? 1 : 0;
    } else if (constant) {
      robot[beam] = true;
      ++found;
      least = std::min(least, seen.range);
      most = std::max(most, seen.range);
    }
  }
  if (found == 0 || 2 * far_constant >= far_beams) return {};  // none, or the robot stood still
  addNote(notes,
          formatted("%zu of %zu beams read the same in nearly all scans, %g to %g m: taken for the "
                    "robot itself, they say nothing (--min-range M says otherwise)",
                    found, beams, least, most));
  return robot;
}

void noteTilt(const Scans& scans, Notes* notes) {
  double greatest = 0.0;
  for (const LoggedScan* scan : scans) {
    const SensorTilt tilt(scan->yaw, scan->pitch, scan->roll, scan->height);
    greatest = std::max(greatest, tilt.angle());
  }
  if (greatest < kNotedTilt) return;
  addNote(notes, formatted("the sensor is tilted by %.3g deg: its readings are projected to the "
                           "floor's plane",
                           toDegrees(greatest)));
}

}  // namespace

SensorFacts surveySensor(const Scans& scans, const ReadingOptions& options, Notes* notes) {
  SensorFacts facts;
  if (scans.empty()) return facts;
  facts.limits.max_range =
      options.max_range ? *options.max_range : maximumRange(scans, scans.front()->max_range, notes);
  if (options.min_range) {
    facts.limits.min_range = *options.min_range;
  } else {
    facts.robot_beams = findRobotBeams(scans, notes);
  }
  noteTilt(scans, notes);
  return facts;
}

namespace {

/// All scans that state no maximum are one kind.
std::pair<std::string, double> kindOf(const LoggedScan& scan) {
  return {scan.label, isRange(scan.max_range) ? scan.max_range : 0.0};
}

}  // namespace

LogSurvey::LogSurvey(const std::vector<LoggedScan>& scans, const ReadingOptions& options,
                     Notes* notes) {
  options.check();
  std::map<std::pair<std::string, double>, Scans> kinds;
  for (const LoggedScan& scan : scans) kinds[kindOf(scan)].push_back(&scan);
  for (const auto& [kind, own] : kinds) facts_[kind] = surveySensor(own, options, notes);
}

const SensorFacts& LogSurvey::of(const LoggedScan& scan) const {
  return facts_.at(kindOf(scan));
}

std::vector<RangeScan> toRangeScans(const std::string& path, std::vector<LoggedScan> scans,
                                    const ReadingOptions& options, Notes* notes) {
  const LogSurvey survey(scans, options, notes);
  std::vector<RangeScan> result;
  result.reserve(scans.size());
  for (LoggedScan& scan : scans) {
    const SensorFacts& facts = survey.of(scan);
    try {
      result.push_back(toRangeScan(scan, facts.limits, facts.robot_beams));
    } catch (const std::invalid_argument& error) {
      throw FormatError(path, scan.place, error.what());
    }
    scan = {};  // its readings are not needed twice
  }
  return result;
}

}  // namespace mrpt_polyloc
