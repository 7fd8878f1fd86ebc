#include "requests.h"

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/io/readings.h>

#include <limits>
#include <optional>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kMostRange = 1e6;  // [m]
constexpr double kMostAngle = 1e3;  // [rad]
constexpr std::size_t kMostChanges = 1000;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

PosePrior readPrior(const RequestField& field) {
  field.allowOnly({"compass", "near"});
  PosePrior prior;
  if (const auto compass = field.find("compass")) {
    compass->allowOnly({"heading", "tolerance"});
    prior.compass = PosePrior::Compass{compass->member("heading").number({-kMostAngle, kMostAngle}),
                                       compass->member("tolerance").number({0.0, kPi})};
  }
  if (const auto near = field.find("near")) {
    near->allowOnly({"x", "y", "radius"});
    const TPoint2D center = readPoint(*near);
    prior.near =
        PosePrior::Disk{center.x, center.y, near->member("radius").number({1e-6, kMostRange})};
  }
  return prior;
}

Method readMethod(const RequestField& field) {
  const std::string name = field.text(20);
  if (name == "certified") return Method::certified;
  if (name == "cells") return Method::cells;
  if (name == "exact") return Method::exact;
  field.fail("unknown method; there is: certified, cells, exact");
}

SearchMetric readMetric(const RequestField& field) {
  const std::string name = field.text(20);
  if (name == "robust") return SearchMetric::robust;
  if (name == "polar") return SearchMetric::polar;
  field.fail("unknown metric; there is: robust, polar");
}

BeamKind readKind(const RequestField& kinds, char letter) {
  switch (letter) {
    case 'h':
      return BeamKind::hit;
    case 'n':
      return BeamKind::no_return;
    case 'i':
      return BeamKind::invalid;
    default:
      kinds.fail("a letter that is not one of h, n, i");
  }
}

/// The form that toJson(RangeScan) writes.
RangeScan readBeams(const RequestField& request) {
  const std::vector<double> bearings =
      request.member("bearings").numbers(kMostBeams, {-kMostAngle, kMostAngle}, 0.0);
  const std::vector<double> ranges =
      request.member("ranges").numbers(kMostBeams, {-1.0, kMostRange}, kNothing);
  const RequestField kinds = request.member("kinds");
  const std::string letters = kinds.text(kMostBeams);
  if (bearings.size() != ranges.size() || letters.size() != ranges.size()) {
    request.fail("bearings, ranges and kinds are not of one size");
  }
  std::vector<Beam> beams;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    beams.push_back({bearings[i], ranges[i], readKind(kinds, letters[i])});
  }
  TPoint2D sensor(0, 0);
  if (const auto field = request.find("sensor")) sensor = readPoint(*field);
  return RangeScan(std::move(beams), sensor);
}

/// The form of a driver: evenly spread readings.
RangeScan readReadings(const RequestField& request) {
  LoggedScan scan;
  scan.ranges = request.member("ranges").numbers(kMostBeams, {-1.0, kMostRange}, kNothing);
  scan.first = request.member("start_angle").number({-kMostAngle, kMostAngle});
  scan.step = request.member("angle_step").number({-kTwoPi, kTwoPi});
  ReadingLimits limits;
  if (const auto field = request.find("max_range")) limits.max_range = field->number({1e-3, 1e6});
  if (const auto field = request.find("min_range")) limits.min_range = field->number({0.0, 1e6});
  if (const auto sensor = request.find("sensor")) {
    sensor->allowOnly({"x", "y", "phi"});
    const TPose2D pose = readPose(*sensor);
    scan.sensor = {pose.x, pose.y};
    scan.yaw = pose.phi;
  }
  return toRangeScan(scan, limits);
}

RoomChanges readChanges(const RequestField& field) {
  field.allowOnly({"discs", "moved"});
  RoomChanges changes;
  if (const auto discs = field.find("discs")) {
    const std::size_t count = discs->arraySize(kMostChanges);
    for (std::size_t i = 0; i < count; ++i) {
      const RequestField disc = discs->element(i);
      disc.allowOnly({"x", "y", "radius"});
      changes.discs.push_back({readPoint(disc), disc.member("radius").number({1e-3, 1e3})});
    }
  }
  if (const auto moved = field.find("moved")) {
    const std::size_t count = moved->arraySize(kMostChanges);
    for (std::size_t i = 0; i < count; ++i) {
      const RequestField wall = moved->element(i);
      wall.allowOnly({"x", "y", "dx", "dy"});
      changes.moved.push_back({readPoint(wall), TPoint2D(wall.member("dx").number({-1e3, 1e3}),
                                                         wall.member("dy").number({-1e3, 1e3}))});
    }
  }
  return changes;
}

