#include "apps/polyloc-replay/ReplayConfig.h"
#include "fuzz_target.h"

POLYLOC_FUZZ_TARGET(replay_ini, bytes) {
  const auto config = replay::loadReplayConfig(inputFile("input.ini", bytes));
  config.search.check();
  must(config.repetitions > 0, "there is something to do");
}
