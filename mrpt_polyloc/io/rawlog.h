#pragma once

#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <string>
#include <vector>

namespace mrpt_polyloc {

/// The 2D laser scans of an MRPT rawlog, plain or gzipped, in file order: action / sensory-frame
/// pairs, observations only, or a whole CRawlog stored as one object. Everything that is not a 2D
/// laser scan is passed over.
///
/// MRPT's CRawlog::loadFromRawLogFile() takes a truncated, damaged or foreign file for a shorter
/// rawlog and prints to stderr; this reader refuses it. Not to be seen are only a cut of a *plain*
/// file exactly between two objects, and damage of its values, for it has no checksum.
/// \param sensor_label only the scans of this sensor; empty: all, if there is one sensor only
/// \throws FormatError naming the file and the object (from 0): missing, empty, truncated or
/// foreign file, an object of a class that is not registered (it cannot be skipped: MRPT stores no
/// sizes), a sensor that is not planar, several labels where none is chosen, a label that does not
/// occur, no scan at all.
std::vector<RangeScan> loadRawlog(const std::string& path, const std::string& sensor_label = {});

}  // namespace mrpt_polyloc
