#pragma once

#include <mrpt_polyloc/io/replay_log.h>
#include <mrpt_polyloc/localization/scan/Motion.h>

namespace mrpt_polyloc::replay {

/// The movement since the step before, none where the log has none, with the noise that searches
/// and the tracker expect of wheels.
Motion motionOf(const ReplayStep& step);

}  // namespace mrpt_polyloc::replay
