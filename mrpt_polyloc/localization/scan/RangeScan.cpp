#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <cmath>
#include <utility>

namespace mrpt_polyloc {

RangeScan::RangeScan(std::vector<Beam> beams, const mrpt::math::TPoint2D& sensor, double stamp,
                     std::string label)
    : beams_(std::move(beams)), sensor_(sensor), stamp_(stamp), label_(std::move(label)) {
  if (!std::isfinite(sensor.x) || !std::isfinite(sensor.y)) {
    throw InvalidParamsError("sensor: its position is not finite");
  }
  for (Beam& beam : beams_) {
    // Ranges are compared in single precision: what is infinite there is no range.
    const bool usable = std::isfinite(beam.bearing) &&
                        std::isfinite(static_cast<float>(beam.range)) && beam.range > 0.0;
    if (!usable || beam.kind == BeamKind::invalid) beam = Beam{};
    hit_count_ += beam.kind == BeamKind::hit;
    no_return_count_ += beam.kind == BeamKind::no_return;
  }
}

mrpt::math::TPose2D RangeScan::robotFromBeamFrame(const mrpt::math::TPose2D& pose_map_beams) const {
  const double c = std::cos(pose_map_beams.phi), s = std::sin(pose_map_beams.phi);
  return {pose_map_beams.x - c * sensor_.x + s * sensor_.y,
          pose_map_beams.y - s * sensor_.x - c * sensor_.y, pose_map_beams.phi};
}

mrpt::math::TPose2D RangeScan::beamFrameFromRobot(const mrpt::math::TPose2D& pose_map_robot) const {
  const double c = std::cos(pose_map_robot.phi), s = std::sin(pose_map_robot.phi);
  return {pose_map_robot.x + c * sensor_.x - s * sensor_.y,
          pose_map_robot.y + s * sensor_.x + c * sensor_.y, pose_map_robot.phi};
}

}  // namespace mrpt_polyloc
