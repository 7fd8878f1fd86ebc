#include "fuzz_target.h"
#include "scan_checks.h"

POLYLOC_FUZZ_TARGET(carmen, bytes) {
  checkLog(inputFile("input.log", bytes));
}