void readSimulator(const RequestField& field, LaserRequest& request) {
  field.allowOnly({"beams", "fov", "sigma", "max_range", "dropout", "short_beams", "seed"});
  SimulatorParams& laser = request.laser;
  if (const auto beams = field.find("beams")) laser.beams = beams->count(1, 10'000);
  if (const auto fov = field.find("fov")) laser.fov = fov->number({1e-3, kTwoPi});
  if (const auto sigma = field.find("sigma")) laser.sigma = sigma->number({0.0, 10.0});
  if (const auto range = field.find("max_range")) laser.max_range = range->number({0.01, 1e4});
  if (const auto share = field.find("dropout")) laser.dropout = share->number({0.0, 1.0});
  if (const auto share = field.find("short_beams")) laser.short_beams = share->number({0.0, 1.0});
  if (const auto seed = field.find("seed")) request.seed = seed->count(0, 1ULL << 53U);
}

MotionNoise readOdometry(const RequestField& field) {
  field.allowOnly({"position_per_metre", "heading_per_metre", "heading_per_radian"});
  MotionNoise noise;
  const auto read = [&](const char* name, double& value) {
    if (const auto share = field.find(name)) value = share->number({0.0, 1.0});
  };
  read("position_per_metre", noise.position_per_metre);
  read("heading_per_metre", noise.heading_per_metre);
  read("heading_per_radian", noise.heading_per_radian);
  return noise;
}

}  // namespace

TPoint2D readPoint(const RequestField& point) {
  return {point.member("x").number(), point.member("y").number()};
}

TPose2D readPose(const RequestField& pose) {
  const TPoint2D place = readPoint(pose);
  const auto phi = pose.find("phi");
  return {place.x, place.y, phi ? phi->number({-kMostAngle, kMostAngle}) : 0.0};
}

std::vector<TPoint2D> readPoints(const RequestField& points, std::size_t most) {
  std::vector<TPoint2D> result;
  const std::size_t count = points.arraySize(most);
  for (std::size_t i = 0; i < count; ++i) {
    const RequestField point = points.element(i);
    if (point.arraySize(2) != 2) point.fail("not a pair of numbers");
    result.emplace_back(point.element(0).number(), point.element(1).number());
  }
  return result;
}

SearchRequest readSearch(const RequestField& request) {
  SearchRequest search;
  if (const auto prior = request.find("prior")) search.prior = readPrior(*prior);
  const auto options = request.find("options");
  if (!options) return search;
  options->allowOnly({"method", "max_hypotheses", "time_budget_ms", "regions", "metric"});
  if (const auto method = options->find("method")) search.method = readMethod(*method);
  if (const auto most = options->find("max_hypotheses")) {
    search.max_hypotheses = most->count(1, 1000);
  }
  if (const auto budget = options->find("time_budget_ms")) {
    search.time_budget_ms = budget->number({1.0, 60'000.0});
  }
  if (const auto regions = options->find("regions")) search.keep_regions = regions->boolean();
  if (const auto metric = options->find("metric")) search.metric = readMetric(*metric);
  return search;
}

RangeScan readScan(const RequestField& request) {
  return request.has("bearings") ? readBeams(request) : readReadings(request);
}

std::vector<MovedScan> readMovedScans(const RequestField& scans) {
  const std::size_t count = scans.arraySize(kMostScans);
  if (count == 0) scans.fail("at least one scan is needed");
  std::vector<MovedScan> read;
  std::size_t beams = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const RequestField field = scans.element(i);
    field.allowOnly({"moved", "ranges", "start_angle", "angle_step", "max_range", "min_range",
                     "bearings", "kinds", "sensor", "stamp", "label"});
    std::optional<TPose2D> pose;
    if (const auto moved = field.find("moved")) {
      moved->allowOnly({"x", "y", "phi"});
      pose = readPose(*moved);
    }
    read.push_back({pose, readScan(field)});
    beams += read.back().scan.beams().size();
    if (beams > kMostBeams) {
      scans.fail("more than " + std::to_string(kMostBeams) + " beams together");
    }
  }
  return read;
}

ScanSet readScanSet(const RequestField& request) {
  const auto wheels = request.find("odometry");
  const MotionNoise noise = wheels ? readOdometry(*wheels) : MotionNoise{};
  std::vector<Moment> moments;
  for (MovedScan& one : readMovedScans(request.member("scans"))) {
    if (moments.empty() || one.moved) moments.emplace_back();
    if (one.moved) moments.back().since_before = measuredMotion(*one.moved, noise);
    moments.back().scans.push_back(std::move(one.scan));
  }
  return ScanSet(std::move(moments));
}

RobotRequest readRobot(const RequestField& request) {
  RobotRequest robot;
  const auto field = request.find("robot");
  if (!field) return robot;
  field->allowOnly({"radius", "strategy", "max_travel", "odometry"});
  if (const auto radius = field->find("radius")) {
    robot.planner.safe.robot_radius = radius->number({0.01, 5.0});
  }
  if (const auto strategy = field->find("strategy")) {
    const auto known = travelStrategyFrom(strategy->text(20));
    if (!known) strategy->fail("unknown strategy; there is: greedy, nearest, majority, random");
    robot.planner.strategy = *known;
  }
  if (const auto most = field->find("max_travel")) robot.run.most_travel = most->number({0.1, 1e4});
  if (const auto odometry = field->find("odometry")) robot.run.odometry = readOdometry(*odometry);
  return robot;
}

LaserRequest readLaser(const RequestField& request) {
  LaserRequest result;
  if (const auto laser = request.find("laser")) readSimulator(*laser, result);
  if (const auto changes = request.find("changes")) result.changes = readChanges(*changes);
  return result;
}

}  // namespace mrpt_polyloc::apps
