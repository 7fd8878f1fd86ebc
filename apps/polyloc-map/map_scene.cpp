#include "map_scene.h"

#include <mrpt_polyloc/io/mrpt_compat.h>
#include <mrpt_polyloc/mrpt_bridge/map_lines.h>

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

namespace mrpt_polyloc::apps {

std::string sceneText(const PolygonMap& map) {
  const auto lines = drawn::CSetOfObjects::Create();
  lines->setName("map");
  addMapLines(map, *lines);
  Scene scene;
  scene.insert(lines);
  mrpt::io::CMemoryStream bytes;
  mrpt::serialization::archiveFrom(bytes) << scene;
  return {static_cast<const char*>(bytes.getRawBufferData()), bytes.getTotalBytesCount()};
}

}  // namespace mrpt_polyloc::apps
