#include "fuzz_target.h"
#include "scan_checks.h"

POLYLOC_FUZZ_TARGET(rawlog, bytes) {
  checkLog(inputFile("input.rawlog", bytes));
}
