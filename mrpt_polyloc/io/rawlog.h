#pragma once

#include <mrpt_polyloc/io/scan_files.h>

#include <string>
#include <vector>

namespace mrpt_polyloc {

/// The 2D laser scans of an MRPT rawlog, plain or compressed, in file order: action / sensory-frame
/// pairs, observations only, or a whole CRawlog stored as one object. Everything that is not a 2D
/// laser scan is passed over.
///
/// MRPT's CRawlog::loadFromRawLogFile() takes a truncated, damaged or foreign file for a shorter
/// rawlog and prints to stderr. This reader refuses damage, and of a file that ends too early it
/// reads the whole part, with a note (`options.strict` refuses that, too). Not to be seen are only
/// a cut of a *plain* file exactly between two objects, and damage of its values, for it has no
/// checksum.
/// \param notes gets a sentence for all that was assumed or is missing (see toRangeScans()); may be
/// null
/// \throws FormatError naming the file and the object (from 0): missing, empty, damaged or foreign
/// file, an object of a class that is not registered (it cannot be skipped: MRPT stores no sizes),
/// a sensor that is tilted too much, several labels where none is chosen, a label that does not
/// occur, no scan at all.
std::vector<RangeScan> loadRawlog(const std::string& path, const ScanFileOptions& options = {},
                                  Notes* notes = nullptr);

}  // namespace mrpt_polyloc
