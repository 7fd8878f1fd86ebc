#include "apps/polyloc-eval/EvaluationList.h"
#include "fuzz_target.h"

POLYLOC_FUZZ_TARGET(set_list, bytes) {
  inputFile("map.wkt", "POLYGON ((0 0, 4 0, 4 4))");
  inputFile("scans.rawlog", "not read");
  inputFile("truth.tum", "not read");
  const auto list = apps::loadEvaluationList(inputFile("input.yaml", bytes));
  must(!list.datasets.empty() && !list.methods.empty(), "a list holds sets and methods");
}
