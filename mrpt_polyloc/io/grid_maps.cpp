#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/bitmap_files.h>
#include <mrpt_polyloc/io/grid_maps.h>
#include <mrpt_polyloc/io/mrpt_archive.h>
#include <mrpt_polyloc/io/mrpt_compat.h>

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace mrpt_polyloc {

namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::maps::CSimpleMap;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationRange;

constexpr double kOccupiedAbove = 0.65;
constexpr double kFreeBelow = 0.196;
constexpr float kMaxInsertionDistance = 15.0F;  // [m], localization_demo.ini
constexpr double kFirstExtent = 10.0;           // [m] of the grid around the origin, as MRPT's own

/// The only object of a file, of the class that is expected there.
template <typename T>
typename T::Ptr readOnlyObject(const std::string& path) {
  GzInputStream stream(path);
  const auto object = readObject(stream, 0);
  auto map = std::dynamic_pointer_cast<T>(object);
  if (!map) {
    const std::string found = object ? object->GetRuntimeClass()->className : "nothing";
    throw FormatError(
        path, "object 0",
        "holds " + found + " where " + T::GetRuntimeClassIdStatic().className + " is expected");
  }
  if (!stream.atEnd()) throw FormatError(path, "object 1", "something follows the map");
  return map;
}

OccupancyBitmap toBitmap(const std::string& path, const COccupancyGridMap2D& grid) {
  const auto width = static_cast<std::int64_t>(grid.getSizeX());
  const auto height = static_cast<std::int64_t>(grid.getSizeY());
  if (width == 0 || height == 0) throw FormatError(path, "object 0", "a grid without cells");
  if (width > kMaxBitmapCells / height) {
    throw FormatError(path, "object 0",
                      "a grid of more than " + std::to_string(kMaxBitmapCells) + " cells");
  }
  OccupancyBitmap bitmap;
  bitmap.width = static_cast<int>(width);
  bitmap.height = static_cast<int>(height);
  bitmap.resolution = static_cast<double>(grid.getResolution());
  bitmap.pose_map_bitmap = {static_cast<double>(grid.getXMin()),
                            static_cast<double>(grid.getYMin()), 0};
  if (!(bitmap.resolution > 0.0) || !std::isfinite(bitmap.resolution) ||
      !std::isfinite(bitmap.pose_map_bitmap.x) || !std::isfinite(bitmap.pose_map_bitmap.y)) {
    throw FormatError(path, "object 0", "the grid's resolution or limits are out of range");
  }
  bitmap.cells.reserve(static_cast<std::size_t>(width * height));
  for (int row = 0; row < bitmap.height; ++row) {
    for (int column = 0; column < bitmap.width; ++column) {
      const double occupied = 1.0 - static_cast<double>(grid.getCell(column, row));
      bitmap.cells.push_back(occupied > kOccupiedAbove ? CellState::occupied
                             : occupied < kFreeBelow   ? CellState::free
                                                       : CellState::unknown);
    }
  }
  return bitmap;
}

/// Whether a grid may take an observation: MRPT would draw beams of any length, and ends the
/// program where the grid cannot grow so far.
bool areModest(const CObservation& observation) {
  const auto is_modest = [](float range) { return range >= 0.0F; };  // and a number
  if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) {
    for (std::size_t i = 0; i < scan->getScanSize(); ++i) {
      if (scan->getScanRangeValidity(i) && !is_modest(scan->getScanRange(i))) return false;
    }
    return is_modest(scan->maxRange) && std::isfinite(scan->aperture);
  }
  if (const auto* ranges = dynamic_cast<const CObservationRange*>(&observation)) {
    return std::isfinite(coneAperture(*ranges, 0)) &&
           std::all_of(ranges->begin(), ranges->end(),
                       [&](const auto& one) { return is_modest(one.sensedDistance); });
  }
  return true;
}

/// Refuses poses that would make the grid grow beyond all measure, and readings of no length.
void requireModestExtent(const std::string& path, const CSimpleMap& map) {
  std::array<double, 2> low{-kFirstExtent, -kFirstExtent}, high{kFirstExtent, kFirstExtent};
  std::size_t number = 0;
  // By iterators: get() hands out another type from MRPT 2.11.5 on.
  for (const auto& keyframe : map) {
    const std::string place = "pose " + std::to_string(number++);
    if (!keyframe.pose || !keyframe.sf) throw FormatError(path, place, "is empty");
    const mrpt::poses::CPose3D mean = keyframe.pose->getMeanVal();
    const auto include = [&](const mrpt::poses::CPose3D& pose_map_sensor) {
      const auto pose = pose_map_sensor.asTPose();
      const std::array<double, 2> position{pose.x, pose.y};
      for (std::size_t k = 0; k < 2; ++k) {
        if (!std::isfinite(position[k]) || !std::isfinite(pose.yaw)) {
          throw FormatError(path, place, "is not finite");
        }
        low[k] = std::min(low[k], position[k]);
        high[k] = std::max(high[k], position[k]);
      }
    };
    include(mean);
    for (const auto& observation : *keyframe.sf) {
      if (!observation) throw FormatError(path, place, "holds an empty observation");
      if (!areModest(*observation)) {
        throw FormatError(path, place, "holds readings that are no ranges");
      }
      mrpt::poses::CPose3D pose_robot_sensor;
      observation->getSensorPose(pose_robot_sensor);
      include(mean + pose_robot_sensor);
    }
  }
  const double margin = 2.0 * static_cast<double>(kMaxInsertionDistance);
  const double cells = (high[0] - low[0] + margin) / kSimpleMapResolution *
                       ((high[1] - low[1] + margin) / kSimpleMapResolution);
  if (cells > static_cast<double>(kMaxBitmapCells)) {
    throw FormatError(path, "object 0", "its poses are too far apart for an occupancy grid");
  }
}

}  // namespace

OccupancyBitmap loadGridMap(const std::string& path) {
  return toBitmap(path, *readOnlyObject<COccupancyGridMap2D>(path));
}

OccupancyBitmap loadSimpleMap(const std::string& path) {
  const auto map = readOnlyObject<CSimpleMap>(path);
  if (map->empty()) throw FormatError(path, "object 0", "a simplemap without observations");
  requireModestExtent(path, *map);

  constexpr auto kFirst = static_cast<float>(kFirstExtent);
  COccupancyGridMap2D grid(-kFirst, kFirst, -kFirst, kFirst,
                           static_cast<float>(kSimpleMapResolution));
  auto& options = grid.insertionOptions;  // as in localization_demo.ini
  options.mapAltitude = 0.0F;
  options.useMapAltitude = false;
  options.maxDistanceInsertion = kMaxInsertionDistance;
  options.maxOccupancyUpdateCertainty = 0.55F;
  options.considerInvalidRangesAsFreeSpace = true;

  bool inserted = false;
  for (const auto& keyframe : *map) {
    const mrpt::poses::CPose3D mean = keyframe.pose->getMeanVal();
    for (const auto& observation : *keyframe.sf) {
      inserted |= grid.insertObservation(*observation, mean);
    }
  }
  if (!inserted) throw FormatError(path, "object 0", "no laser scan that a grid can take");
  return toBitmap(path, grid);
}

}  // namespace mrpt_polyloc
