// write_map_log MAP OUT.rawlog: a rawlog that holds a CPolygonMap2D as an object, and after it two
// scans from the map's origin. What MRPT's own programs are tried on.
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/serialization/CArchive.h>

#include <iostream>

namespace {

mrpt::obs::CObservation2DRangeScan scanOf(const mrpt_polyloc::PolygonMap& map, double seconds) {
  const mrpt_polyloc::WallSegments walls(map);
  mrpt::obs::CObservation2DRangeScan scan;
  scan.sensorLabel = "laser";
  scan.timestamp = mrpt::Clock::fromDouble(1e9 + seconds);
  scan.aperture = 3.0F;
  scan.maxRange = 30.0F;
  scan.resizeScanAndAssign(61, 1.0F, true);
  for (std::size_t i = 0; i < 61; ++i) {
    const double range = walls.range({0, 0}, -1.5 + 0.05 * static_cast<double>(i));
    scan.setScanRange(i, static_cast<float>(range));
    scan.setScanRangeValidity(i, range < 30.0);
  }
  return scan;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "usage: write_map_log MAP OUT.rawlog\n";
    return 2;
  }
  const mrpt_polyloc::PolygonMap polygons = mrpt_polyloc::loadMap(argv[1]).map;
  mrpt::io::CFileGZOutputStream file(argv[2]);
  auto archive = mrpt::serialization::archiveFrom(file);
  archive << mrpt_polyloc::CPolygonMap2D(polygons);
  for (const double seconds : {0.0, 0.1}) archive << scanOf(polygons, seconds);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
