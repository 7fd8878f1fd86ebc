#pragma once

#include "EvaluationStore.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

struct EvaluatedDataset {
  std::string name;
  nlohmann::ordered_json description;
  std::vector<std::size_t> stretch;  ///< of each evaluated scan
};

struct EvaluatedMethod {
  std::string name;
  nlohmann::ordered_json entry;
};

/// A run, read from its parts.
struct EvaluationRun {
  std::vector<EvaluatedDataset> datasets;
  std::vector<EvaluatedMethod> methods;
  std::vector<std::vector<EvaluationJob>> jobs;  ///< by data set, then method
};

/// \param job null if there is none \param place of it, for messages
/// \throws FormatError unless all scans of the job are there
void requireWhole(const EvaluationJob* job, const std::string& place);

/// Reads the parts of a run. \throws FormatError naming what is missing or damaged
EvaluationRun readRun(const std::string& folder);

/// Whether a status has no first answer.
bool isRefused(LocalizationStatus status);

/// Why a scan was missed, as far as can be told: the first that holds of refused,
/// outside_free_space, rival_within_noise, behind_others, not_in_list; empty if it was not.
const char* whyMissed(const EvaluatedScan& scan);

}  // namespace mrpt_polyloc::apps
