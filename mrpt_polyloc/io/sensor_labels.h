#pragma once

#include <mrpt_polyloc/base/export.h>

#include <cstddef>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// The labels of a list with commas between them; empty for an empty text.
POLYLOC_EXPORT std::vector<std::string> splitLabels(const std::string& list);

/// Whether a sensor is asked for by a label, a list of labels, or "all".
POLYLOC_EXPORT bool isAskedFor(const std::string& label, const std::string& wanted);

/// Which scans of a log belong to the sensors that were asked for.
///
/// \param labels of all scans of the file, in file order
/// \param wanted a label, several with commas between them, or "all"; empty: whichever there is, if
/// the file holds one only
/// \return indices into `labels`, rising, at least one
/// \throws FormatError listing the labels that occur, if there is no scan, several labels and none
/// wanted, or a wanted one does not occur.
POLYLOC_EXPORT std::vector<std::size_t> selectSensor(const std::string& file,
                                                     const std::vector<std::string>& labels,
                                                     const std::string& wanted);

}  // namespace mrpt_polyloc
