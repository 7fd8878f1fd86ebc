#include <mrpt_polyloc/io/GuardedStream.h>
#include <mrpt_polyloc/io/bitmap_files.h>
#include <mrpt_polyloc/io/limits.h>

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/poses/CPosePDF.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace mrpt_polyloc {

namespace {

/// The length of a name has this bit, since MRPT 0.5.5.
constexpr unsigned kNew = 0x80;
/// Version from which a movement says first how it was estimated.
constexpr unsigned kFirstWithMethod = 2;

/// A read as MRPT takes it for the name of a class: up to a zero byte, if it holds one.
std::string_view nameOf(const unsigned char* bytes, std::size_t count) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), count);
  return text.substr(0, text.find('\0'));
}

/// Whether a name is that of a class, with or without its namespace.
bool isClass(std::string_view name, std::string_view wanted) {
  if (name.size() < wanted.size() || name.substr(name.size() - wanted.size()) != wanted) {
    return false;
  }
  return name.size() == wanted.size() || name[name.size() - wanted.size() - 1] == ':';
}

/// The class of this name; null if MRPT knows none.
const mrpt::rtti::TRuntimeClassId* classOf(std::string_view name) {
  return mrpt::rtti::findRegisteredClass(std::string(name));
}

/// MRPT stores little-endian.
std::uint32_t number(const unsigned char* bytes) {
  std::uint32_t value = 0;
  for (std::size_t k = 4; k-- > 0;) value = value << 8U | bytes[k];
  return value;
}

}  // namespace

std::size_t GuardedStream::Read(void* buffer, std::size_t count) {
  const std::size_t got = stream_.Read(buffer, count);
  // MRPT would go on with what stood in memory before: for a number of beams, anything.
  if (got < count) throw std::runtime_error("the content ends");
  if (count > 0) look(static_cast<const unsigned char*>(buffer), count);
  return got;
}

std::size_t GuardedStream::Write(const void* buffer, std::size_t count) {
  return stream_.Write(buffer, count);
}

std::uint64_t GuardedStream::Seek(std::int64_t offset, CStream::TSeekOrigin origin) {
  return stream_.Seek(offset, origin);
}

void GuardedStream::refuse(const std::string& reason) {
  refusal_ = reason;
  throw std::runtime_error(reason);
}

void GuardedStream::lookForObject(const unsigned char* bytes, std::size_t count) {
  // Before a name stands its length: not before a label that only looks like one.
  if (name_length_ == count && count > 3) {
    const std::string_view name = nameOf(bytes, count);
    for (const auto& [kind, wanted] :
         {std::pair(Kind::scan, "CObservation2DRangeScan"),
          std::pair(Kind::grid, "COccupancyGridMap2D"), std::pair(Kind::simplemap, "CSimpleMap"),
          std::pair(Kind::movement, "CActionRobotMovement2D")}) {
      if (isClass(name, wanted)) steps_ = {{Field::version, 0, kind, name_is_old_}};
    }
    const auto* const found = classOf(name);
    if (found != nullptr && !found->ptrCreateObject) {
      refuse("an object of the abstract class " + std::string(name));
    }
  }
  if (count == 1) {
    name_length_ = bytes[0] % kNew;
    name_is_old_ = bytes[0] < kNew;
  } else if (count != 3 || !name_is_old_) {
    name_length_ = 0;
  }
}

/// Puts down what an object of a version holds, as far as it is known and matters.
void GuardedStream::begin(Kind kind, unsigned version, bool is_old) {
  const auto put = [&](Field field, std::size_t bytes = 0, Kind of = Kind::scan) {
    steps_.push_back({field, bytes, of, is_old});
  };
  const bool is_nested = kind == Kind::pose || kind == Kind::plane_pose ||
                         kind == Kind::float_matrix || kind == Kind::double_matrix;
  if (is_nested && !is_old) put(Field::skipped, 1);  // its end flag
  constexpr unsigned kFirstWithoutCovariance = 6;
  switch (kind) {  // the last first
    case Kind::scan:
      put(Field::beam_count);
      if (version < kFirstWithoutCovariance) put(Field::length, 0, Kind::float_matrix);
      put(Field::length, 0, Kind::pose);
      put(Field::skipped, 4 + 1 + 4);  // aperture, direction, maximum range
      break;
    case Kind::grid:
      numbers_.clear();
      put(Field::grid_limits);
      if (version >= 2) put(Field::skipped, 1);  // bits of a cell
      break;
    case Kind::simplemap:
      put(Field::pose_count);
      break;
    case Kind::pose:
      if (version == 0) put(Field::length, 0, Kind::float_matrix);
      if (version == 1) put(Field::length, 0, Kind::double_matrix);
      if (version == 2) put(Field::skipped, 7 * sizeof(double));
      if (version == 3) put(Field::skipped, 12 * sizeof(double));
      if (version > 3) steps_.clear();
      break;
    case Kind::movement:
      if (version < kFirstWithMethod) {
        put(Field::pdf_length);
      } else {
        put(Field::method, version);
      }
      break;
    case Kind::plane_pose:
      put(Field::skipped, 3 * (version == 0 ? sizeof(float) : sizeof(double)));
      if (version > 1) steps_.clear();
      break;
    case Kind::float_matrix:
    case Kind::double_matrix:
      put(Field::columns, 0, kind);
      put(Field::rows);
      break;
  }
}

