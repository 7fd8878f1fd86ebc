#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/mrpt_archive.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/io/rawlog.h>
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

/// Adds the scans that an object is or holds.
void collectScans(const mrpt::serialization::CSerializable::Ptr& object, std::size_t index,
                  std::vector<StoredScan>& scans) {
  if (auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(object)) {
    scans.push_back({std::move(scan), index});
  } else if (auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object)) {
    for (const auto& observation : *frame) collectScans(observation, index, scans);
  } else if (auto rawlog = std::dynamic_pointer_cast<mrpt::obs::CRawlog>(object)) {
    for (std::size_t i = 0; i < rawlog->size(); ++i) {
      collectScans(rawlog->getAsGeneric(i), index, scans);
    }
  }
}

}  // namespace

std::vector<RangeScan> loadRawlog(const std::string& path, const ScanFileOptions& options,
                                  Notes* notes) {
  std::vector<StoredScan> stored;
  readObjects(path, options.strict, notes,
              [&](const auto& object, std::size_t index) { collectScans(object, index, stored); });

  std::vector<std::string> labels;
  labels.reserve(stored.size());
  for (const StoredScan& entry : stored) labels.push_back(entry.scan->sensorLabel);

  std::vector<LoggedScan> scans;
  for (const std::size_t i : selectSensor(path, labels, options.sensor_label)) {
    const std::string place = "object " + std::to_string(stored[i].object);
    try {
      scans.push_back(toLoggedScan(*stored[i].scan));
    } catch (const std::invalid_argument& error) {
      throw FormatError(path, place, error.what());
    }
    scans.back().place = place;
    stored[i].scan.reset();  // its readings are not needed twice
  }
  return toRangeScans(path, std::move(scans), options.readings, notes);
}

}  // namespace mrpt_polyloc
