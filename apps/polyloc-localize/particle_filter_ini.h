#pragma once

#include <mrpt_polyloc/localization/LocalizationResult.h>

#include <string>

namespace mrpt_polyloc::apps {

/// Lines for the ini file of MRPT's pf-localization that start its particles, uniformly, in a box
/// around one hypothesis: three standard deviations each way, at least 0.25 m and 5 degrees.
std::string particleFilterIni(const Hypothesis& hypothesis);

}  // namespace mrpt_polyloc::apps
