#pragma once

#include <mrpt_polyloc/geometry/OccupancyBitmap.h>
#include <mrpt_polyloc/geometry/validation.h>

#include <string>

namespace mrpt_polyloc {

/// Maps with more free space than this are refused [m2]: 2 km by 2 km without a wall, of which an
/// index takes gigabytes. The largest airport halls are a tenth of it, a room of 3 m by 3 m in
/// millimetres is twice as large.
constexpr double kGreatestFreeArea = 4e6;

/// All coordinates of a map times a factor, for maps that are not in metres.
/// \param scale metres per unit of the file, finite and above 0
/// \throws InvalidParamsError naming the scale
void scaleMap(double scale, RawMap& map);
void scaleMap(double scale, OccupancyBitmap& bitmap);

/// Refuses a map whose coordinates cannot be metres, before anything is built of it, with a guess
/// of what they are: free space beyond kGreatestFreeArea (millimetres?), or all within 180 and an
/// extent below 0.1 (degrees?).
/// \param path of the file, for messages
/// \throws FormatError
void requireMetres(const std::string& path, const RawMap& map);
void requireMetres(const std::string& path, const OccupancyBitmap& bitmap);

}  // namespace mrpt_polyloc
