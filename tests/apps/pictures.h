#pragma once

#include <string>

namespace mrpt_polyloc::test {

/// How much two pictures differ: the share of blocks of 8 x 8 pixels whose mean brightness is not
/// the same to a twentieth. Letters that are drawn a little otherwise do not count, a line that is
/// missing does. 1 if one cannot be read, or their sizes differ.
double shareOfOtherBlocks(const std::string& png, const std::string& other_png);

}  // namespace mrpt_polyloc::test
