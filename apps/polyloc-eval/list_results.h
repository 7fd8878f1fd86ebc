#pragma once

#include <cstdint>
#include <string>

namespace mrpt_polyloc::apps {

/// Writes what the parts of a run come to, from them alone: FOLDER/summary.json, scans.csv,
/// report.html and estimates/DATASET@METHOD.tum with estimates/DATASET.tum (the truth), all or
/// none. The same parts give the same files, but for the date. \param command, threads for the
/// report \throws FormatError naming what is missing or damaged
void writeResults(const std::string& folder, const std::string& command, std::uint64_t threads);

}  // namespace mrpt_polyloc::apps
