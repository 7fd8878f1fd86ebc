#pragma once

#include "../common/simulation_input.h"
#include "EvaluationOptions.h"
#include "baseline_methods.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// A data set of a list.
struct DatasetEntry {
  std::string name;
  std::string place;  ///< in the list, for messages
  std::string map;    ///< path
  std::string plan;   ///< the map's own WKT, where `map` holds many; else empty
  std::optional<SimulationInput> simulation;  ///< else scans and truth are files
  std::size_t every = 1;                      ///< every so many rows are evaluated
  std::vector<std::string> arguments;         ///< its options, as on the command line
};

/// A method of a list.
struct MethodEntry {
  std::string name;
  std::string method;  ///< certified, cells, exact, or a baseline
  std::string place;
  std::optional<BaselineOptions> baseline;
  std::vector<std::string> arguments;
};

struct EvaluationList {
  std::string path;
  std::vector<DatasetEntry> datasets;
  std::vector<MethodEntry> methods;
};

/// Reads a list (see README.md). Everything is checked before anything is run: keys, numbers, that
/// the files are there, and the options of each pair of a data set and a method.
/// \throws FormatError naming file and line
EvaluationList loadEvaluationList(const std::string& path);

/// The options of a pair, as the command line of one set would give them.
EvaluationOptions optionsOf(const DatasetEntry& dataset, const MethodEntry& method);

}  // namespace mrpt_polyloc::apps
