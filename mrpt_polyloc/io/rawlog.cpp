#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/limits.h>
#include <mrpt_polyloc/io/mrpt_archive.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/io/rawlog.h>
#include <mrpt_polyloc/io/scan_stream.h>
#include <mrpt_polyloc/io/sensor_labels.h>
#include <mrpt_polyloc/io/sensor_survey.h>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>

namespace mrpt_polyloc {

namespace {

using mrpt::obs::CObservation2DRangeScan;

struct StoredScan {
  CObservation2DRangeScan::Ptr scan;
  std::size_t object = 0;  ///< number of the object of the file that holds it
};

/// Gives the scans that an object is or holds.
template <class Take>
void forEachScan(const mrpt::serialization::CSerializable::Ptr& object, const Take& take) {
  if (auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(object)) {
    take(std::move(scan));
  } else if (auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object)) {
    for (const auto& observation : *frame) forEachScan(observation, take);
  } else if (auto rawlog = std::dynamic_pointer_cast<mrpt::obs::CRawlog>(object)) {
    for (std::size_t i = 0; i < rawlog->size(); ++i) forEachScan(rawlog->getAsGeneric(i), take);
  }
}

std::string placeOf(std::size_t object) {
  return "object " + std::to_string(object);
}

/// \throws FormatError naming the object for a scan that cannot be used
LoggedScan placedScan(const std::string& path, const StoredScan& stored) {
  const std::string place = placeOf(stored.object);
  try {
    LoggedScan scan = toLoggedScan(*stored.scan);
    scan.place = place;
    return scan;
  } catch (const std::invalid_argument& error) {
    throw FormatError(path, place, error.what());
  }
}

}  // namespace

std::vector<RangeScan> loadRawlog(const std::string& path, const ScanFileOptions& options,
                                  Notes* notes) {
  std::vector<StoredScan> stored;
  readObjects(path, options.strict, notes, [&](const auto& object, std::size_t index) {
    forEachScan(object, [&](auto scan) { stored.push_back({std::move(scan), index}); });
    requireScans(path, placeOf(index), stored.size(), options.max_scans);
  });

  std::vector<std::string> labels;
  labels.reserve(stored.size());
  for (const StoredScan& entry : stored) labels.push_back(entry.scan->sensorLabel);

  std::vector<LoggedScan> scans;
  for (const std::size_t i : selectSensor(path, labels, options.sensor_label)) {
    scans.push_back(placedScan(path, stored[i]));
    stored[i].scan.reset();  // its readings are not needed twice
  }
  return toRangeScans(path, std::move(scans), options.readings, notes);
}

ScanStreamEnd streamRawlog(const std::string& path, const ScanFileOptions& options, Notes* notes,
                           const TakeLoggedScan& take) {
  std::vector<std::string> labels;
  readObjects(path, options.strict, notes, [&](const auto& object, std::size_t index) {
    forEachScan(object, [&](auto scan) {
      labels.push_back(scan->sensorLabel);
      const bool is_wanted = options.sensor_label.empty() || labels.back() == options.sensor_label;
      // Those of other sensors keep their number, and nothing else.
      take(is_wanted ? placedScan(path, {std::move(scan), index}) : LoggedScan{});
    });
    requireScans(path, placeOf(index), labels.size(), options.max_scans);
  });
  return {selectSensor(path, labels, options.sensor_label), {}};
}

}  // namespace mrpt_polyloc
