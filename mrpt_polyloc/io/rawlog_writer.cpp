#include <mrpt_polyloc/io/rawlog_writer.h>

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose2D.h>
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

/// A gzip file that objects are written into, one after the other.
// Not through MRPT's CFileGZOutputStream: it does not tell of a full disk when it closes the file.
class RawlogFile {
 public:
  explicit RawlogFile(const std::string& path) : path_(path), file_(nullptr, gzclose) {
    errno = 0;
    file_.reset(gzopen(path.c_str(), "wb"));
    if (!file_) fail(path);
  }

  void write(const mrpt::serialization::CSerializable& object) {
    mrpt::io::CMemoryStream bytes;
    mrpt::serialization::archiveFrom(bytes) << object;
    const auto size = static_cast<unsigned>(bytes.getTotalBytesCount());
    if (gzwrite(file_.get(), bytes.getRawBufferData(), size) != static_cast<int>(size)) {
      fail(path_);
    }
  }

  void close() {
    if (gzclose(file_.release()) != Z_OK) fail(path_);
  }

 private:
  const std::string& path_;
  std::unique_ptr<gzFile_s, int (*)(gzFile)> file_;
};

}  // namespace

void writeScansRawlog(const std::string& path,
                      const std::vector<mrpt::obs::CObservation2DRangeScan>& scans) {
  RawlogFile file(path);
  for (const auto& scan : scans) file.write(scan);
  file.close();
}

void writeDriveRawlog(const std::string& path, const std::vector<RawlogMoment>& moments,
                      const MotionNoise& noise) {
  using mrpt::obs::CActionRobotMovement2D;
  CActionRobotMovement2D::TMotionModelOptions model;
  model.modelSelection = CActionRobotMovement2D::mmGaussian;
  auto& gaussian = model.gaussianModel;  // variances from length and turn, and least deviations
  gaussian.a1 = static_cast<float>(noise.position_per_metre);
  gaussian.a2 = 0.0F;
  gaussian.a3 = static_cast<float>(noise.heading_per_metre);
  gaussian.a4 = static_cast<float>(noise.heading_per_radian);
  gaussian.minStdXY = 0.005F;
  gaussian.minStdPHI = 0.0035F;
  RawlogFile file(path);
  for (const RawlogMoment& moment : moments) {
    CActionRobotMovement2D movement;
    if (!moment.scans.empty()) movement.timestamp = moment.scans.front().timestamp;
    movement.computeFromOdometry(mrpt::poses::CPose2D(moment.movement), model);
    mrpt::obs::CActionCollection actions;
    actions.insert(movement);
    file.write(actions);
    mrpt::obs::CSensoryFrame frame;
    for (const auto& scan : moment.scans) {
      frame.insert(mrpt::obs::CObservation2DRangeScan::Create(scan));
    }
    file.write(frame);
  }
  file.close();
}

}  // namespace mrpt_polyloc
