#pragma once

#include <mrpt_polyloc/io/GzInputStream.h>

#include <cstddef>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// A file's content on its way to MRPT's classes, which take memory for as many elements as a file
/// states before they read any: 17 GB for a scan, and MRPT 2 does not notice where it gets none.
/// This looks at what is read, and ends the reading where a laser scan states more than kMaxBeams,
/// an occupancy grid more than kMaxBitmapCells, a simplemap more than kMaxMapPoses or a movement by
/// odometry more than kMaxDrawnPoses, and where the content ends. So it does where MRPT would use
/// an object that it cannot make: of an abstract class, or of another one than a movement's.
///
/// It knows the layouts of those four classes in all their versions; what is laid out otherwise it
/// does not look at.
class GuardedStream : public mrpt::io::CStream {
 public:
  /// Keeps a reference.
  explicit GuardedStream(GzInputStream& stream) : stream_(stream) {}

  /// Why reading was ended; empty if it was not.
  const std::string& refusal() const { return refusal_; }

  /// \throws std::runtime_error where reading is ended
  std::size_t Read(void* buffer, std::size_t count) override;
  std::size_t Write(const void* buffer, std::size_t count) override;
  std::uint64_t Seek(std::int64_t offset, CStream::TSeekOrigin origin) override;
  std::uint64_t getTotalBytesCount() const override { return stream_.getTotalBytesCount(); }
  std::uint64_t getPosition() const override { return stream_.getPosition(); }

 private:
  /// What a read holds. Objects are stored as the length of the class's name, the name, the
  /// version, the content, and an end flag; before MRPT 0.5.5 with wider numbers and without the
  /// flag.
  enum class Field {
    skipped,  ///< so many bytes, by as many reads
    length,   ///< of the name of an object's class
    name,
    version,
    rows,  ///< of a matrix
    columns,
    beam_count,
    pose_count,
    grid_limits,  ///< sizes, limits and resolution: seven reads
    method,       ///< by which a movement was estimated; `bytes` is its version
    drawn_count,  ///< poses that MRPT draws from a movement
    pdf_length,   ///< of the name of a class of distributions of poses
    pdf_name,
  };
  enum class Kind {
    scan,
    grid,
    simplemap,
    movement,
    pose,
    plane_pose,
    float_matrix,
    double_matrix
  };
  struct Step {
    Field field;
    std::size_t bytes = 0;   ///< that are skipped
    Kind kind = Kind::scan;  ///< of the object
    bool is_old = false;     ///< stored as before MRPT 0.5.5
  };

  void look(const unsigned char* bytes, std::size_t count);
  void lookForObject(const unsigned char* bytes, std::size_t count);
  void begin(Kind kind, unsigned version, bool is_old);
  void lookAtLimits(const unsigned char* bytes);
  void lookAtMethod(const Step& step, std::uint32_t method);
  [[noreturn]] void refuse(const std::string& reason);

  GzInputStream& stream_;
  std::string refusal_;
  std::vector<Step> steps_;      ///< of the object that is watched, the next one last
  std::size_t name_length_ = 0;  ///< of a class, if the last reads may be that; else 0
  bool name_is_old_ = false;     ///< whether three more bytes belong to it
  std::size_t rows_ = 0;         ///< of a matrix
  std::vector<float> numbers_;   ///< of a grid: limits [m] and the cells' side [m]
};

}  // namespace mrpt_polyloc
