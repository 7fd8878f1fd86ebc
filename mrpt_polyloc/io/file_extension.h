#pragma once

#include <mrpt_polyloc/base/export.h>

#include <string>

namespace mrpt_polyloc {

/// The extension of a file's name in lower case, without a .gz or .zst behind it: ".log" for
/// "A.Log.GZ"; empty if there is none.
POLYLOC_EXPORT std::string contentExtension(const std::string& path);

}  // namespace mrpt_polyloc
