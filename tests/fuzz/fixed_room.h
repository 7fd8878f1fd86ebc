#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>

#include <string>

namespace mrpt_polyloc::fuzz {

/// An L of 4 m x 4 m with arms 2 m wide.
PolygonMap fixedRoom();

/// What is seen in it from (1, 1), ahead of 1 rad, by 36 beams all around.
const RangeScan& fixedScan();

/// What MapIndex::save() writes of the room.
std::string fixedIndex();

/// Asks where a scan was taken and checks what any answer has to be: finite poses within the map's
/// box, weights of a posterior. Nothing is taken for granted of a status.
void askOnce(const GlobalLocalizer& localizer, const RangeScan& scan);

}  // namespace mrpt_polyloc::fuzz
