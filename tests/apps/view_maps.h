#pragma once

#include <string>

/// Maps of datasets/ that polyloc-view is started with.
namespace mrpt_polyloc::test {

inline const std::string kFlat = std::string(POLYLOC_SOURCE_DIR) + "/datasets/flat.wkt";
inline const std::string kNiches = std::string(POLYLOC_SOURCE_DIR) + "/datasets/niches.wkt";

}  // namespace mrpt_polyloc::test
