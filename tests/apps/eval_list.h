#pragma once

#include "ProgramTest.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace mrpt_polyloc::test {

/// Lists of a small room: one set of files, one simulated, one of several plans.
class PolylocEvalList : public ProgramTest {
 protected:
  std::string list(const std::string& methods = "certified") const {
    simulate("sim", {"--short", "0.3"});
    write("good.txt", "0\n3\n11\n");
    write("plans.tsv",
          "box\tPOLYGON ((0 0, 5 0, 5 3, 2 3, 2 4, 0 4, 0 0))\n"
          "hall 2\tPOLYGON ((0 0, 9 0, 9 3, 7 3, 7 5, 0 5, 0 0))\n");
    return write("list.yaml",
                 "datasets:\n"
                 "  - {name: files, map: room.wkt, scans: sim/scans.rawlog, truth: sim/truth.tum, "
                 "good: good.txt}\n"
                 "  - {name: plan, plans: plans.tsv, simulate: {n: 5, seed: 3, short: 0.2}}\n"
                 "  - {name: every, map: room.wkt, simulate: {n: 9, seed: 1, fov: 180, wing_scale: "
                 "0.01}, every: 3, max_range: 12}\n"
                 "methods: [" +
                     methods + "]\n");
  }
  Outcome evaluate(const std::vector<std::string>& arguments) const {
    return run("polyloc-eval", arguments);
  }
  nlohmann::json summary(const std::string& folder) const {
    return nlohmann::json::parse(readFile(path(folder + "/summary.json")));
  }
  /// What must not hang on how it was run: no times, no memory, no date.
  nlohmann::json timeless(const std::string& folder) const {
    nlohmann::json result = summary(folder);
    result.erase("run");
    for (const char* key : {"results", "all"}) {
      for (nlohmann::json& entry : result[key]) {
        const auto forget = [](nlohmann::json& figures) {
          for (const char* time : {"ms_median", "ms_p90", "ms_max"}) figures.erase(time);
        };
        forget(entry);
        if (entry.contains("good")) forget(entry["good"]);
        for (const char* time : {"index_build_s", "cold_start_s"}) entry.erase(time);
      }
    }
    return result;
  }
  /// The estimates, which evo would read.
  std::string estimates(const std::string& folder) const {
    return readFile(path(folder + "/estimates/files@certified.tum"));
  }
};

}  // namespace mrpt_polyloc::test
