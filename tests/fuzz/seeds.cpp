#include "seeds.h"

#include "fixed_room.h"
#include "tests/support/bridge_files.h"
#include <mrpt_polyloc/evaluation/calibration_files.h>
#include <mrpt_polyloc/io/geojson.h>

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <memory>

namespace mrpt_polyloc::fuzz {

namespace {

using mrpt::obs::CObservation2DRangeScan;
using test::gzipped;
using test::serialised;

CObservation2DRangeScan smallScan() {
  std::mt19937 random(1);
  return test::randomObservation(random, 20);
}

/// A frame with a scan and odometry.
mrpt::obs::CSensoryFrame frame() {
  mrpt::obs::CSensoryFrame frame;
  frame.insert(std::make_shared<CObservation2DRangeScan>(smallScan()));
  frame.insert(mrpt::obs::CObservationOdometry::Create());
  return frame;
}

mrpt::obs::CActionCollection action() {
  mrpt::obs::CActionRobotMovement2D movement;
  movement.computeFromOdometry({0.1, 0, 0.01}, {});
  mrpt::obs::CActionCollection actions;
  actions.insert(movement);
  return actions;
}

std::string simpleMap() {
  mrpt::maps::CSimpleMap map;
  map.insert(mrpt::poses::CPose3DPDFGaussian::Create(),
             std::make_shared<mrpt::obs::CSensoryFrame>(frame()));
  return serialised(map);
}

std::string gridMap() {
  mrpt::maps::COccupancyGridMap2D grid(-1, 1, -1, 1, 0.5F);
  grid.fill(0.9F);
  grid.setCell(1, 1, 0.1F);
  return serialised(grid);
}

/// A zstd frame that stores a content as it is (RFC 8878): a header with the size in four bytes,
/// and one raw block, of up to 128 KiB.
std::string zstdStored(const std::string& content) {
  const auto size = static_cast<std::uint32_t>(content.size());
  std::string bytes = "\x28\xb5\x2f\xfd\xa0";
  const auto append = [&](std::uint32_t number, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xffU);
  };
  append(size, 4);
  append(size << 3U | 1U, 3);  // the last block, raw
  return bytes + content;
}

/// The room's beams as the target scan_way reads them.
std::string beamBytes() {
  std::string bytes;
  for (const Beam& beam : fixedScan().beams()) {
    const auto range = static_cast<float>(beam.range);
    char text[6] = {0, 0, 0, 0, 0, '\x7f'};
    std::memcpy(text, &range, sizeof range);
    bytes.append(text, sizeof text);
  }
  return bytes;
}

/// An image of a room: 254 free, 0 wall, 205 unknown.
const char* const kRoomImage =
    "P2\n8 6\n255\n"
    "205 0 0 0 0 0 0 205\n0 254 254 254 254 254 254 0\n0 254 254 254 0 254 254 0\n"
    "0 254 254 254 254 254 254 0\n0 254 254 254 254 254 254 0\n205 0 0 0 0 0 0 205\n";

const char* const kCarmenLog =
    "# CARMEN Logfile\nPARAM laser_front_laser_resolution 0.5\nPARAM robot_front_laser_max 30.0\n"
    "PARAM robot_frontlaser_offset 0.2\n"
    "FLASER 5 1.0 1.5 2.0 81.9 0.5 0.1 0.2 0.3 0.1 0.2 0.3 12.5 host 12.6\n"
    "RLASER 3 1.0 1.5 2.0 0.1 0.2 0.3 0.1 0.2 0.3 12.5 host 12.6\n"
    "ROBOTLASER1 0 -1.57 3.14 1.57 30.0 0.01 0 3 1.0 2.0 3.0 0 0.1 0.2 0.3 0.1 0.2 0.3 0 0 0 0 0 "
    "13.5 host 13.6\n"
    "RAWLASER1 0 -1.57 3.14 1.57 30.0 0.01 0 3 1.0 2.0 3.0 0 14.5 host 14.6\nODOM 0 0 0 0 0 0 1 h "
    "1\n";

const char* const kIni =
    "[M]\nfile = map.wkt // where\nscale = 0.5\nmin_island_area = 0.1\n[M_likelihoodOpts]\n"
    "sigma = 0.1\ndecimation = 10\n";

const char* const kReplayIni =
    "[LocalizationExperiment]\nmap_file = map.simplemap.gz\nrawlog_file = log.rawlog\n"
    "particles_count = 1000\nrawlog_offset = 0\nexperimentRepetitions = 2\n[PF_options]\n"
    "PF_algorithm = 0\nadaptiveSampleSize = true\n[KLD_options]\nKLD_binSize_XY = 0.2\n"
    "[polyloc]\nmap = map.wkt\nscale = 1\ninit = polyloc\nmax_range = 30\n"
    "carried = 3-5, 8-9\nreport_steps = 0, 5\n";

const char* const kSetList =
    "datasets:\n  - name: a\n    map: map.wkt\n    scans: scans.rawlog\n    truth: truth.tum\n"
    "  - name: b\n    map: map.wkt\n    simulate: {n: 3, seed: 1, beams: 90, sigma: 0.01}\n"
    "methods: [certified, {name: c, method: cells, range: 10}, {name: l, method: "
    "likelihood_lattice}]"
    "\n";

}  // namespace

