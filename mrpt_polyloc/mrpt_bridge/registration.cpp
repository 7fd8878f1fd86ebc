#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>
#include <mrpt_polyloc/mrpt_bridge/registration.h>

#include <mrpt/core/initializer.h>

MRPT_INITIALIZER(registerPolylocClasses) {
  mrpt_polyloc::registerClasses();
}

namespace mrpt_polyloc {

void registerClasses() {
  mrpt::rtti::registerClass(CLASS_ID_NAMESPACE(CPolygonMap2D, mrpt_polyloc));
}

}  // namespace mrpt_polyloc
