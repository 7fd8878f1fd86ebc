#pragma once

// What differs between the versions of MRPT that this is built and tested with, 2.5.8, 2.14.7 and
// 2.15.14 (Debian 12, 13 and testing), and 3.1.2, against whose headers alone it was checked. No
// other file asks for MRPT's version.
// MRPT_VERSION is 0xMmp up to 2.10.1 (0x258 is 2.5.8) and 0xMMmmpp from 2.10.2 on; a test with >=
// is right for both.

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/version.h>

#if MRPT_VERSION >= 0x030000
#include <mrpt/viz/CPointCloud.h>
#include <mrpt/viz/CSetOfLines.h>
#include <mrpt/viz/CSetOfObjects.h>
#include <mrpt/viz/Scene.h>
#include <mrpt/viz/stock_objects.h>
#else
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/stock_objects.h>
#if MRPT_VERSION >= 0x270
#include <mrpt/opengl/Scene.h>
#else
#include <mrpt/opengl/COpenGLScene.h>
#endif
#endif

#include <memory>

namespace mrpt_polyloc {

/// Where the objects that are drawn live: MRPT 3 has moved them.
#if MRPT_VERSION >= 0x030000
namespace drawn = mrpt::viz;
#else
namespace drawn = mrpt::opengl;
#endif

/// A scene of objects to be drawn: renamed in 2.7.0.
#if MRPT_VERSION >= 0x270
using Scene = drawn::Scene;
#else
using Scene = drawn::COpenGLScene;
#endif

/// What MRPT wants back from internal_CreateFromMapDefinition(): a raw pointer that it takes over,
/// from 2.11.3 on a shared one.
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

/// The width of the cone of a CObservationRange [rad]: its name was misspelt once.
template <class Ranges>
auto coneAperture(const Ranges& ranges, int /*preferred*/) -> decltype(ranges.sensorConeAperture) {
  return ranges.sensorConeAperture;
}
template <class Ranges>
auto coneAperture(const Ranges& ranges, long /*otherwise*/)
    -> decltype(ranges.sensorConeApperture) {
  return ranges.sensorConeApperture;
}

/// For the methods of CMetricMap that are virtual from 2.11.3 on: boundingBox().
#if MRPT_VERSION >= 0x020b03
#define POLYLOC_OVERRIDE_FROM_2_11_3 override
#else
#define POLYLOC_OVERRIDE_FROM_2_11_3
#endif

}  // namespace mrpt_polyloc
