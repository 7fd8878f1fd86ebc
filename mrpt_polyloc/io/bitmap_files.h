#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/base/notes.h>
#include <mrpt_polyloc/geometry/OccupancyBitmap.h>

#include <cstdint>
#include <optional>
#include <string>

namespace mrpt_polyloc {

/// Largest occupancy grid that is read [cells]: 1 km2 at 0.05 m. A larger one is taken for a
/// damaged file.
constexpr std::int64_t kMaxBitmapCells = 400'000'000;

/// The occupancy grid in a ROS map (.yaml, .yml) or an MRPT .gridmap or .simplemap, the latter two
/// also with .gz or .zst behind; extensions in any case. None for any other extension.
/// \param notes as in loadRosMap()
/// \throws FormatError as loadRosMap(), loadGridMap() and loadSimpleMap().
POLYLOC_EXPORT std::optional<OccupancyBitmap> loadBitmap(const std::string& path,
                                                         Notes* notes = nullptr);

}  // namespace mrpt_polyloc