std::map<std::string, std::vector<std::string>> seeds() {
  const std::string log = serialised(smallScan()) + serialised(smallScan());
  const std::string pairs = serialised(action()) + serialised(frame());
  const std::string image = kRoomImage;
  const std::string rooms =
      R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"kind":"free"},"geometry":{"type":"Polygon","coordinates":
[[[0,0],[6,0],[6,4],[0,4],[0,0]],[[2,1],[2,2],[3,2],[3,1],[2,1]]]}},
{"type":"Feature","properties":{"kind":"open"},"geometry":{"type":"LineString","coordinates":
[[6,0],[6,4]]}},
{"type":"Feature","properties":{"kind":"wall"},"geometry":{"type":"LineString","coordinates":
[[8,0],[8,4]]}}]})";
  return {
      {"wkt",
       {"POLYGON ((0 0, 4 0, 4 2, 2 2, 2 4, 0 4, 0 0), (0.5 0.5, 0.5 1, 1 1))\n",
        "SRID=32630;MULTIPOLYGON Z (((0 0 1, 4 0 1, 4 4 1)), EMPTY, ((5 5 1, 9 5 1, 9 9 1)));\n",
        "GEOMETRYCOLLECTION (POLYGON EMPTY, POLYGON ((0 0, 1e1 0, 10 1.5E1)))\n"}},
      {"geojson",
       {rooms, toGeoJson(fixedRoom()),
        R"({"type":"GeometryCollection","geometries":[{"type":"MultiPolygon","coordinates":
[[[[0,0],[4,0],[4,4]]],[[[4,0],[8,0],[8,4],[4,4]]]]}]})",
        R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"type":"door"},
"geometry":{"type":"LineString","coordinates":[[1,0],[2,0]]}},{"type":"Feature","properties":null,
"geometry":null}]})"}},
      {"houseexpo", {R"({"verts": [[0, 0], [4, 0], [4, 4], [2, 4], [2, 2], [0, 2]], "id": "x"})"}},
      {"yaml",
       {"image: map.pgm\nresolution: 0.05\norigin: [-1.5, 2, 0.1]\nnegate: 0\nmode: trinary\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
        "%YAML 1.1\n---\nimage: \"map.pgm\"\nresolution: 5e-2\norigin:\n  - 0\n  - 0\n  - .nan\n"
        "mode: raw\nnested: {a: [1, 2]}\n"}},
      {"pgm",
       {image, "P5\n# a comment\n3 2\n255\n123456", "P6 1 1 65535\n123456", "P3 1 1 7 1 2 3"}},
      {"png",
       {test::pngFile(3, 2, 8, 0, "abcdef"), test::pngFile(2, 1, 16, 4, "abcdefgh"),
        test::pngFile(1, 2, 8, 6, "abcdefgh")}},
      {"carmen", {kCarmenLog}},
      {"rawlog", {log, pairs + pairs, gzipped(log), zstdStored(log)}},
      {"simplemap", {simpleMap(), gzipped(simpleMap()), zstdStored(simpleMap())}},
      {"gridmap", {gridMap(), gzipped(gridMap()), zstdStored(gridMap())}},
      {"index", {fixedIndex()}},
      {"calibration", {calibrationJson(Calibration()).dump()}},
      {"tum",
       {"# stamp x y z qx qy qz qw\n1.5 1 2 0 0 0 0 1\n2.5 1 2 0 0 0 0.6 0.8\n",
        "# index x y phi\n0 1 2 0.5\n3 1 2 0.5\n"}},
      {"good_list", {"# good\n0\n5\n17 # late\n999\n"}},
      {"ini", {kIni}},
      {"replay_ini", {kReplayIni}},
      {"set_list", {kSetList}},
      {"map_way", {image}},
      {"scan_way", {beamBytes()}},
      {"compressed",
       {"plain", gzipped("some text, some text, some text"), gzipped("a") + gzipped("b"),
        zstdStored("some text"), zstdStored("a") + zstdStored("b")}},
  };
}

}  // namespace mrpt_polyloc::fuzz
