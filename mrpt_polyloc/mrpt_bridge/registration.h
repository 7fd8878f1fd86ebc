#pragma once

#include <mrpt_polyloc/base/export.h>

namespace mrpt_polyloc {

/// Makes the classes of this library known to MRPT, for stored objects and ini files. Loading the
/// library does it too, but a linker drops a library of which a program uses no symbol: call this.
POLYLOC_EXPORT void registerClasses();

}  // namespace mrpt_polyloc
