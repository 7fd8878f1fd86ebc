#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/io/readings.h>
#include <mrpt_polyloc/io/scan_files.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// A log of scans that is read a row at a time: logs of millions of scans take some 40 bytes a scan
/// of memory.
///
/// The file is read once, from beginning to end, as loadScans() does; what is found goes to a
/// nameless temporary file, from which rows are read again. Rows are those of loadScans(): equal
/// for logs of up to kSurveyed scans. Of longer ones only so many, spread evenly, are asked what
/// the sensor is like (see surveySensor()).
class POLYLOC_EXPORT ScanLog {
 public:
  static constexpr std::size_t kSurveyed = 20'000;

  /// \param notes gets a sentence for all that was assumed or is missing; may be null
  /// \throws FormatError as loadScans() does, but for a sensor whose tilt is refused, and if there
  /// is no room for the temporary file
  explicit ScanLog(const std::string& path, const ScanFileOptions& options = {},
                   Notes* notes = nullptr);
  ~ScanLog();
  ScanLog(const ScanLog&) = delete;
  ScanLog& operator=(const ScanLog&) = delete;

  std::size_t size() const { return rows_.size(); }
  double stamp(std::size_t row) const { return rows_[row].stamp; }  ///< [s]

  /// \throws FormatError naming the file and the place, for a sensor whose tilt is refused. Const
  /// and thread-safe.
  RangeScan scan(std::size_t row) const;

 private:
  struct Row {
    long offset = 0;       ///< in the temporary file
    double stamp = 0.0;    ///< [s]
    std::size_t size = 0;  ///< bytes there
    std::size_t number = 0;
  };
  struct Parts;
  LoggedScan logged(const Row& row) const;

  std::string path_;
  std::vector<Row> rows_;
  std::unique_ptr<Parts> parts_;
};

}  // namespace mrpt_polyloc
