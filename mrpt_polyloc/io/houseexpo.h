#pragma once

#include <mrpt_polyloc/geometry/validation.h>

#include <string>

namespace mrpt_polyloc {

/// Reads a HouseExpo floor plan: a JSON object whose `verts` is one ring [[x, y], ...] in metres,
/// all of its edges walls. Other members (id, bbox, room_num, ...) are ignored.
/// \param text what the file holds
/// \param file its name, for messages
/// \throws FormatError naming the file and the line or path.
RawMap parseHouseExpo(const std::string& text, const std::string& file);

}  // namespace mrpt_polyloc
