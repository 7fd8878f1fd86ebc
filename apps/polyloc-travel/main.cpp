// polyloc-travel: where to drive to find out where one is. See README.md beside this file.

#include "../common/Cli.h"
#include "../common/OutputFiles.h"
#include "../common/Progress.h"
#include "../common/map_input.h"
#include "TravelOptions.h"
#include "TravelRun.h"
#include "looks_input.h"
#include "next_waypoint.h"
#include "travel_oracles.h"
#include "travel_picture.h"
#include "travel_report.h"
#include <mrpt_polyloc/base/errors.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace mrpt_polyloc;
using namespace mrpt_polyloc::apps;

/// \throws InvalidParamsError for a place at which the robot would touch something
void requireRoom(const World& world, const mrpt::math::TPose2D& start, double radius) {
  const std::string why = world.whyNoRoom({start.x, start.y}, radius);
  if (!why.empty()) throw InvalidParamsError("--start: " + why);
}

int simulate(const Program& program, const TravelOptions& options) {
  requireWritable(options.svg);
  const PolygonMap map = loadMapWithWarnings(program, options.map, options.scale).map;
  const double radius = options.planner.safe.robot_radius;
  const World world(map, options.laser, options.clutter, radius, options.seed);
  if (options.start) requireRoom(world, *options.start, radius);
  const MapIndex::Ptr index = MapIndex::build(map);
  const GlobalLocalizer localizer(index, surerSearch());
  const TravelPlanner planner(index, options.planner);

  const std::size_t count = options.start ? 1 : static_cast<std::size_t>(options.count);
  Random starts(options.seed);
  std::vector<TravelRecord> records;
  std::string picture;
  Progress progress("runs", count);
  for (std::size_t i = 0; i < count; ++i) {
    const mrpt::math::TPose2D start =
        options.start ? *options.start
                      : world.randomPose(radius + options.run.start_clearance, starts);
    const TravelRunResult run =
        travel(planner, localizer, world, start, options.run, options.seed * 1'000'003 + i);
    TravelRecord record = recordOf(run, options.map);
    if (run.outcome == TravelOutcome::indistinguishable) {
      record.is_rightly_indistinguishable =
          isTrulyIndistinguishable(planner, world, run, options.run.most_travel - run.travelled);
    }
    if (run.outcome == TravelOutcome::localized && run.is_ambiguous_at_start) {
      record.tour_m = shortestTour(planner, world, run);
    }
    records.push_back(std::move(record));
    if (!options.svg.empty() && i + 1 == count) picture = travelPicture(planner, world, run);
    progress.step();
  }

  const std::filesystem::path folder = options.folder;
  makeFolder(options.folder);
  OutputFiles files;
  files.add(folder / "summary.json", travelSummary(records).dump(2) + "\n");
  files.add(folder / "runs.csv", runsCsv(records));
  if (!options.svg.empty()) files.add(options.svg, picture);
  files.commit();
  std::cout << travelSummary(records).dump(2) << '\n';
  return kDone;
}

int plan(const Program& program, const TravelOptions& options) {
  const std::vector<Look> looks = loadLooks(program, options);
  const MapIndex::Ptr index =
      MapIndex::build(loadMapWithWarnings(program, options.map, options.scale).map);
  NextWaypointParams params;
  params.odometry = options.run.odometry;
  params.most_distance = options.run.most_travel;
  params.seed = options.seed;
  const TravelPlanner planner(index, options.planner);
  std::cout << nextWaypoint(planner, GlobalLocalizer(index, surerSearch()), looks, params).dump(2)
            << '\n';
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("polyloc-travel",
                  "Simulates robots that do not know where they are and drive until they do, or "
                  "tells a real one where to drive.");
  TravelOptions options;
  addOptions(program.options(), options);
  return program.run(argc, argv, [&]() -> int {
    finishOptions(options);
    return options.plans ? plan(program, options) : simulate(program, options);
  });
}
