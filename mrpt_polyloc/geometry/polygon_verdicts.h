#pragma once

#include <mrpt_polyloc/geometry/findings.h>
#include <mrpt_polyloc/geometry/free_space_labels.h>

#include <vector>

namespace mrpt_polyloc {

/// Reports what noded rings and their labels show to be wrong with polygons, each defect where it
/// is, as repaired or refused.
/// \return by polygon, whether its border has to be traced again
std::vector<bool> judgePolygons(const std::vector<CleanRing>& rings, const NodedRings& noded,
                                const PlanarRegions& regions, const FreeSpaceLabels& labels,
                                Findings& findings);

/// Reports contacts as refused without a look at what they enclose.
void refuseContacts(const std::vector<CleanRing>& rings, const std::vector<Contact>& contacts,
                    Findings& findings);

}  // namespace mrpt_polyloc
