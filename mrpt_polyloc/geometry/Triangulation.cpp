#include <mrpt_polyloc/geometry/Triangulation.h>
