#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/carmen.h>
#include <mrpt_polyloc/io/file_extension.h>
#include <mrpt_polyloc/io/rawlog.h>
#include <mrpt_polyloc/io/scan_files.h>

namespace mrpt_polyloc {

std::vector<RangeScan> loadScans(const std::string& path, const ScanFileOptions& options,
                                 Notes* notes) {
  const std::string extension = contentExtension(path);
  if (extension == ".rawlog") return loadRawlog(path, options, notes);
  if (extension == ".log" || extension == ".clf") return loadCarmen(path, options, notes);
  throw FormatError(
      path, "",
      "unknown extension '" + extension +
          "', known for scans are .rawlog, .log and .clf, each also with .gz or .zst");
}

}  // namespace mrpt_polyloc
