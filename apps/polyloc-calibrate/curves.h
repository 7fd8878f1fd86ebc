#pragma once

#include <mrpt_polyloc/evaluation/reliability.h>
#include <mrpt_polyloc/evaluation/roc.h>

#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// A curve in-sample and, where there is one, cross-validated.
struct RocCurves {
  std::vector<RocPoint> fitted, cross_validated;
};
struct ReliabilityCurves {
  std::vector<ReliabilityBin> fitted, cross_validated;
};

/// `kind,threshold,lost,refused`, kind fitted or cross_validated; shares from 0 to 1.
std::string rocCsv(const RocCurves& curves);

/// `kind,from,to,count,stated,right`; of an empty bin the last two are empty.
std::string reliabilityCsv(const ReliabilityCurves& curves);

/// Foreign scans refused over true scans lost, up to 20 % lost and from 80 % refused on.
std::string rocSvg(const RocCurves& curves);

/// Share of right answers over the stated probability.
std::string reliabilitySvg(const ReliabilityCurves& curves);

}  // namespace mrpt_polyloc::apps
