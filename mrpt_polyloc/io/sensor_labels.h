#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// Which scans of a log belong to the sensor that was asked for.
///
/// \param labels of all scans of the file, in file order
/// \param wanted label; empty: whichever there is, if the file holds one only
/// \return indices into `labels`, rising, at least one
/// \throws FormatError listing the labels that occur, if there is no scan, several labels and none
/// wanted, or the wanted one does not occur.
std::vector<std::size_t> selectSensor(const std::string& file,
                                      const std::vector<std::string>& labels,
                                      const std::string& wanted);

}  // namespace mrpt_polyloc
