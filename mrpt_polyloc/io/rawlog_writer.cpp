#include <mrpt_polyloc/io/rawlog_writer.h>

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <zlib.h>

namespace mrpt_polyloc {

namespace {

[[noreturn]] void fail(const std::string& path) {
  const std::string reason = errno == 0 ? "" : ": " + std::string(std::strerror(errno));
  throw std::runtime_error(path + ": cannot be written" + reason);
}

}  // namespace

// Not through MRPT's CFileGZOutputStream: it does not tell of a full disk when it closes the file.
void writeScansRawlog(const std::string& path,
                      const std::vector<mrpt::obs::CObservation2DRangeScan>& scans) {
  errno = 0;
  std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "wb"), gzclose);
  if (!file) fail(path);
  for (const auto& scan : scans) {
    mrpt::io::CMemoryStream bytes;
    mrpt::serialization::archiveFrom(bytes) << scan;
    const auto size = static_cast<unsigned>(bytes.getTotalBytesCount());
    if (gzwrite(file.get(), bytes.getRawBufferData(), size) != static_cast<int>(size)) fail(path);
  }
  if (gzclose(file.release()) != Z_OK) fail(path);
}

}  // namespace mrpt_polyloc
