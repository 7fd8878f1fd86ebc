#include "replay_scene.h"

#include <mrpt_polyloc/io/mrpt_compat.h>

#include <stdexcept>

namespace mrpt_polyloc::replay {
namespace {

constexpr double kWayHeight = 0.02;       // [m] above the map, so that lines do not hide each other
constexpr double kParticleHeight = 0.04;  // [m]

/// Joins successive places by a line.
class Way {
 public:
  explicit Way(const char* name) : lines_(drawn::CSetOfLines::Create()) {
    lines_->setName(name);
    lines_->setLineWidth(2.0F);
  }
  void add(const mrpt::math::TPose2D& pose, bool joined) {
    if (joined && has_last_) {
      lines_->appendLine(last_.x, last_.y, kWayHeight, pose.x, pose.y, kWayHeight);
    }
    last_ = pose;
    has_last_ = true;
  }
  const drawn::CSetOfLines::Ptr& lines() const { return lines_; }

 private:
  drawn::CSetOfLines::Ptr lines_;
  mrpt::math::TPose2D last_{0, 0, 0};
  bool has_last_ = false;
};

}  // namespace

void writeScene(const std::string& path, const CPolygonMap2D& map, const RunRecord& run,
                std::size_t k, const Truth& truth) {
  Scene scene;
  auto walls = drawn::CSetOfObjects::Create();
  map.getVisualizationInto(*walls);
  walls->setName("map");
  scene.insert(walls);

  Way estimated("estimate"), known("truth");
  for (std::size_t i = 0; i <= k; ++i) {
    const StepRecord& step = run.steps[i];
    const bool joined = i == 0 || step.step == run.steps[i - 1].step + 1;
    estimated.add(step.estimate, joined);
    if (step.step < truth.size() && truth[step.step]) known.add(*truth[step.step], joined);
  }
  estimated.lines()->setColor_u8(20, 130, 60);
  known.lines()->setColor_u8(190, 70, 20);
  scene.insert(estimated.lines());
  scene.insert(known.lines());

  const StepRecord& last = run.steps[k];
  auto particles = drawn::CPointCloud::Create();
  particles->setName("particles");
  particles->setPointSize(3.0F);
  particles->setColor_u8(176, 24, 156);
  for (const auto& pose : last.cloud) {
    particles->insertPoint(static_cast<float>(pose.x), static_cast<float>(pose.y),
                           static_cast<float>(kParticleHeight));
  }
  scene.insert(particles);
  auto robot = drawn::stock_objects::CornerXYZSimple(1.0F, 2.0F);
  robot->setName("robot");
  robot->setPose(mrpt::poses::CPose3D(mrpt::poses::CPose2D(last.estimate)));
  scene.insert(robot);
  if (!scene.saveToFile(path)) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace mrpt_polyloc::replay
