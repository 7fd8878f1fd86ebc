#include <mrpt_polyloc/localization/ranking/LocalizationStatus.h>

namespace mrpt_polyloc {

const char* toString(LocalizationStatus status) {
  switch (status) {
    case LocalizationStatus::unique:
      return "unique";
    case LocalizationStatus::ambiguous:
      return "ambiguous";
    case LocalizationStatus::no_match:
      return "no_match";
    case LocalizationStatus::too_few_beams:
      break;
  }
  return "too_few_beams";
}

}  // namespace mrpt_polyloc
