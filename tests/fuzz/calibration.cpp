#include "fuzz_target.h"
#include <mrpt_polyloc/evaluation/calibration_files.h>

POLYLOC_FUZZ_TARGET(calibration, bytes) {
  loadCalibration(inputFile("input.json", bytes)).check();
}