void GuardedStream::look(const unsigned char* bytes, std::size_t count) {
  if (steps_.empty()) return lookForObject(bytes, count);
  Step& step = steps_.back();
  if (step.field == Field::skipped) {
    if (count > step.bytes) return steps_.clear();  // laid out otherwise
    step.bytes -= count;
    if (step.bytes == 0) steps_.pop_back();
    return;
  }
  const Step now = step;
  switch (now.field) {
    case Field::length:
    case Field::name:
    case Field::version:
    case Field::pdf_length:
    case Field::pdf_name:
      break;
    default:
      if (count != 4) return steps_.clear();
  }
  if (now.field == Field::grid_limits) return lookAtLimits(bytes);
  steps_.pop_back();
  constexpr std::size_t kMostNumbers = 10'000;  // of a matrix: a pose's has 16, a covariance's 36
  switch (now.field) {
    case Field::length: {
      const bool is_old = bytes[0] < kNew;
      steps_.push_back({Field::version, 0, now.kind, is_old});
      steps_.push_back({Field::name});
      if (is_old) steps_.push_back({Field::skipped, 3});
      break;
    }
    case Field::pdf_length:
      steps_.push_back({Field::pdf_name});
      if (bytes[0] < kNew) steps_.push_back({Field::skipped, 3});
      break;
    case Field::pdf_name: {
      const auto* const found = classOf(nameOf(bytes, count));
      // MRPT itself refuses classes that it does not know.
      if (found != nullptr && !found->derivedFrom(CLASS_ID(mrpt::poses::CPosePDF))) {
        refuse("a movement that is no distribution of poses");
      }
      break;
    }
    case Field::method:
      lookAtMethod(now, number(bytes));
      break;
    case Field::drawn_count:
      if (number(bytes) > kMaxDrawnPoses) {
        refuse("a movement of more than " + std::to_string(kMaxDrawnPoses) + " poses");
      }
      break;
    case Field::version:
      begin(now.kind, bytes[0], now.is_old);
      break;
    case Field::rows:
      rows_ = number(bytes);
      break;
    case Field::columns: {
      const std::size_t size = rows_ * std::size_t{number(bytes)};
      if (rows_ > kMostNumbers || size > kMostNumbers) {
        refuse("a matrix of more than " + std::to_string(kMostNumbers) + " numbers");
      }
      const std::size_t width = now.kind == Kind::float_matrix ? sizeof(float) : sizeof(double);
      if (size > 0) steps_.push_back({Field::skipped, size * width});
      break;
    }
    case Field::beam_count:
      if (number(bytes) > kMaxBeams) {
        refuse("a scan of more than " + std::to_string(kMaxBeams) + " beams");
      }
      break;
    case Field::pose_count:
      if (number(bytes) > kMaxMapPoses) {
        refuse("a simplemap of more than " + std::to_string(kMaxMapPoses) + " poses");
      }
      break;
    default:
      break;
  }
}

/// A movement by odometry holds numbers of which MRPT draws poses, one by another method these.
void GuardedStream::lookAtMethod(const Step& step, std::uint32_t method) {
  if (method != mrpt::obs::CActionRobotMovement2D::emOdometry) {
    steps_.push_back({Field::pdf_length});
    return;
  }
  if (step.bytes > kFirstWithMethod) {
    const std::size_t of_gauss = step.bytes == 3 ? 5 * sizeof(double) : 6 * sizeof(float);
    steps_.push_back({Field::drawn_count});
    steps_.push_back({Field::skipped, 4 + of_gauss});  // which model
    steps_.push_back({Field::length, 0, Kind::plane_pose});
  }
}

void GuardedStream::lookAtLimits(const unsigned char* bytes) {
  constexpr std::size_t kSizes = 2;  // in cells, which MRPT makes anew of the limits
  const std::uint32_t bits = number(bytes);
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof value);
  numbers_.push_back(value);
  if (numbers_.size() < kSizes + 5) return;
  steps_.pop_back();
  const auto limit = [&](std::size_t i) { return static_cast<double>(numbers_[kSizes + i]); };
  const double side = limit(4);
  const double width = (limit(1) - limit(0)) / side, height = (limit(3) - limit(2)) / side;
  constexpr auto kMost = static_cast<double>(kMaxBitmapCells);
  // Written so that numbers that are none are refused.
  const bool in_range =
      side > 0.0 && width >= 0.0 && height >= 0.0 && width <= kMost && height <= kMost;
  if (!in_range) refuse("the grid's resolution or limits are out of range");
  if (width * height > kMost) {
    refuse("a grid of more than " + std::to_string(kMaxBitmapCells) + " cells");
  }
}

}  // namespace mrpt_polyloc
