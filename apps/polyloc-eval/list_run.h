#pragma once

#include "../common/Cli.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

struct ListRunOptions {
  std::string list, folder;
  std::string command;  ///< for the report
  std::uint64_t threads = 0;
  bool resume = false;
  std::uint64_t shard = 1, shards = 1;  ///< the 1-based share that is run, of how many
};

/// Runs every method of a list on every data set, keeps each scan as soon as it is done, and, but
/// for a share of the whole, writes the results (see writeResults()).
/// \throws FormatError, InvalidMapError
int runList(const Program& program, const ListRunOptions& options);

/// Puts the shares of a list together in a new folder and writes the results.
/// \throws FormatError naming what is missing, there twice, or of another run
int mergeRuns(const Program& program, const std::vector<std::string>& folders,
              const std::string& folder, const std::string& command);

}  // namespace mrpt_polyloc::apps
