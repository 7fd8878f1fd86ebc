#pragma once

#include "replay_statistics.h"
#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>

#include <string>

namespace mrpt_polyloc::replay {

/// Writes a `.3Dscene` that MRPT's SceneViewer3D opens: the map, the way of the run up to and with
/// step k (counted among its records) beside the truth, and the particles there if they were kept.
/// \param path ends in .3Dscene
/// \throws std::runtime_error naming the file if it cannot be written
void writeScene(const std::string& path, const CPolygonMap2D& map, const RunRecord& run,
                std::size_t k, const Truth& truth);

}  // namespace mrpt_polyloc::replay
