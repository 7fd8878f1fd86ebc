#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/version.h>

#include <memory>

namespace mrpt_polyloc {

/// What MRPT wants back from internal_CreateFromMapDefinition(): a raw pointer that it takes over,
/// from 2.11.3 on a shared one. (MRPT_VERSION of 2.5.8 is 0x258, that of 2.11.3 0x020b03.)
/// Built and tested with 2.5.8 alone.
#if MRPT_VERSION >= 0x020b03
using CreatedMap = std::shared_ptr<mrpt::maps::CMetricMap>;
#else
using CreatedMap = mrpt::maps::CMetricMap*;
#endif

template <class Map>
CreatedMap toCreatedMap(std::unique_ptr<Map> map) {
#if MRPT_VERSION >= 0x020b03
  return map;
#else
  return map.release();
#endif
}

}  // namespace mrpt_polyloc
