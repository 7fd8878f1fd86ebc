#include "fuzz_target.h"
#include <mrpt_polyloc/evaluation/truth.h>

#include <cmath>

POLYLOC_FUZZ_TARGET(tum, bytes) {
  const std::string path = inputFile("input.tum", bytes);
  if (isIndexedTruth(path)) {
    loadIndexedTruth(path, 1000);
    return;
  }
  for (const StampedPose& pose : loadTum(path)) {
    must(std::isfinite(pose.stamp) && std::isfinite(pose.pose_map_robot.phi), "a pose is finite");
  }
}
