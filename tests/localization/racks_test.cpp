#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/evaluation/Simulator.h>
#include <mrpt_polyloc/io/map_files.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace mrpt_polyloc::test {
namespace {

// A hall with rows of racks, ours: along them what is seen changes within a leaf, so that the right
// leaf's middle may cost far more than that of a twin. Row 197 was answered `unique` at the twin
// while the truth, cheaper, lay in a region that nothing was started from.
TEST(Racks, TheTruthIsInTheListAndNoTwinIsCalledUnique) {
  const PolygonMap map =
      loadMap(std::string(POLYLOC_SOURCE_DIR) + "/tests/localization/cases/racks.wkt").map;
  const GlobalLocalizer localizer(map);
  std::size_t listed = 0, first = 0, unique = 0;
  const auto scans = simulateScans(map, {}, 200, 5);
  for (const SimulatedScan& simulated : scans) {
    const auto& truth = simulated.truth.pose_map_robot;
    const auto result = localizer.localize(toRangeScan(simulated.observation));
    bool is_listed = false, is_first = false;
    for (std::size_t i = 0; i < result.hypotheses.size(); ++i) {
      const auto& pose = result.hypotheses[i].pose_map_robot;
      const bool is_right = distanceBetween(pose, truth) < 0.3 && turnBetween(pose, truth) < 0.09;
      is_listed |= is_right;
      is_first |= is_right && i == 0;
    }
    listed += is_listed;
    first += is_first;
    unique += result.status == LocalizationStatus::unique;
    EXPECT_FALSE(result.status == LocalizationStatus::unique && !is_first)
        << truth.x << " " << truth.y << " " << truth.phi;
  }
  EXPECT_EQ(listed, scans.size());
  EXPECT_GE(first, scans.size() - 2);
  EXPECT_GE(unique, scans.size() * 95 / 100);
}

}  // namespace
}  // namespace mrpt_polyloc::test
