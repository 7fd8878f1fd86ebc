#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/mrpt_archive.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/io/rawlog.h>
#include <mrpt_polyloc/io/sensor_labels.h>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cstddef>
#include <memory>
#include <stdexcept>

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

std::vector<RangeScan> loadRawlog(const std::string& path, const std::string& sensor_label) {
  GzInputStream stream(path);
  std::vector<StoredScan> stored;
  for (std::size_t index = 0; !stream.atEnd(); ++index) {
    collectScans(readObject(stream, index), index, stored);
  }

  std::vector<std::string> labels;
  labels.reserve(stored.size());
  for (const StoredScan& entry : stored) labels.push_back(entry.scan->sensorLabel);

  std::vector<RangeScan> scans;
  for (const std::size_t i : selectSensor(path, labels, sensor_label)) {
    try {
      scans.push_back(toRangeScan(*stored[i].scan));
    } catch (const std::invalid_argument& error) {
      throw FormatError(path, "object " + std::to_string(stored[i].object), error.what());
    }
  }
  return scans;
}

}  // namespace mrpt_polyloc
