#include "fuzz_target.h"
#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>

#include <mrpt/config/CConfigFileMemory.h>

// A map's sections in an ini of MRPT's programs. The map that it may name is not loaded.
POLYLOC_FUZZ_TARGET(ini, bytes) {
  const mrpt::config::CConfigFileMemory ini(bytes);
  CPolygonMap2D::TMapDefinition definition;
  definition.loadFromConfigFile(ini, "M");
  definition.likelihood.check();
}
