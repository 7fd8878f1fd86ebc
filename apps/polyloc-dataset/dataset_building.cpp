#include "dataset_building.h"

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/ScanTraits.h>
#include <mrpt_polyloc/geometry/bitmap_cleaning.h>
#include <mrpt_polyloc/geometry/tracing.h>
#include <mrpt_polyloc/io/map_files.h>

#include <mrpt/core/Clock.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::obs::CObservation2DRangeScan;

// Probabilities of being occupied. A beam that passes makes odds of 2 : 3, three of them 0.23, two
// of them 0.31: ROS's own 0.196 would ask for four, and leave holes where drives see places rarely.
constexpr double kOccupiedAbove = 0.65, kFreeBelow = 0.25;
constexpr double kMostDisagreement = 0.2;  // of the hits of a scan that agrees with the map

}  // namespace

DriveParts partsOf(const PosedScans& drive, double block) {
  DriveParts parts;
  double way = 0.0;
  for (std::size_t i = 0; i < drive.poses.size(); ++i) {
    if (i > 0) {
      way += std::hypot(drive.poses[i].x - drive.poses[i - 1].x,
                        drive.poses[i].y - drive.poses[i - 1].y);
    }
    const bool maps = static_cast<std::size_t>(way / block) % 2 == 0;
    (maps ? parts.mapping : parts.scans).push_back(i);
  }
  return parts;
}

CObservation2DRangeScan observationOf(const RangeScan& scan, double stamp, const std::string& file,
                                      std::size_t row) {
  constexpr double kUneven = 0.1 * kDegree;
  const std::vector<Beam>& beams = scan.beams();
  const double last = static_cast<double>(beams.size() - 1);
  // Beams that say nothing have no bearing; the others tell where those are.
  std::optional<std::size_t> first, other;
  double max_range = 0.0;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (beams[i].kind == BeamKind::invalid) continue;
    if (!first) first = i;
    other = i;
    max_range = std::max(max_range, beams[i].range);
  }
  CObservation2DRangeScan observation;
  double step = 0.0, start = 0.0;
  if (first && *other > *first) {
    step = (beams[*other].bearing - beams[*first].bearing) / static_cast<double>(*other - *first);
    start = beams[*first].bearing - step * static_cast<double>(*first);
  }
  observation.aperture = static_cast<float>(std::abs(step) * last);
  observation.rightToLeft = step >= 0.0;
  observation.sensorPose =
      mrpt::poses::CPose3D(scan.sensor().x, scan.sensor().y, 0.0, start + 0.5 * step * last, 0, 0);
  observation.sensorLabel = scan.label();
  observation.timestamp = mrpt::Clock::fromDouble(stamp);
  observation.maxRange = static_cast<float>(1.05 * max_range);
  observation.resizeScan(beams.size());
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const Beam& beam = beams[i];
    if (beam.kind == BeamKind::no_return) observation.maxRange = static_cast<float>(beam.range);
    if (beam.kind != BeamKind::invalid &&
        angleBetween(beam.bearing, start + step * static_cast<double>(i)) > kUneven) {
      throw FormatError(file, "scan " + std::to_string(row), "beams that are not evenly spread");
    }
    observation.setScanRange(i,
                             static_cast<float>(beam.kind == BeamKind::invalid ? 0 : beam.range));
    observation.setScanRangeValidity(i, beam.kind == BeamKind::hit);
  }
  return observation;
}

OccupancyBitmap mapOf(const PosedScans& drive, const std::vector<std::size_t>& rows,
                      double resolution, const std::string& file) {
  COccupancyGridMap2D grid(-1.0F, 1.0F, -1.0F, 1.0F, static_cast<float>(resolution));
  // Free after three beams that pass a cell and none that ends there: drives see most places a few
  // times only. Far walls count: searches look at them, too.
  grid.insertionOptions.maxDistanceInsertion = 80.0F;
  grid.insertionOptions.maxOccupancyUpdateCertainty = 0.6F;
  grid.insertionOptions.considerInvalidRangesAsFreeSpace = false;
  for (const std::size_t row : rows) {
    const CObservation2DRangeScan observation = observationOf(drive.scans[row], 0.0, file, row);
    const mrpt::poses::CPose3D pose(drive.poses[row]);
    grid.insertObservation(observation, pose);
  }
  OccupancyBitmap bitmap;
  bitmap.width = static_cast<int>(grid.getSizeX());
  bitmap.height = static_cast<int>(grid.getSizeY());
  bitmap.resolution = resolution;
  bitmap.pose_map_bitmap = {static_cast<double>(grid.getXMin()),
                            static_cast<double>(grid.getYMin()), 0};
  bool any_free = false;
  for (int row = 0; row < bitmap.height; ++row) {
    for (int column = 0; column < bitmap.width; ++column) {
      const double occupied = 1.0 - static_cast<double>(grid.getCell(column, row));
      bitmap.cells.push_back(occupied > kOccupiedAbove ? CellState::occupied
                             : occupied < kFreeBelow   ? CellState::free
                                                       : CellState::unknown);
      any_free = any_free || bitmap.cells.back() == CellState::free;
    }
  }
  if (!any_free) {
    throw FormatError(file, "",
                      "no cell of the map comes out free: is --resolution too coarse, or --block "
                      "longer than the drive?");
  }
  return bitmap;
}

std::string toPgm(const OccupancyBitmap& bitmap) {
  constexpr char kFree = static_cast<char>(254), kUnknown = static_cast<char>(205);
  std::string text =
      "P5\n" + std::to_string(bitmap.width) + " " + std::to_string(bitmap.height) + "\n255\n";
  for (int row = bitmap.height - 1; row >= 0; --row) {
    for (int column = 0; column < bitmap.width; ++column) {
      const CellState state = bitmap.at(column, row);
      text += state == CellState::free ? kFree : state == CellState::unknown ? kUnknown : '\0';
    }
  }
  return text;
}

std::string toRosYaml(const OccupancyBitmap& bitmap, const std::string& image) {
  std::string text = "image: " + image + "\nresolution: ";
  appendNumber(text, bitmap.resolution);
  text += "\norigin: [";
  appendNumber(text, bitmap.pose_map_bitmap.x);
  text += ", ";
  appendNumber(text, bitmap.pose_map_bitmap.y);
  return text + ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

std::vector<std::size_t> goodRows(const PosedScans& drive, const std::vector<std::size_t>& rows,
                                  const OccupancyBitmap& bitmap) {
  const GridMapParams params;
  const PolygonMap map = traceBitmap(cleanBitmap(bitmap, params.cleaning), params.tracing);
  const ScanJudge judge(map);
  std::vector<std::size_t> good;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ScanTraits traits = judge.traits(drive.scans[rows[i]], drive.poses[rows[i]]);
    if (traits.outside == 0.0 && traits.clutter + traits.passed <= kMostDisagreement) {
      good.push_back(i);
    }
  }
  return good;
}

}  // namespace mrpt_polyloc::apps
