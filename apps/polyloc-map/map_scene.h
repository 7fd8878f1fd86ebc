#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <string>

namespace mrpt_polyloc::apps {

/// The map as a scene file of MRPT's (.3Dscene, not compressed), which SceneViewer3D opens.
std::string sceneText(const PolygonMap& map);

}  // namespace mrpt_polyloc::apps
