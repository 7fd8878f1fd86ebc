#include <mrpt_polyloc/travel/TravelPlan.h>

namespace mrpt_polyloc {

const char* toString(TravelStatus status) {
  switch (status) {
    case TravelStatus::go:
      return "go";
    case TravelStatus::decided:
      return "decided";
    case TravelStatus::indistinguishable:
      return "indistinguishable";
    case TravelStatus::blocked:
      break;
  }
  return "blocked";
}

}  // namespace mrpt_polyloc
